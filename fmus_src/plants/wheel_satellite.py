"""A satellite that is turned by four reaction wheels."""

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import body, robot, sampling, satellite
from ..kernel.enumerations import Enumeration, member
from ..kernel.integrators import count_steps, runge_kutta_4
from ..kernel.matrices import Matrix, inverse, zeros
from ..kernel.records import Field, Record
from ..mathlib.actuators.wheels import WHEELS, drag_torque, unit_axes
from ..mathlib.attitude.quaternion import multiply, normalise, quaternion, to_body, to_reference
from ..mathlib.vectors import Vector3, Vector4, clip, cross, dot, vector

ROUNDING = 1e-9  # by which a command may exceed its limit unreported


class WheelSatelliteStatus(Enumeration):
    """What limits the wheels, or whether the satellite moves."""

    GOOD = member("good")
    TORQUE_LIMITED = member("a motor torque limited")
    SPEED_LIMITED = member("a wheel at its speed limit")
    NO_INERTIA = member("inertia without the wheels' spin not positive, nothing moves")


class SatelliteMotion(Record):
    """Rotation of the satellite and of its wheels; its rates are one more of the same kind."""

    quaternion = Field(Vector4, unit="1", description="attitude, from body to inertial, scalar first")
    angular_momentum = Field(Vector3, unit="N.m.s", frame="inertial", description="G of body and wheels")
    spin = Field(Vector4, unit="N.m.s", description="h = Js (W + g.w) of each wheel about its axis, absolute")


