"""A Doppler velocimeter."""

from ..block import Parameter
from ..interfaces.ports import landing, sampling
from ..mathlib.lunar.gravity import altitude_of
from ..mathlib.rng import normals
from ..mathlib.vectors import norm
from .random_sensor import RandomSensor


class DopplerVelocimeter(RandomSensor):
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
    maximum_altitude = landing.MAXIMUM_ALTITUDE.parameter(5e3)
    moon_radius = landing.MOON_RADIUS.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter()
    seed, stream = sampling.random_stream()
    position = landing.POSITION.input("true position")
    velocity = landing.VELOCITY.input("true velocity")
    measured_velocity = landing.VELOCITY.output("measured velocity", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output(
        "samples in range; tells a new one from a held one", direct=("position",)
    )
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample where the ground is in range."""
        in_range = altitude_of(self.position, self.moon_radius) <= self.maximum_altitude
        sigma = self.speed_error * norm(self.velocity) + self.noise_sigma
        error = normals(self.generator)
        if in_range:
            self.measured_velocity = self.velocity + sigma * error
            self.sample_count = self.sample_count + 1
