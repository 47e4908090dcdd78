"""Sensor of path angle and altitude with relative errors."""

from ..block import Input, Parameter
from ..interfaces.ports import landing, sampling
from ..mathlib.rng import uniform
from .random_sensor import RandomSensor


class PlanarStateSensor(RandomSensor):
    """Sensor of path angle and altitude with uniform relative errors, independent from sample to sample.

        θ_m = θ (1 + path_angle_noise u_1)    h_m = h (1 + altitude_noise u_2)

    with u_1, u_2 uniform on (-1, 1).

    Assumes no bias and no delay.

    Source: Diveev, Pupkov and Sofronova 2013, table 2.
    """

    default_step = 0.01

    path_angle_noise = Parameter(
        0.0, unit="1", minimum=0.0, description="largest relative error of the measured path angle"
    )
    altitude_noise = Parameter(
        0.0, unit="1", minimum=0.0, description="largest relative error of the measured altitude"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.01)
    seed, stream = sampling.random_stream()
    path_angle = Input(0.0, unit="rad", description="true angle from the local vertical to the velocity")
    altitude = landing.ALTITUDE.input("true altitude of the lander")
    measured_path_angle = landing.MEASURED_PATH_ANGLE.output(
        "measured angle from the local vertical to the velocity", start=0.0, direct=("path_angle",)
    )
    measured_altitude = landing.MEASURED_ALTITUDE.output("measured altitude of the lander", direct=("altitude",))
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample."""
        error = uniform(self.generator)
        self.measured_path_angle = self.path_angle * (1.0 + self.path_angle_noise * (2.0 * error - 1.0))
        error = uniform(self.generator)
        self.measured_altitude = self.altitude * (1.0 + self.altitude_noise * (2.0 * error - 1.0))
        self.sample_count = self.sample_count + 1
