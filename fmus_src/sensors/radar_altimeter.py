"""A radar altimeter."""

from ..block import Parameter
from ..interfaces.ports import landing, sampling
from ..mathlib.lunar.gravity import altitude_of
from ..mathlib.rng import normal
from .random_sensor import RandomSensor


class RadarAltimeter(RandomSensor):
    """Measures the altitude above the sphere, at maximum_altitude and below, with an error new in every sample.

    The error's sigma is range_error times altitude plus noise_sigma. The first sample is at the
    start. Above maximum_altitude output and count are held, 0 before the first sample; random
    numbers are drawn all the same, so that the error of sample k depends on seed, stream and k only,
    whatever path was flown before. Frame: landing site.
    Assumes a smooth sphere, without terrain. Errors are ours: docs/systems/lunar_landing.md.
    """

    range_error = Parameter(0.005, unit="1", minimum=0.0, description="error over altitude, 1 sigma")
    noise_sigma = landing.NOISE_SIGMA.parameter()
    maximum_altitude = landing.MAXIMUM_ALTITUDE.parameter()
    moon_radius = landing.MOON_RADIUS.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter(1.0)
    seed, stream = sampling.random_stream()
    position = landing.POSITION.input("true position")
    measured_altitude = landing.MEASURED_ALTITUDE.output(direct=True)
    sample_count = sampling.SAMPLE_COUNT.output("samples in range; tells a new one from a held one", direct=True)
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample where the ground is in range."""
        error = normal(self.generator)
        altitude = altitude_of(self.position, self.moon_radius)
        if altitude <= self.maximum_altitude:
            self.measured_altitude = altitude + (self.range_error * abs(altitude) + self.noise_sigma) * error
            self.sample_count = self.sample_count + 1
