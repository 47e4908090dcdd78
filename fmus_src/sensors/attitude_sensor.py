"""Sensor of the thrust axis and its angular rate."""

from ..block import Parameter, State
from ..interfaces.ports import landing, sampling
from ..mathlib.rng import normals
from ..mathlib.vectors import Vector3, cross, norm
from ..units import deg
from .random_sensor import RandomSensor


class AttitudeSensor(RandomSensor):
    """Sensor of a thrust axis and its angular rate, with constant and white errors.

        d_m = (d + e × d)/|d + e × d|    e = e_0 + attitude_sigma n    ω_m = ω + rate_sigma n

    The constant error e_0 has constant_sigma per axis. The first sample is at the start. Random numbers depend on seed,
    stream and sample number only.

    Frame: landing site.

    Assumes errors independent of the motion.

    See docs/systems/hover_transfer.md.
    """

    constant_sigma = Parameter(
        deg(0.05), unit="rad", minimum=0.0, description="constant error of the measured thrust axis, 1 sigma per axis"
    )
    attitude_sigma = Parameter(
        deg(0.015), unit="rad", minimum=0.0, description="white noise of the measured thrust axis, 1 sigma per axis"
    )
    rate_sigma = Parameter(
        3.490658503988659e-4,
        unit="rad/s",
        minimum=0.0,
        description="white noise of the measured angular rate, 1 sigma per axis",
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.0)
    seed, stream = sampling.random_stream()
    attitude = landing.DIRECTION.input("true thrust axis, unit vector")
    angular_rate = landing.ANGULAR_RATE.input("true angular rate of the thrust axis")
    measured_attitude = landing.DIRECTION.output("measured thrust axis, unit vector", direct=True)
    measured_angular_rate = landing.ANGULAR_RATE.output("measured angular rate of the thrust axis", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()
    misalignment = State(
        [0.0] * 3,
        unit="rad",
        frame="landing site",
        description="rotation vector of the constant error of the measured thrust axis",
    )

    def draw_constants(self) -> None:
        constant = normals(self.generator)
        self.misalignment = self.constant_sigma * constant

    def turn(self, axis: Vector3, rotation: Vector3) -> Vector3:
        """Return an axis turned by a small rotation (rad); an axis of length 0 is returned unchanged."""
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
