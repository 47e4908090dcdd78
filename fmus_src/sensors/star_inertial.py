"""Attitude from star trackers and gyroscopes together."""

from ..block import Parameter
from ..interfaces.ports import robot, sampling
from ..mathlib.attitude.quaternion import from_rotation_vector, multiply, normalise
from ..mathlib.rng import normals
from .random_sensor import RandomSensor


class StarInertial(RandomSensor):
    """Star-inertial attitude: the true quaternion turned by a small rotation, new in every sample.

    The rotation vector has normal, independent components of attitude_sigma in body axes. The first
    sample is at the start. Which normal numbers a flight uses depends on seed, stream and the
    sample's number only. Source: Somov, Butyrin, Somov and Somova, see docs/systems/robot_rendezvous.md.
    Assumes errors that are small and alike about all axes, without bias.
    """

    default_step = 0.125

    attitude_sigma = Parameter(
        4.84813681109536e-6, unit="rad", minimum=0.0, description="error, 1 sigma per axis; 1 arcsec"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.125)
    seed, stream = sampling.random_stream()
    quaternion = robot.QUATERNION.input("true attitude, body to inertial, scalar first")
    measured_quaternion = robot.MEASURED_QUATERNION.output("measured, from body to inertial, scalar first", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample."""
        numbers = normals(self.generator)
        error = from_rotation_vector(self.attitude_sigma * numbers)
        self.measured_quaternion = normalise(multiply(self.quaternion, error))
        self.sample_count = self.sample_count + 1
