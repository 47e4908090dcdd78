"""A camera that finds its place over mapped terrain."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.gravity import altitude_of
from ..mathlib.rng import normals, seed_streams


class TerrainCamera(Block):
    """Measures the position from minimum_altitude to maximum_altitude, both included, with errors new in every sample.

    Each axis has an error of sigma altitude_error times altitude plus noise_sigma. The first sample
    is at the start. Outside of the band output and count are held, 0 before the first sample; random
    numbers are drawn all the same, so that the errors of sample k depend on seed, stream and k only,
    whatever path was flown before. Frame: landing site.
    Assumes mapped terrain in sight all over the band. Errors are ours: docs/systems/lunar_landing.md.
    """

    altitude_error = Parameter(0.0015, unit="1", minimum=0.0, description="error over altitude, 1 sigma per axis")
    noise_sigma = Parameter(2.0, unit="m", minimum=0.0, description="constant part of the error, 1 sigma per axis")
    minimum_altitude = Parameter(500.0, unit="m", description="measures at this altitude and above")
    maximum_altitude = Parameter(2e4, unit="m", description="measures at this altitude and below")
    moon_radius = Parameter(1.7374e6, unit="m", minimum=1.0, description="of the sphere that the site lies on")
    sample_period = Parameter(5.0, unit="s", minimum=0.0, description="between samples; 0: every communication point")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    position = Input([0.0, 0.0, 0.0], unit="m", frame="landing site", description="true position")
    measured_position = Output(
        [0.0, 0.0, 0.0], unit="m", frame="landing site", direct=True, description="measured position"
    )
    sample_count = Output(0, direct=True, description="samples in the band; tells a new one from a held one")
    generator = State([0.0] * 6, frozen=True, description="random number generator")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure()

    def measure(self) -> None:
        """Take a sample where the altitude is in the band."""
        altitude = altitude_of(self.position, self.moon_radius)
        in_band = altitude >= self.minimum_altitude and altitude <= self.maximum_altitude
        sigma = self.altitude_error * abs(altitude) + self.noise_sigma
        error = normals(self.generator)
        if in_band:
            self.measured_position = self.position + sigma * error
            self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        self.measure()
