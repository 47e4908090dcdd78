"""Spacecraft in air about a sphere."""

from perilune import Parameter, Spacecraft, Vector3, exp, norm


class RoundAir(Spacecraft):
    """Spacecraft in air whose density depends on the distance from the centre of the Earth alone."""

    ground_radius = Parameter(6378137.0, unit="m", minimum=1.0, description="radius from which heights count")
    reference_density = Parameter(9.518e-12, unit="kg/m3", minimum=0.0, description="density at reference_height")
    reference_height = Parameter(350e3, unit="m", description="height of reference_density")
    scale_height = Parameter(53298.0, unit="m", minimum=1.0, description="height over which the density falls by e")

    def air_density(self, t: float, r: Vector3) -> float:
        """Return the density (kg/m3) at a position r (m, inertial), t in simulation time (s)."""
        height = norm(r) - self.ground_radius
        return self.reference_density * exp((self.reference_height - height) / self.scale_height)
