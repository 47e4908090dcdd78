"""Gravity on a spacecraft about Earth or Moon."""

from ..block import Parameter, State
from ..interfaces.ports.space import CelestialBody
from ..kernel.matrices import zeros
from ..mathlib.space import earth_gravity, moon_gravity
from ..mathlib.space.ephemerides import EARTH_PARAMETER, MOON_PARAMETER, SUN_PARAMETER, third_body_acceleration
from ..mathlib.space.harmonics import SIZE, gradient
from ..mathlib.space.orientation import fixed_axes, from_fixed, to_fixed
from ..mathlib.vectors import Vector3, vector
from .space_model import SpaceModel


class GravityField(SpaceModel, interface=True):
    """Gravity of the central body in spherical harmonics, and tidal acceleration by two other bodies.

    With harmonics of degree n and order m, and third bodies b of gravitational parameters μ_b at positions s_b:

        U = (μ/r) Σ_nm (R/r)^n P_nm(sin φ) (C_nm cos(m λ) + S_nm sin(m λ))
        g = ∇U + Σ_b μ_b ((s_b - r)/|s_b - r|^3 - s_b/|s_b|^3)

    Sources: Cunningham 1970 (recursion); GGM03S (Earth, Tapley et al. 2007) and LP165P (Moon, Konopliv et al. 2001).
    """

    gravity_degree = Parameter(
        13, minimum=0, maximum=13, description="highest degree of the gravity field model; at most 8 for the Moon"
    )
    third_bodies = Parameter(
        True, description="true: gravity of the Sun and of the Moon (of the Earth for an orbit about the Moon) included"
    )
    gravity_coefficients = State(
        zeros(SIZE, SIZE), frozen=True, description="unnormalised coefficients of the gravity field model"
    )

    def fill_gravity(self) -> None:
        """Set the coefficients of the central body's gravity field."""
        if self.central_body == CelestialBody.EARTH:
            self.gravity_coefficients = earth_gravity.earth_gravity()
        else:
            self.gravity_coefficients = moon_gravity.moon_gravity()

    def gravity_parameter(self) -> float:
        """Return the gravitational parameter (m3/s2) of the central body."""
        if self.central_body == CelestialBody.EARTH:
            return earth_gravity.GRAVITATIONAL_PARAMETER
        return moon_gravity.GRAVITATIONAL_PARAMETER

    def gravity(self, t: float, r: Vector3) -> Vector3:
        """Return the gravity (m/s2, inertial) of the central body at r (m, inertial) and simulation time t (s)."""
        radius = earth_gravity.RADIUS
        if self.central_body == CelestialBody.MOON:
            radius = moon_gravity.RADIUS
        fixed = fixed_axes(self.pole_axes, self.epoch + t)
        mu = self.gravity_parameter()
        return from_fixed(
            fixed, gradient(to_fixed(fixed, r), mu, radius, self.gravity_coefficients, self.gravity_degree)
        )

    def third_body_gravity(self, r: Vector3) -> Vector3:
        """Return the gravity of the third bodies minus the central body's acceleration by them (m/s2, inertial)."""
        if not self.third_bodies:
            return vector(0.0, 0.0, 0.0)
        other = MOON_PARAMETER
        if self.central_body == CelestialBody.MOON:
            other = EARTH_PARAMETER
        sun = third_body_acceleration(r, self.sun, SUN_PARAMETER)
        return sun + third_body_acceleration(r, self.third_body, other)