class WheelSatellite(Block):
    """Rigid body with four balanced reaction wheels, under a constant external torque.

    With unit spin axes g, the wheels' speeds W relative to the body and their spin inertia Js, and with I the inertia
    of the whole satellite, wheels included as if they did not spin (Basilisk's convention for balanced wheels):
    (I - sum Js g g') w' = -w x (I w + sum Js W g) - sum us g + L,  W' = us/Js - g.w',  q' = q w/2.
    us is the motor's torque with friction, L = body_torque + inertial_torque. It is integrated as h' = us,
    G' = R(q) L, w = (I - sum Js g g')^-1 (R'(q) G - sum h g), W = h/Js - g.w, with G the angular momentum in
    inertial axes: without L it does not change by a bit, whatever the wheels do. Friction is -viscous_friction W, and
    coulomb_friction against W, in proportion to W within coulomb_band. A motor gives its command times torque_factor,
    within motor_torque_limit; a wheel at or beyond speed_limit gets no motor torque that would make it faster (judged
    at the start of each integration step; friction and the body's own acceleration still act).
    Frames: body, origin at the centre of mass; inertial. Equations: docs/systems/satellite_pointing.md.
    Source: Schaub and Junkins 2018, section 4.5; Alcorn, Allard and Schaub 2018.

    Runge-Kutta of fourth order in steps of internal_step, or equal parts of the communication step no longer than that.
    Assumes rigid bodies, wheels that are alike, balanced and aligned with principal axes of theirs.
    """

    default_step = 0.125

    inertia = satellite.INERTIA.parameter()
    wheel_axes = satellite.WHEEL_AXES.parameter()
    wheel_inertia = satellite.WHEEL_INERTIA.parameter()
    motor_torque_limit = satellite.MOTOR_TORQUE_LIMIT.parameter()
    torque_factor = Parameter(
        [1.0] * 4, unit="1", minimum=0.0, description="torque of each motor over the commanded one; 0: failed"
    )
    speed_limit = Parameter(
        418.87902047863906, unit="rad/s", minimum=0.0, description="largest speed of a wheel, 4000 rpm; 0: no limit"
    )
    viscous_friction = Parameter(1e-5, unit="N.m.s", minimum=0.0, description="of a wheel, torque over speed")
    coulomb_friction = Parameter(5e-4, unit="N.m", minimum=0.0, description="of a wheel, beyond coulomb_band")
    coulomb_band = Parameter(0.1, unit="rad/s", minimum=1e-6, description="speed below which it falls to 0")
    body_torque = body.TORQUE.parameter(description="external torque that is constant in body axes")
    inertial_torque = Parameter(
        [0.0, 0.0, 0.0], unit="N.m", frame="inertial", description="external torque that is constant in inertial axes"
    )
    initial_quaternion = Parameter(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="attitude at the start, from body to inertial, scalar first"
    )
    initial_angular_velocity = body.ANGULAR_VELOCITY.parameter(description="angular velocity at the start")
    initial_wheel_speeds = satellite.WHEEL_SPEEDS.parameter(description="at the start, relative to the body")
    internal_step = sampling.INTERNAL_STEP.parameter(0.0625, minimum=1e-3)
    motor_torques = satellite.MOTOR_TORQUES.input("commanded torque of each motor on its wheel")
    quaternion = robot.QUATERNION.output("attitude, from body to inertial, scalar first, continuous")
    angular_velocity = body.ANGULAR_VELOCITY.output("angular velocity")
    wheel_speeds = satellite.WHEEL_SPEEDS.output()
    wheel_momentum = satellite.WHEEL_MOMENTUM.output("sum Js W g of the wheels, relative to the body")
    angular_momentum = Output(
        [0.0, 0.0, 0.0], unit="N.m.s", frame="inertial", description="G of body and wheels about the centre of mass"
    )
    applied_torques = satellite.MOTOR_TORQUES.output("torque that each motor gave over the last integration step")
    status = Output(WheelSatelliteStatus)
    spin = State([0.0] * 4, unit="N.m.s", description="h = Js (W + g.w) of each wheel about its axis, absolute")
    axes = State(zeros(3, WHEELS), unit="1", frame="body", description="unit spin axes, by column")
    inverse_inertia = State(zeros(3, 3), description="(I - sum Js g g')^-1, 1/(kg m2)")

    def initialize(self) -> None:
        self.axes = unit_axes(self.wheel_axes)
        locked = self.inertia - self.wheel_inertia * self.axes @ self.axes.T
        self.inverse_inertia, invertible = inverse(locked)
        if not (invertible and self.positive(locked)):
            self.status = WheelSatelliteStatus.NO_INERTIA
        self.quaternion = normalise(self.initial_quaternion)
        self.angular_velocity = self.initial_angular_velocity
        self.wheel_speeds = self.initial_wheel_speeds
        self.spin = self.wheel_inertia * (self.wheel_speeds + self.axes.T @ self.angular_velocity)
        self.wheel_momentum = self.wheel_inertia * (self.axes @ self.wheel_speeds)
        momentum = self.inertia @ self.angular_velocity + self.wheel_momentum
        self.angular_momentum = to_reference(self.quaternion, momentum)

    def positive(self, m: Matrix) -> bool:
        """Whether a symmetric matrix is positive definite: its leading minors are positive."""
        second = m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]
        return m[0, 0] > 0.0 and second > 0.0 and dot(m[0:3, 0], cross(m[0:3, 1], m[0:3, 2])) > 0.0

    def rate(self, s: SatelliteMotion) -> Vector3:
        """Angular velocity (rad/s, body)."""
        return self.inverse_inertia @ (to_body(s.quaternion, s.angular_momentum) - self.axes @ s.spin)

    def speeds(self, s: SatelliteMotion, w: Vector3) -> Vector4:
        """Speeds of the wheels (rad/s) relative to a body with the angular velocity w (rad/s)."""
        return s.spin / self.wheel_inertia - self.axes.T @ w

    def drag(self, speed: float) -> float:
        """Friction (N m) on a wheel with a speed (rad/s)."""
        return drag_torque(speed, self.viscous_friction, self.coulomb_friction, self.coulomb_band)

    def derivatives(self, t: float, s: SatelliteMotion, motors: Vector4) -> SatelliteMotion:
        """q' = q w/2, G' = R(q) L and h' = us under motor torques (N m)."""
        w = self.rate(s)
        speeds = self.speeds(s, w)
        drag = vector(
            self.drag(speeds.w),
            self.drag(speeds.x),
            self.drag(speeds.y),
            self.drag(speeds.z),
        )
        return SatelliteMotion(
            quaternion=multiply(s.quaternion, quaternion(0.0, 0.5 * w)),
            angular_momentum=to_reference(s.quaternion, self.body_torque) + self.inertial_torque,
            spin=motors + drag,
        )

    def drive(self) -> None:
        """Set applied_torques within both limits, which the status reports."""
        applied = [0.0] * WHEELS
        for j in range(WHEELS):
            speed = self.wheel_speeds[j]
            torque = clip(self.motor_torques[j], -self.motor_torque_limit, self.motor_torque_limit)
            beyond = abs(self.motor_torques[j]) > self.motor_torque_limit * (1.0 + ROUNDING)
            if beyond and self.status == WheelSatelliteStatus.GOOD:
                self.status = WheelSatelliteStatus.TORQUE_LIMITED
            if self.speed_limit > 0.0 and abs(speed) >= self.speed_limit and torque * speed > 0.0:
                self.status = WheelSatelliteStatus.SPEED_LIMITED
                torque = 0.0
            applied[j] = self.torque_factor[j] * torque
        self.applied_torques = vector(*applied)

    def move(self, t: float, h: float) -> None:
        """Move by h (s)."""
        self.drive()
        s = SatelliteMotion(quaternion=self.quaternion, angular_momentum=self.angular_momentum, spin=self.spin)
        end = runge_kutta_4(self.derivatives, t, s, h, self.applied_torques)
        self.quaternion = normalise(end.quaternion)
        self.angular_momentum = end.angular_momentum
        self.spin = end.spin
        s = SatelliteMotion(quaternion=self.quaternion, angular_momentum=self.angular_momentum, spin=self.spin)
        self.angular_velocity = self.rate(s)
        self.wheel_speeds = self.speeds(s, self.angular_velocity)
        self.wheel_momentum = self.wheel_inertia * (self.axes @ self.wheel_speeds)

    def step(self, t: float, h: float) -> None:
        if self.status == WheelSatelliteStatus.NO_INERTIA:
            return
        self.status = WheelSatelliteStatus.GOOD
        steps = count_steps(h, self.internal_step)
        for k in range(steps):
            self.move(t + float(k) * h / float(steps), h / float(steps))
