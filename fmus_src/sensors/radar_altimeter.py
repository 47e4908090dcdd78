"""A radar altimeter."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.gravity import altitude_of
from ..mathlib.rng import normal, seed_streams


class RadarAltimeter(Block):
    """Measures the altitude above the sphere, at maximum_altitude and below, with an error new in every sample.

    The error's sigma is range_error times altitude plus noise_sigma. The first sample is at the
    start. Above maximum_altitude output and count are held, 0 before the first sample; random
    numbers are drawn all the same, so that the error of sample k depends on seed, stream and k only,
    whatever path was flown before. Frame: landing site.
    Assumes a smooth sphere, without terrain. Errors are ours: docs/systems/lunar_landing.md.
    """

    range_error = Parameter(0.005, unit="1", minimum=0.0, description="error over altitude, 1 sigma")
    noise_sigma = Parameter(1.0, unit="m", minimum=0.0, description="constant part of the error, 1 sigma")
    maximum_altitude = Parameter(2e4, unit="m", description="measures at this altitude and below")
    moon_radius = Parameter(1.7374e6, unit="m", minimum=1.0, description="of the sphere that the site lies on")
    sample_period = Parameter(1.0, unit="s", minimum=0.0, description="between samples; 0: every communication point")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    position = Input([0.0, 0.0, 0.0], unit="m", frame="landing site", description="true position")
    measured_altitude = Output(0.0, unit="m", direct=True, description="altitude above the sphere of moon_radius")
    sample_count = Output(0, direct=True, description="samples in range; tells a new one from a held one")
    generator = State([0.0] * 6, frozen=True, description="random number generator")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure()

    def measure(self) -> None:
        """Take a sample where the ground is in range."""
        error = normal(self.generator)
        altitude = altitude_of(self.position, self.moon_radius)
        if altitude <= self.maximum_altitude:
            self.measured_altitude = altitude + (self.range_error * abs(altitude) + self.noise_sigma) * error
            self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        self.measure()
