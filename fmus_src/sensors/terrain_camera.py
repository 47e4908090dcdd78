"""Camera that determines position over mapped terrain."""

from ..block import Parameter
from ..interfaces.ports import landing, sampling
from ..mathlib.lunar.gravity import altitude_of
from ..mathlib.rng import normals
from .random_sensor import RandomSensor


class TerrainCamera(RandomSensor):
    """Terrain camera that measures position between minimum_altitude and maximum_altitude, with white errors.

        r_m = r + (altitude_error h + noise_sigma) n

    The first sample is at the start. Outside this range of altitude the output and the count keep their last values,
    which are 0 before the first sample. Random numbers are drawn at every sample, so that they depend on seed, stream
    and sample number only.

    Frame: landing site.

    Assumes mapped terrain in sight over the whole range.

    See docs/systems/lunar_landing.md.
    """

    altitude_error = Parameter(
        0.0015,
        unit="1",
        minimum=0.0,
        description="position error proportional to altitude, as a fraction of the altitude, 1 sigma per axis",
    )
    noise_sigma = landing.NOISE_SIGMA.parameter(2.0, "constant part of the position error, 1 sigma per axis")
    minimum_altitude = Parameter(500.0, unit="m", description="lowest altitude at which the sensor measures")
    maximum_altitude = landing.MAXIMUM_ALTITUDE.parameter()
    moon_radius = landing.MOON_RADIUS.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter(5.0)
    seed, stream = sampling.random_stream()
    position = landing.POSITION.input("true position of the lander relative to the landing site")
    measured_position = landing.POSITION.output(
        "measured position of the lander relative to the landing site", direct=True
    )
    sample_count = sampling.SAMPLE_COUNT.output(
        "number of samples within range since the start; a change signals a new sample", direct=True
    )
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample if the altitude is within the range."""
        altitude = altitude_of(self.position, self.moon_radius)
        in_band = altitude >= self.minimum_altitude and altitude <= self.maximum_altitude
        sigma = self.altitude_error * abs(altitude) + self.noise_sigma
        error = normals(self.generator)
        if in_band:
            self.measured_position = self.position + sigma * error
            self.sample_count = self.sample_count + 1
