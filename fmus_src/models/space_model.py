"""Model of the space environment shared by a spacecraft and its sensors."""

import math

from ..block import Block, Parameter, State
from ..interfaces.ports import space
from ..interfaces.ports.space import Atmosphere, CelestialBody
from ..kernel.matrices import zeros
from ..mathlib.space import magnetic_field
from ..mathlib.space.eclipse import illumination
from ..mathlib.space.ephemerides import MOON_SHADOW_RADIUS, moon_position, sun_position
from ..mathlib.space.exponential_atmosphere import exponential_density
from ..mathlib.space.geodetic import EQUATORIAL_RADIUS, geodetic_height
from ..mathlib.space.harmonics import SIZE
from ..mathlib.space.harris_priester import bulge_fraction, harris_priester_density
from ..mathlib.space.magnetic_field import igrf14
from ..mathlib.space.orientation import (
    PlanetAxes,
    angle_at,
    earth_axes,
    fixed_axes,
    from_fixed,
    moon_axes,
    to_fixed,
)
from ..mathlib.vectors import Vector3, cross, dot, norm, vector

LOWEST_AIR = 100e3  # m, lowest height of both air density tables


class SpaceModel(Block, interface=True):
    """Orientation of the planet, Sun and Moon, magnetic field, air density and shadow near Earth or Moon.

    `locate` sets the pole, the Sun and the Moon for one instant; after that only the planet rotates. A subclass may
    override `flux_density`, `air_density` and `air_velocity`. The Moon has neither field nor air. With UT1 in days d
    since J2000.0 and the magnetic potential V in spherical harmonics, the Earth's rotation angle and the magnetic field
    are

        θ = 2 π (frac(d) + 0.7790572732640 + 0.00273781191135448 d)    B = -∇V

    In the penumbra, with the apparent radii a of the Sun and b of the body and their distance c, the visible fraction
    is

        ν = 1 - (a^2 α + b^2 β - c y)/(π a^2)    α = atan2(y, x)    β = atan2(y, c - x)
        x = ((c - b) (c + b) + a^2)/(2 c)    y = sqrt((a - x) (a + x))

    The air density is density_factor times either an exponential in height or the density of Harris and Priester, which
    varies between a night value and a bulge value with cos^n of half the angle from the bulge, 30 deg behind the Sun.

    Frame: inertial (GCRS axes), with positions relative to the body's centre; t is simulation time.

    Sources: Meeus 1998, chapter 25 (Sun); Montenbruck and Gill 2000, section 3 (Moon, air); Capitaine, Wallace and
    Chapront 2003 (pole); Alken et al. 2025 (IGRF-14). See docs/systems/earth_pointing.md.
    """

    central_body = Parameter(CelestialBody)
    epoch = space.EPOCH.parameter()
    tt_minus_ut1 = space.TT_MINUS_UT1.parameter()
    atmosphere = Parameter(Atmosphere, start=Atmosphere.HARRIS_PRIESTER, description="model of the air density")
    density_factor = Parameter(
        1.0, unit="1", minimum=0.0, description="ratio of actual to modelled air density; 0.1 to 4 over a solar cycle"
    )
    bulge_exponent = Parameter(
        4.0,
        unit="1",
        minimum=2.0,
        maximum=6.0,
        description="exponent of the diurnal density bulge: 2 for low inclination, 6 for polar orbits",
    )
    magnetic_degree = Parameter(
        8, minimum=1, maximum=13, description="highest degree of the geomagnetic field model; 1: dipole"
    )
    pole_axes = State(PlanetAxes, frozen=True)
    sun = State(
        [1.5e11, 0.0, 0.0],
        unit="m",
        frame="inertial",
        frozen=True,
        description="position of the Sun relative to the centre of the central body",
    )
    third_body = State(
        [4e8, 0.0, 0.0],
        unit="m",
        frame="inertial",
        frozen=True,
        description="position of the Moon, or of the Earth, relative to the centre of the central body",
    )
    field_coefficients = State(
        zeros(SIZE, SIZE), frozen=True, description="coefficients of the geomagnetic field model at the epoch, nT"
    )

    def fill(self) -> None:
        """Set the coefficients of the magnetic field."""
        self.field_coefficients = igrf14(self.epoch)

    def locate(self, t: float) -> None:
        """Set the pole axes and the positions of the Sun and the third body (m, inertial) for t (s)."""
        time = self.epoch + t
        moon = moon_position(time)
        if self.central_body == CelestialBody.EARTH:
            self.pole_axes = earth_axes(time, self.tt_minus_ut1)
            self.sun = sun_position(time)
            self.third_body = moon
        else:
            self.pole_axes = moon_axes(time)
            self.sun = sun_position(time) - moon
            self.third_body = -moon

    def moon(self) -> Vector3:
        """Return the position of the Moon (m, inertial) relative to the central body's centre."""
        if self.central_body == CelestialBody.EARTH:
            return self.third_body
        return vector(0.0, 0.0, 0.0)

    def planet_angle_at(self, t: float) -> float:
        """Return the rotation angle (rad, 0 to 2 pi) of the prime meridian at t (s)."""
        turns = angle_at(self.pole_axes, self.epoch + t) / (2.0 * math.pi)
        return 2.0 * math.pi * (turns - float(math.floor(turns)))

    def radius(self) -> float:
        """Return the radius (m) of the central body that defines its surface and its shadow."""
        if self.central_body == CelestialBody.EARTH:
            return EQUATORIAL_RADIUS
        return MOON_SHADOW_RADIUS

    def height(self, r: Vector3) -> float:
        """Return the height (m) above the Earth's ellipsoid or the Moon's sphere."""
        if self.central_body == CelestialBody.EARTH:
            north = dot(self.pole_axes.pole, r)
            x = dot(self.pole_axes.first, r)
            y = dot(self.pole_axes.second, r)
            return geodetic_height(math.sqrt(x * x + y * y), north)
        return norm(r) - MOON_SHADOW_RADIUS

    def flux_density(self, t: float, r: Vector3) -> Vector3:
        """Return the magnetic flux density (T, inertial)."""
        if self.central_body == CelestialBody.EARTH:
            fixed = fixed_axes(self.pole_axes, self.epoch + t)
            b = magnetic_field.magnetic_field(to_fixed(fixed, r), self.field_coefficients, self.magnetic_degree)
            return from_fixed(fixed, b)
        return vector(0.0, 0.0, 0.0)

    def air_density(self, t: float, r: Vector3) -> float:
        """Return the air density (kg/m3) at a position (m, inertial) and time (s)."""
        if self.central_body == CelestialBody.EARTH:
            if self.atmosphere == Atmosphere.EXPONENTIAL:
                return self.density_factor * exponential_density(self.height(r))
            if self.atmosphere == Atmosphere.HARRIS_PRIESTER:
                bulge = bulge_fraction(r, self.sun / norm(self.sun), self.bulge_exponent)
                return self.density_factor * harris_priester_density(self.height(r), bulge)
        return 0.0

    def is_below_air(self, r: Vector3) -> bool:
        """Return True if a position is below the tables of air density; the density at 100 km is used there."""
        if self.central_body == CelestialBody.EARTH and self.atmosphere != Atmosphere.VACUUM:
            return self.height(r) < LOWEST_AIR
        return False

    def air_velocity(self, r: Vector3) -> Vector3:
        """Return the velocity (m/s, inertial) of the air, which rotates with the planet."""
        return self.pole_axes.rate * cross(self.pole_axes.pole, r)

    def light(self, r: Vector3) -> float:
        """Return the visible fraction of the Sun's disk."""
        return illumination(r, self.sun, self.radius())
