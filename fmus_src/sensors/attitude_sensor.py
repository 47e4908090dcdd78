"""Thrust axis and its angular rate, as an attitude system measures them."""

from ..block import Parameter, State
from ..interfaces.ports import landing, sampling
from ..mathlib.rng import normals
from ..mathlib.vectors import Vector3, cross, norm
from ..units import deg
from .random_sensor import RandomSensor


class AttitudeSensor(RandomSensor):
    """The thrust axis turned by a small rotation, and its angular rate with white errors.

    measured_attitude is the unit vector along d + e x d, where e has a constant part, drawn at the start with
    constant_sigma per axis, and one of attitude_sigma per axis that is new in every sample; measured_angular_rate has
    an error of rate_sigma per axis, new in every sample. The first sample is at the start. Which normal numbers a
    flight uses depends on seed, stream and the sample's number only. Frame: landing site.
    Assumes errors that do not depend on the motion. They are ours: docs/systems/hover_transfer.md.
    """

    constant_sigma = Parameter(
        deg(0.05), unit="rad", minimum=0.0, description="constant error, 1 sigma per axis; 0.05 deg"
    )
    attitude_sigma = Parameter(
        deg(0.015), unit="rad", minimum=0.0, description="white error, 1 sigma per axis; 0.015 deg"
    )
    rate_sigma = Parameter(
        3.490658503988659e-4, unit="rad/s", minimum=0.0, description="white error of the rate, 1 sigma per axis"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.0)
    seed, stream = sampling.random_stream()
    attitude = landing.DIRECTION.input("true unit vector of thrust")
    angular_rate = landing.ANGULAR_RATE.input("true angular rate")
    measured_attitude = landing.DIRECTION.output("measured unit vector of thrust", direct=True)
    measured_angular_rate = landing.ANGULAR_RATE.output("measured angular rate", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()
    misalignment = State(
        [0.0] * 3, unit="rad", frame="landing site", description="rotation vector of the constant error"
    )

    def draw_constants(self) -> None:
        constant = normals(self.generator)
        self.misalignment = self.constant_sigma * constant

    def turn(self, axis: Vector3, rotation: Vector3) -> Vector3:
        """Return an axis after a small rotation (rad); as it is where it has no length."""
        moved = axis + cross(rotation, axis)
        length = norm(moved)
        if length > 0.0:
            return moved / length
        return axis

    def measure(self) -> None:
        """Take a sample."""
        numbers = normals(self.generator)
        self.measured_attitude = self.turn(self.attitude, self.misalignment + self.attitude_sigma * numbers)
        numbers = normals(self.generator)
        self.measured_angular_rate = self.angular_rate + self.rate_sigma * numbers
        self.sample_count = self.sample_count + 1
