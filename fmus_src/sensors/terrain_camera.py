"""A camera that finds its place over mapped terrain."""

from ..block import Parameter
from ..interfaces.ports import landing, sampling
from ..mathlib.lunar.gravity import altitude_of
from ..mathlib.rng import normals
from .random_sensor import RandomSensor


class TerrainCamera(RandomSensor):
    """Measures the position from minimum_altitude to maximum_altitude, both included, with errors new in every sample.

    Each axis has an error of sigma altitude_error times altitude plus noise_sigma. The first sample
    is at the start. Outside of the band output and count are held, 0 before the first sample; random
    numbers are drawn all the same, so that the errors of sample k depend on seed, stream and k only,
    whatever path was flown before. Frame: landing site.
    Assumes mapped terrain in sight all over the band. Errors are ours: docs/systems/lunar_landing.md.
    """

    altitude_error = Parameter(0.0015, unit="1", minimum=0.0, description="error over altitude, 1 sigma per axis")
    noise_sigma = landing.NOISE_SIGMA.parameter(2.0, "constant part of the error, 1 sigma per axis")
    minimum_altitude = Parameter(500.0, unit="m", description="measures at this altitude and above")
    maximum_altitude = landing.MAXIMUM_ALTITUDE.parameter()
    moon_radius = landing.MOON_RADIUS.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter(5.0)
    seed, stream = sampling.random_stream()
    position = landing.POSITION.input("true position")
    measured_position = landing.POSITION.output("measured position", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output("samples in the band; tells a new one from a held one", direct=True)
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample where the altitude is in the band."""
        altitude = altitude_of(self.position, self.moon_radius)
        in_band = altitude >= self.minimum_altitude and altitude <= self.maximum_altitude
        sigma = self.altitude_error * abs(altitude) + self.noise_sigma
        error = normals(self.generator)
        if in_band:
            self.measured_position = self.position + sigma * error
            self.sample_count = self.sample_count + 1
