"""Doppler velocimeter."""

from ..block import Parameter
from ..interfaces.ports import landing, sampling
from ..mathlib.lunar.gravity import altitude_of
from ..mathlib.rng import normals
from ..mathlib.vectors import norm
from .random_sensor import RandomSensor


class DopplerVelocimeter(RandomSensor):
    """Doppler velocimeter up to maximum_altitude, with white errors.

        v_m = v + (speed_error |v| + noise_sigma) n

    The error in each axis grows with the total speed, since each beam measures a mixture of the axes. The first sample
    is at the start. Above maximum_altitude the output and the count keep their last values, which are 0 before the
    first sample. Random numbers are drawn at every sample, so that they depend on seed, stream and sample number only.

    Frame: landing site, with known attitude.

    Assumes that all beams reach the ground.

    See docs/systems/lunar_landing.md.
    """

    speed_error = Parameter(
        0.001,
        unit="1",
        minimum=0.0,
        description="velocity error proportional to speed, as a fraction of the speed, 1 sigma per axis",
    )
    noise_sigma = Parameter(
        0.05, unit="m/s", minimum=0.0, description="constant part of the velocity error, 1 sigma per axis"
    )
    maximum_altitude = landing.MAXIMUM_ALTITUDE.parameter(
        5e3, description="highest altitude at which the sensor measures"
    )
    moon_radius = landing.MOON_RADIUS.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter()
    seed, stream = sampling.random_stream()
    position = landing.POSITION.input("true position of the lander relative to the landing site")
    velocity = landing.VELOCITY.input("true velocity of the lander relative to the landing site")
    measured_velocity = landing.VELOCITY.output(
        "measured velocity of the lander relative to the landing site", direct=True
    )
    sample_count = sampling.SAMPLE_COUNT.output(
        "number of samples within range since the start; a change signals a new sample", direct=("position",)
    )
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample if the ground is within range."""
        in_range = altitude_of(self.position, self.moon_radius) <= self.maximum_altitude
        sigma = self.speed_error * norm(self.velocity) + self.noise_sigma
        error = normals(self.generator)
        if in_range:
            self.measured_velocity = self.velocity + sigma * error
            self.sample_count = self.sample_count + 1
