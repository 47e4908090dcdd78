"""Radar altimeter."""

from ..block import Parameter
from ..interfaces.ports import landing, sampling
from ..mathlib.lunar.gravity import altitude_of
from ..mathlib.rng import normal
from .random_sensor import RandomSensor


class RadarAltimeter(RandomSensor):
    """Radar altimeter up to maximum_altitude, with white errors.

        h_m = h + (range_error h + noise_sigma) n

    The first sample is at the start. Above maximum_altitude the output and the count keep their last values, which are
    0 before the first sample. Random numbers are drawn at every sample, so that they depend on seed, stream and sample
    number only.

    Frame: landing site.

    Assumes a smooth spherical Moon without terrain.

    See docs/systems/lunar_landing.md.
    """

    range_error = Parameter(
        0.005,
        unit="1",
        minimum=0.0,
        description="altitude error proportional to altitude, as a fraction of the altitude, 1 sigma",
    )
    noise_sigma = landing.NOISE_SIGMA.parameter()
    maximum_altitude = landing.MAXIMUM_ALTITUDE.parameter()
    moon_radius = landing.MOON_RADIUS.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter(1.0)
    seed, stream = sampling.random_stream()
    position = landing.POSITION.input("true position of the lander relative to the landing site")
    measured_altitude = landing.MEASURED_ALTITUDE.output(direct=True)
    sample_count = sampling.SAMPLE_COUNT.output(
        "number of samples within range since the start; a change signals a new sample", direct=True
    )
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample if the ground is within range."""
        error = normal(self.generator)
        altitude = altitude_of(self.position, self.moon_radius)
        if altitude <= self.maximum_altitude:
            self.measured_altitude = altitude + (self.range_error * abs(altitude) + self.noise_sigma) * error
            self.sample_count = self.sample_count + 1
