"""A Doppler velocimeter."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.gravity import altitude_of
from ..mathlib.rng import normals, seed_streams
from ..mathlib.vectors import norm


class DopplerVelocimeter(Block):
    """Measures the velocity, at maximum_altitude and below, with errors new in every sample.

    Each axis has an error of sigma speed_error times speed (the length of the velocity: beams mix
    the axes) plus noise_sigma. The first sample is at the start. Above maximum_altitude output and
    count are held, 0 before the first sample; random numbers are drawn all the same, so that the
    errors of sample k depend on seed, stream and k only, whatever path was flown before. Frame:
    landing site, the attitude being known.
    Assumes beams that always find the ground. Errors are ours: docs/systems/lunar_landing.md.
    """

    speed_error = Parameter(0.001, unit="1", minimum=0.0, description="error over speed, 1 sigma per axis")
    noise_sigma = Parameter(0.05, unit="m/s", minimum=0.0, description="constant part of the error, 1 sigma per axis")
    maximum_altitude = Parameter(5e3, unit="m", description="measures at this altitude and below")
    moon_radius = Parameter(1.7374e6, unit="m", minimum=1.0, description="of the sphere that the site lies on")
    sample_period = Parameter(0.2, unit="s", minimum=0.0, description="between samples; 0: every communication point")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    position = Input([0.0, 0.0, 0.0], unit="m", frame="landing site", description="true position")
    velocity = Input([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="true velocity")
    measured_velocity = Output(
        [0.0, 0.0, 0.0], unit="m/s", frame="landing site", direct=True, description="measured velocity"
    )
    sample_count = Output(0, direct=("position",), description="samples in range; tells a new one from a held one")
    generator = State([0.0] * 6, frozen=True, description="random number generator")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure()

    def measure(self) -> None:
        """Take a sample where the ground is in range."""
        in_range = altitude_of(self.position, self.moon_radius) <= self.maximum_altitude
        sigma = self.speed_error * norm(self.velocity) + self.noise_sigma
        error = normals(self.generator)
        if in_range:
            self.measured_velocity = self.velocity + sigma * error
            self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        self.measure()
