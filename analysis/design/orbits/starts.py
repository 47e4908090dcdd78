"""Initial parameters of a spacecraft: `perilune.epoch` and `perilune.orbit`."""

from __future__ import annotations

import math
from datetime import UTC, datetime, timedelta

import numpy as np

from ....common.errors import InputError
from ....fmus_src.mathlib.space.earth_gravity import GRAVITATIONAL_PARAMETER

J2000 = datetime(2000, 1, 1, 12, tzinfo=UTC)
LEAP_SECONDS = 37  # TAI - UTC (s) from LEAP_SECONDS_START on: IERS Bulletin C 52, 2016
LEAP_SECONDS_START = datetime(2017, 1, 1, tzinfo=UTC)
TT_MINUS_TAI = timedelta(milliseconds=32184)
ELEMENTS = ("semi_major_axis", "eccentricity", "inclination", "node", "argument_of_perigee", "true_anomaly", "mu")


def epoch(utc: str, *, leap_seconds: int | None = None) -> float:
    """Return terrestrial time (TT) in seconds since J2000.0 (2000-01-01 12:00 TT), for the parameter ``epoch``.

    Parameters
    ----------
    utc : str
        Date and time in ISO 8601 with a time zone, for example ``"2026-03-20T18:00:00Z"``.
    leap_seconds : int, optional
        TAI - UTC (s) at that time; 37 from 2017 on, until another leap second is announced. Earlier dates need it.

    Returns
    -------
    float
        TT - J2000.0 (s), with TT = UTC + leap_seconds + 32.184 s.

    Raises
    ------
    InputError
        The text is not a date with a time zone, or the date is before 2017 and ``leap_seconds`` is missing.

    Notes
    -----
    Source: IERS Conventions 2010, chapter 10.

    Examples
    --------
    >>> perilune.epoch("2026-03-20T18:00:00Z")
    827301669.184
    """
    remedy = "write the time as 2026-03-20T18:00:00Z"
    try:
        time = datetime.fromisoformat(utc)
    except (TypeError, ValueError):
        raise InputError("`utc`", repr(utc), "not a date and time of ISO 8601", remedy) from None
    if time.tzinfo is None:
        raise InputError("`utc`", repr(utc), "without a time zone", remedy)
    if leap_seconds is None:
        if time < LEAP_SECONDS_START:
            raise InputError("`utc`", repr(utc), "before 2017", "give `leap_seconds`, TAI - UTC in s at that time")
        leap_seconds = LEAP_SECONDS
    if isinstance(leap_seconds, bool) or not isinstance(leap_seconds, int):
        raise InputError(
            "`leap_seconds`", repr(leap_seconds), "not a whole number", f"give a whole number, such as {LEAP_SECONDS}"
        )
    return (time - J2000 + timedelta(seconds=leap_seconds) + TT_MINUS_TAI) / timedelta(seconds=1)


def orbit(
    *,
    semi_major_axis: float,
    eccentricity: float = 0.0,
    inclination: float = 0.0,
    node: float = 0.0,
    argument_of_perigee: float = 0.0,
    true_anomaly: float = 0.0,
    mu: float = GRAVITATIONAL_PARAMETER,
) -> tuple[np.ndarray, np.ndarray]:
    """Return position and velocity on an orbit, for the parameters ``initial_position`` and ``initial_velocity``.

    Parameters
    ----------
    semi_major_axis : float
        Semi-major axis (m); negative for a hyperbola.
    eccentricity : float
        From 0 to below 1 for an ellipse, above 1 for a hyperbola.
    inclination, node, argument_of_perigee, true_anomaly : float
        Angles (rad): inclination to the x-y plane of the inertial axes, longitude of the ascending node from their x
        axis, argument of perigee from the node, and true anomaly from perigee.
    mu : float
        Gravitational parameter of the body (m3/s2), by default the Earth's value in GGM03S.

    Returns
    -------
    tuple of two numpy arrays
        Position (m) and velocity (m/s) in inertial axes, arrays of three elements.

    Raises
    ------
    InputError
        An element is not finite, the elements do not define a conic section, or the true anomaly is beyond the
        asymptote of a hyperbola.

    Notes
    -----
    Source: Vallado 2013, algorithm 10.

    Examples
    --------
    >>> r, v = perilune.orbit(semi_major_axis=6878137.0, inclination=1.7)
    """
    numbers = (semi_major_axis, eccentricity, inclination, node, argument_of_perigee, true_anomaly, mu)
    for name, number in zip(ELEMENTS, numbers, strict=True):
        if isinstance(number, bool) or not isinstance(number, int | float | np.number) or not math.isfinite(number):
            raise InputError(
                f"`{name}`", repr(number), "not a finite number", "give a number in SI units, angles in rad"
            )
    if not mu > 0.0:
        raise InputError("`mu`", repr(mu), "not positive", "give the body's gravitational parameter in m3/s2")
    if eccentricity < 0.0 or eccentricity == 1.0:
        raise InputError(
            "`eccentricity`",
            repr(eccentricity),
            "neither an ellipse nor a hyperbola",
            "give a value from 0 to below 1 (ellipse) or above 1 (hyperbola)",
        )
    parameter = semi_major_axis * (1.0 - eccentricity) * (1.0 + eccentricity)  # semi-latus rectum
    if not parameter > 0.0:
        sign = "positive, as an ellipse requires" if eccentricity < 1.0 else "negative, as a hyperbola requires"
        raise InputError(
            "`semi_major_axis`", repr(semi_major_axis), f"not {sign}", "change `semi_major_axis` or `eccentricity`"
        )
    cosine, sine = math.cos(true_anomaly), math.sin(true_anomaly)
    if not 1.0 + eccentricity * cosine > 0.0:
        raise InputError(
            "`true_anomaly`", repr(true_anomaly), "beyond the asymptote of the hyperbola", "give an angle closer to 0"
        )
    turn = _rotation(node, 2) @ _rotation(inclination, 0) @ _rotation(argument_of_perigee, 2)
    position = parameter / (1.0 + eccentricity * cosine) * np.array([cosine, sine, 0.0])
    velocity = math.sqrt(mu / parameter) * np.array([-sine, eccentricity + cosine, 0.0])
    return turn @ position, turn @ velocity


def _rotation(angle: float, axis: int) -> np.ndarray:
    """Return the rotation by an angle (rad) about a coordinate axis."""
    matrix = np.eye(3)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    matrix[first, first] = matrix[second, second] = math.cos(angle)
    matrix[second, first] = math.sin(angle)
    matrix[first, second] = -matrix[second, first]
    return matrix
