"""A satellite that is turned by four reaction wheels."""

from ..block import Output, Parameter, State
from ..interfaces.ports import body, robot, sampling, satellite
from ..kernel.enumerations import Enumeration, member
from ..kernel.integrators import count_steps, runge_kutta_4
from ..kernel.matrices import inverse, is_positive_definite, zeros
from ..kernel.records import Field, Record
from ..mathlib.attitude.quaternion import multiply, normalise, quaternion, to_body, to_reference
from ..mathlib.vectors import Vector3, Vector4
from ..models.spinning_wheels import SpinningWheels


class WheelSatelliteStatus(Enumeration):
    """Limits of the wheels, and motion of the satellite."""

    GOOD = member("good")
    TORQUE_LIMITED = member("a motor torque limited")
    SPEED_LIMITED = member("a wheel at its speed limit")
    NO_INERTIA = member("inertia without the wheels' spin not positive, nothing moves")


class SatelliteMotion(Record):
    """Rotation of the satellite and of its wheels; its rates are one more of the same kind."""

    quaternion = Field(Vector4, unit="1", description="attitude, from body to inertial, scalar first")
    angular_momentum = Field(Vector3, unit="N.m.s", frame="inertial", description="G of body and wheels")
    spin = Field(Vector4, unit="N.m.s", description="h = Js (W + g.w) of each wheel about its axis, absolute")


class WheelSatellite(SpinningWheels):
    """Rigid body with four balanced reaction wheels, under a constant external torque.

    With unit spin axes g, the wheels' speeds W relative to the body and their spin inertia Js, and with I the inertia
    of the whole satellite, wheels included as if they did not spin (Basilisk's convention for balanced wheels):
    (I - sum Js g g') w' = -w x (I w + sum Js W g) - sum us g + L,  W' = us/Js - g.w',  q' = q w/2.
    us is the motor's torque with friction, L = body_torque + inertial_torque. It is integrated as h' = us,
    G' = R(q) L, w = (I - sum Js g g')^-1 (R'(q) G - sum h g), W = h/Js - g.w, with G the angular momentum in
    inertial axes: without L it does not change by a bit, whatever the wheels do.
    Frames: body, origin at the centre of mass; inertial. Equations: docs/systems/satellite_pointing.md.
    Source: Schaub and Junkins 2018, section 4.5; Alcorn, Allard and Schaub 2018.

    Runge-Kutta of fourth order in steps of internal_step, or equal parts of the communication step no longer than that.
    Assumes rigid bodies, wheels that are alike, balanced and aligned with principal axes of theirs.
    """

    default_step = 0.125

    inertia = satellite.INERTIA.parameter()
    body_torque = body.TORQUE.parameter(description="external torque that is constant in body axes")
    inertial_torque = Parameter(
        [0.0, 0.0, 0.0], unit="N.m", frame="inertial", description="external torque that is constant in inertial axes"
    )
    initial_quaternion = Parameter(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="attitude at the start, from body to inertial, scalar first"
    )
    initial_angular_velocity = body.ANGULAR_VELOCITY.parameter(description="angular velocity at the start")
    internal_step = sampling.INTERNAL_STEP.parameter(0.0625, minimum=1e-3)
    quaternion = robot.QUATERNION.output("attitude, from body to inertial, scalar first, continuous")
    angular_velocity = body.ANGULAR_VELOCITY.output("angular velocity")
    angular_momentum = Output(
        [0.0, 0.0, 0.0], unit="N.m.s", frame="inertial", description="G of body and wheels about the centre of mass"
    )
    status = Output(WheelSatelliteStatus)
    inverse_inertia = State(zeros(3, 3), description="(I - sum Js g g')^-1, 1/(kg m2)")

    def initialize(self) -> None:
        self.angular_velocity = self.initial_angular_velocity
        self.start_wheels(self.angular_velocity)
        locked = self.inertia - self.wheel_inertia * self.axes @ self.axes.T
        self.inverse_inertia, invertible = inverse(locked)
        if not (invertible and is_positive_definite(locked)):
            self.status = WheelSatelliteStatus.NO_INERTIA
        self.quaternion = normalise(self.initial_quaternion)
        momentum = self.inertia @ self.angular_velocity + self.wheel_momentum
        self.angular_momentum = to_reference(self.quaternion, momentum)

    def rate(self, s: SatelliteMotion) -> Vector3:
        """Return angular velocity (rad/s, body)."""
        return self.inverse_inertia @ (to_body(s.quaternion, s.angular_momentum) - self.axes @ s.spin)

    def derivatives(self, t: float, s: SatelliteMotion, motors: Vector4) -> SatelliteMotion:
        """Return q' = q w/2, G' = R(q) L and h' = us under motor torques (N m)."""
        w = self.rate(s)
        return SatelliteMotion(
            quaternion=multiply(s.quaternion, quaternion(0.0, 0.5 * w)),
            angular_momentum=to_reference(s.quaternion, self.body_torque) + self.inertial_torque,
            spin=motors + self.drags(self.speeds(s.spin, w)),
        )

    def move(self, t: float, h: float) -> None:
        """Move by h (s)."""
        torque_limited, speed_limited = self.drive(self.motor_torques)
        if torque_limited and self.status == WheelSatelliteStatus.GOOD:
            self.status = WheelSatelliteStatus.TORQUE_LIMITED
        if speed_limited:
            self.status = WheelSatelliteStatus.SPEED_LIMITED
        s = SatelliteMotion(quaternion=self.quaternion, angular_momentum=self.angular_momentum, spin=self.spin)
        end = runge_kutta_4(self.derivatives, t, s, h, self.applied_torques)
        self.quaternion = normalise(end.quaternion)
        self.angular_momentum = end.angular_momentum
        self.spin = end.spin
        s = SatelliteMotion(quaternion=self.quaternion, angular_momentum=self.angular_momentum, spin=self.spin)
        self.angular_velocity = self.rate(s)
        self.set_wheel_outputs(self.angular_velocity)

    def step(self, t: float, h: float) -> None:
        if self.status == WheelSatelliteStatus.NO_INERTIA:
            return
        self.status = WheelSatelliteStatus.GOOD
        steps = count_steps(h, self.internal_step)
        for k in range(steps):
            self.move(t + float(k) * h / float(steps), h / float(steps))
