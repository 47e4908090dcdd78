"""Spacecraft about an Earth whose gravity does not depend on longitude."""

from perilune import Spacecraft, zeros
from perilune.fmus_src.mathlib.space.earth_gravity import earth_gravity
from perilune.fmus_src.mathlib.space.harmonics import SIZE


class ZonalSpacecraft(Spacecraft):
    """Spacecraft under the zonal harmonics of the Earth."""

    def fill_gravity(self) -> None:
        """Set the coefficients of order 0."""
        cs = earth_gravity()
        self.gravity_coefficients = zeros(SIZE, SIZE)
        for n in range(SIZE):
            self.gravity_coefficients[n, 0] = cs[n, 0]
