"""Spacecraft in isothermal air."""

from perilune import Parameter, Spacecraft, Vector3, exp


class ThinAir(Spacecraft):
    """Spacecraft in air whose density falls by a factor of e over each scale height."""

    density_500 = Parameter(4e-13, unit="kg/m3", minimum=0.0, description="density at 500 km")
    scale_height = Parameter(6e4, unit="m", minimum=1.0, description="height over which it falls by e")

    def air_density(self, t: float, r: Vector3) -> float:
        """Return the density (kg/m3) at a position r (m, inertial) and a simulation time t (s)."""
        return self.density_500 * exp((5e5 - self.height(r)) / self.scale_height)
