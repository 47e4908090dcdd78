"""Orientation of Earth and Moon: from inertial to planet-fixed axes. Kernel functions.

Inertial: axes of the GCRS. Planet-fixed: the ITRS without polar motion, or the Moon's mean-Earth axes. Each orientation
consists of pole axes, which move slowly and may be kept constant over a step, and a rotation angle about the pole.
"""

import math

from ...kernel.functions import cos, sin
from ...kernel.records import Field, Record
from ..vectors import Vector3, dot, vector
from .ephemerides import CENTURY, DEGREE, TURN

DAY = 86400.0  # s


class PlanetAxes(Record):
    """Axes of the pole at one instant, and the rotation angle about it, which has a constant rate near that instant."""

    first = Field(
        Vector3, unit="1", frame="inertial", description="axis from which the rotation angle counts, unit vector"
    )
    second = Field(
        Vector3,
        unit="1",
        frame="inertial",
        description="axis perpendicular to the first axis and to the pole, unit vector",
    )
    pole = Field(Vector3, unit="1", frame="inertial", description="rotation axis towards north, unit vector")
    time = Field(unit="s", description="instant at which axes and angle are valid")
    angle = Field(unit="rad", description="angle of the prime meridian from the first axis at that time")
    rate = Field(unit="rad/s", description="time derivative of the prime meridian's angle")


class FixedAxes(Record):
    """Planet-fixed axes at one instant: prime meridian on the equator, 90 degrees east of it, north."""

    meridian = Field(
        Vector3, unit="1", frame="inertial", description="planet-fixed x axis, through the prime meridian, unit vector"
    )
    east = Field(Vector3, unit="1", frame="inertial", description="planet-fixed y axis, 90 degrees east, unit vector")
    pole = Field(Vector3, unit="1", frame="inertial", description="planet-fixed z axis, towards north, unit vector")


def angle_at(axes: PlanetAxes, t: float) -> float:
    """Return the angle (rad) of the prime meridian at a time (s) close to the instant of the axes."""
    return axes.angle + axes.rate * (t - axes.time)


def fixed_axes(axes: PlanetAxes, t: float) -> FixedAxes:
    """Return the planet-fixed axes at a time (s) close to the instant of the pole axes."""
    angle = angle_at(axes, t)
    c = cos(angle)
    s = sin(angle)
    return FixedAxes(meridian=c * axes.first + s * axes.second, east=c * axes.second - s * axes.first, pole=axes.pole)


def to_fixed(axes: FixedAxes, v: Vector3) -> Vector3:
    """Return a vector in inertial axes transformed to planet-fixed axes."""
    return vector(dot(axes.meridian, v), dot(axes.east, v), dot(axes.pole, v))


def from_fixed(axes: FixedAxes, v: Vector3) -> Vector3:
    """Return a vector in planet-fixed axes transformed to inertial axes."""
    return v.x * axes.meridian + v.y * axes.east + v.z * axes.pole


def earth_axes(t: float, tt_minus_ut1: float) -> PlanetAxes:
    """Return the axes of the Earth at t (TT, s since J2000.0), with TT - UT1 (s).

    The pole is within 0.24 arcseconds of IAU 2006/2000A between 2020 and 2040 (rms 0.11); polar motion (0.3 arcseconds)
    is neglected. Source: Capitaine, Wallace and Chapront 2003; Wallace and Capitaine 2008, with seven more terms.
    """
    d = t / DAY
    T = t / CENTURY  # noqa: N806 - as in the source
    node = 2.182439196616 - 33.757045934 * T
    sun = 4.894961 + 628.3319662 * T
    moon = 3.810344 + 8399.7091135 * T
    anomaly = 6.240060 + 628.301955 * T
    x = 2.6603e-7 * d - 33.2e-6 * sin(node) - 2.54e-6 * sin(2.0 * sun) - 0.44e-6 * sin(2.0 * moon)
    x = x + 0.40e-6 * sin(2.0 * node) + 0.28e-6 * sin(anomaly)
    y = -8.14e-14 * d * d + 44.6e-6 * cos(node) + 2.78e-6 * cos(2.0 * sun) + 0.47e-6 * cos(2.0 * moon)
    y = y - 0.43e-6 * cos(2.0 * node)
    b = 1.0 / (1.0 + math.sqrt(1.0 - x * x - y * y))
    days = (t - tt_minus_ut1) / DAY
    turns = days - float(math.floor(days)) + 0.7790572732640 + 0.00273781191135448 * days
    return PlanetAxes(
        first=vector(1.0 - b * x * x, -b * x * y, -x),
        second=vector(-b * x * y, 1.0 - b * y * y, -y),
        pole=vector(x, y, 1.0 - b * (x * x + y * y)),
        time=t,
        angle=TURN * turns,
        rate=TURN * 1.00273781191135448 / DAY,
    )


# Arguments E1 to E13 (deg, deg a day), and amplitudes (deg) of their sines in right ascension, of their
# cosines in declination, of their sines in the prime meridian.
LUNAR_ARGUMENTS = (
    125.045, -0.0529921, 250.089, -0.1059842, 260.008, 13.0120009, 176.625, 13.3407154, 357.529, 0.9856003,
    311.589, 26.4057084, 134.963, 13.0649930, 276.617, 0.3287146, 34.226, 1.7484877, 15.134, -0.1589763,
    119.743, 0.0036096, 239.961, 0.1643573, 25.053, 12.9590088,
)  # fmt: skip
ASCENSION = (-3.8787, -0.1204, 0.0700, -0.0172, 0.0, 0.0072, 0.0, 0.0, 0.0, -0.0052, 0.0, 0.0, 0.0043)
DECLINATION = (1.5419, 0.0239, -0.0278, 0.0068, 0.0, -0.0029, 0.0009, 0.0, 0.0, 0.0008, 0.0, 0.0, -0.0009)
MERIDIAN = (
    3.5610, 0.1208, -0.0642, 0.0158, 0.0252, -0.0066, -0.0047, -0.0046, 0.0028, 0.0052, 0.0040, 0.0019, -0.0044,
)  # fmt: skip
LUNAR_TERMS = 13
LUNAR_RATE = 13.17635815  # deg a day


def moon_axes(t: float) -> PlanetAxes:
    """Return the axes of the Moon at t (TT, s since J2000.0).

    The rotation angle has its mean rate; the librations are constant at their values at t. Source: Archinal et al.,
    Report of the IAU working group on cartographic coordinates: 2009, 2011.
    """
    d = t / DAY
    T = t / CENTURY  # noqa: N806 - as in the source
    ascension = 269.9949 + 0.0031 * T
    declination = 66.5392 + 0.0130 * T
    meridian = 38.3213 + LUNAR_RATE * d - 1.4e-12 * d * d
    for i in range(LUNAR_TERMS):
        argument = (LUNAR_ARGUMENTS[2 * i] + LUNAR_ARGUMENTS[2 * i + 1] * d) * DEGREE
        s = sin(argument)
        ascension = ascension + ASCENSION[i] * s
        declination = declination + DECLINATION[i] * cos(argument)
        meridian = meridian + MERIDIAN[i] * s
    ca = cos(ascension * DEGREE)
    sa = sin(ascension * DEGREE)
    cd = cos(declination * DEGREE)
    sd = sin(declination * DEGREE)
    return PlanetAxes(
        first=vector(-sa, ca, 0.0),
        second=vector(-sd * ca, -sd * sa, cd),
        pole=vector(cd * ca, cd * sa, sd),
        time=t,
        angle=meridian * DEGREE,
        rate=LUNAR_RATE * DEGREE / DAY,
    )
