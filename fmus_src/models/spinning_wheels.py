"""Model of four reaction wheels, shared by the plants that have them."""

from ..block import Block, Parameter, State
from ..interfaces.ports import satellite
from ..kernel.matrices import zeros
from ..mathlib.actuators.wheels import WHEELS, drag_torque, unit_axes
from ..mathlib.vectors import Vector3, Vector4, clip, vector

ROUNDING = 1e-9  # relative excess of a command over its limit that is not reported


class SpinningWheels(Block, interface=True):
    """Four equal balanced reaction wheels with motors and friction.

    With wheel speed Ω, commanded torque u_c, its limit u_max, torque factor k and viscous friction coefficient c:

        u = k clip(u_c, u_max) - c Ω - μ sgn Ω

    Coulomb friction μ falls linearly to 0 at wheel speeds below coulomb_band. At or beyond speed_limit a wheel receives
    no motor torque that would accelerate it; the limit is evaluated at the start of each integration step.

    Source: Schaub and Junkins 2018, section 4.5; Alcorn, Allard and Schaub 2018.
    """

    wheel_axes = satellite.WHEEL_AXES.parameter()
    wheel_inertia = satellite.WHEEL_INERTIA.parameter()
    motor_torque_limit = satellite.MOTOR_TORQUE_LIMIT.parameter()
    torque_factor = Parameter(
        [1.0] * 4,
        unit="1",
        minimum=0.0,
        description="ratio of actual to commanded torque of each motor; 0: failed motor",
    )
    speed_limit = Parameter(
        418.87902047863906, unit="rad/s", minimum=0.0, description="largest magnitude of a wheel's speed; 0: no limit"
    )
    viscous_friction = Parameter(
        1e-5, unit="N.m.s", minimum=0.0, description="viscous friction coefficient of each wheel"
    )
    coulomb_friction = Parameter(
        5e-4, unit="N.m", minimum=0.0, description="Coulomb friction torque of each wheel above coulomb_band"
    )
    coulomb_band = Parameter(
        0.1, unit="rad/s", minimum=1e-6, description="wheel speed below which Coulomb friction falls linearly to 0"
    )
    initial_wheel_speeds = satellite.WHEEL_SPEEDS.parameter(
        description="initial angular rates of the wheels relative to the body"
    )
    motor_torques = satellite.MOTOR_TORQUES.input("commanded torque of each motor on its wheel")
    wheel_speeds = satellite.WHEEL_SPEEDS.output()
    wheel_momentum = satellite.WHEEL_MOMENTUM.output("angular momentum of the wheels relative to the body")
    applied_torques = satellite.MOTOR_TORQUES.output(
        "torque of each motor on its wheel, over the last integration step"
    )
    spin = State(
        [0.0] * 4,
        unit="N.m.s",
        description="angular momentum of each wheel about its spin axis, relative to the inertial frame",
    )
    axes = State(zeros(3, WHEELS), unit="1", frame="body", description="unit spin axes of the wheels, one per column")

    def start_wheels(self, w: Vector3) -> None:
        """Initialise the wheels on a body with the angular velocity w (rad/s, body)."""
        self.axes = unit_axes(self.wheel_axes)
        self.wheel_speeds = self.initial_wheel_speeds
        self.spin = self.wheel_inertia * (self.wheel_speeds + self.axes.T @ w)
        self.wheel_momentum = self.wheel_inertia * (self.axes @ self.wheel_speeds)

    def speeds(self, spin: Vector4, w: Vector3) -> Vector4:
        """Return the wheel speeds (rad/s) relative to a body with the angular velocity w (rad/s, body)."""
        return spin / self.wheel_inertia - self.axes.T @ w

    def drag(self, speed: float) -> float:
        """Return the friction torque (N m) on a wheel at its speed (rad/s)."""
        return drag_torque(speed, self.viscous_friction, self.coulomb_friction, self.coulomb_band)

    def drags(self, speeds: Vector4) -> Vector4:
        """Return the friction torques (N m) on the wheels at their speeds (rad/s)."""
        return vector(self.drag(speeds.w), self.drag(speeds.x), self.drag(speeds.y), self.drag(speeds.z))

    def drive(self, commands: Vector4) -> tuple[bool, bool]:
        """Set applied_torques from commands (N m); return True for a limited torque, and True for a limited speed."""
        applied = [0.0] * WHEELS
        torque_limited = False
        speed_limited = False
        for j in range(WHEELS):
            speed = self.wheel_speeds[j]
            torque = clip(commands[j], -self.motor_torque_limit, self.motor_torque_limit)
            if abs(commands[j]) > self.motor_torque_limit * (1.0 + ROUNDING):
                torque_limited = True
            if self.speed_limit > 0.0 and abs(speed) >= self.speed_limit and torque * speed > 0.0:
                speed_limited = True
                torque = 0.0
            applied[j] = self.torque_factor[j] * torque
        self.applied_torques = vector(*applied)
        return torque_limited, speed_limited

    def set_wheel_outputs(self, w: Vector3) -> None:
        """Set the wheels' outputs on a body with the angular velocity w (rad/s, body)."""
        self.wheel_speeds = self.speeds(self.spin, w)
        self.wheel_momentum = self.wheel_inertia * (self.axes @ self.wheel_speeds)
