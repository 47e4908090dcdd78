"""Satellite turned by four reaction wheels."""

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
    """Limits of the wheels, and validity of the inertia."""

    GOOD = member("good")
    TORQUE_LIMITED = member("a motor torque limited")
    SPEED_LIMITED = member("a wheel at its speed limit")
    NO_INERTIA = member("inertia without the wheels' spin not positive, no motion")


class SatelliteMotion(Record):
    """Rotation of satellite and wheels, or the time derivative of this rotation."""

    quaternion = Field(Vector4, unit="1", description="attitude quaternion from body to inertial, scalar first")
    angular_momentum = Field(
        Vector3,
        unit="N.m.s",
        frame="inertial",
        description="angular momentum of body and wheels about the centre of mass",
    )
    spin = Field(
        Vector4,
        unit="N.m.s",
        description="angular momentum of each wheel about its spin axis, relative to the inertial frame",
    )


class WheelSatellite(SpinningWheels):
    """Rigid body with four balanced reaction wheels, under constant external torques.

    With unit spin axes g_i, wheel speeds Ω_i relative to the body, spin inertia J_s, motor torques including friction
    u_i, inertia I of the satellite with its wheels, not spinning, and external torque L:

        (I - Σ J_s g_i g_i^T) ω' = -ω × (I ω + Σ J_s Ω_i g_i) - Σ u_i g_i + L
        Ω_i' = u_i/J_s - g_i · ω'    q' = q ω/2

    The integrated states are the attitude q, the wheels' momenta h and the total angular momentum G in inertial axes:

        h' = u    G' = R(q) L    ω = (I - J_s A A^T)^-1 (R(q)^T G - A h)    Ω = h/J_s - A^T ω

    so that G is exactly constant without external torque. The motion is integrated by the fourth-order Runge-Kutta
    method in steps of internal_step, or in equal parts of the communication step.

    Frames: body, origin at the centre of mass; inertial.

    Assumes a rigid body, and equal balanced wheels aligned with their principal axes.

    Source: Schaub and Junkins 2018, section 4.5; Alcorn, Allard and Schaub 2018. See
    docs/systems/satellite_pointing.md.
    """

    default_step = 0.125

    inertia = satellite.INERTIA.parameter()
    body_torque = body.TORQUE.parameter(description="constant external torque, fixed in the body")
    inertial_torque = Parameter(
        [0.0, 0.0, 0.0], unit="N.m", frame="inertial", description="constant external torque, fixed in inertial space"
    )
    initial_quaternion = Parameter(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="initial attitude quaternion from body to inertial, scalar first"
    )
    initial_angular_velocity = body.ANGULAR_VELOCITY.parameter(
        description="initial angular velocity of the body relative to the inertial frame"
    )
    internal_step = sampling.INTERNAL_STEP.parameter(0.0625, minimum=1e-3)
    quaternion = robot.QUATERNION.output(
        "attitude quaternion from body to inertial, scalar first, without jumps of sign"
    )
    angular_velocity = body.ANGULAR_VELOCITY.output("angular velocity of the body relative to the inertial frame")
    angular_momentum = Output(
        [0.0, 0.0, 0.0],
        unit="N.m.s",
        frame="inertial",
        description="angular momentum of body and wheels about the centre of mass",
    )
    status = Output(WheelSatelliteStatus)
    inverse_inertia = State(
        zeros(3, 3),
        description="inverse of the inertia matrix without the wheels' spin inertia, 1/(kg m2) (body frame)",
    )

    def initialize(self) -> None:
        self.angular_velocity = self.initial_angular_velocity
        self.start_wheels(self.angular_velocity)
        locked = self.inertia - self.wheel_inertia * self.axes @ self.axes.T
        self.inverse_inertia, invertible = inverse(locked)
        if not (invertible and is_positive_definite(locked)):
            self.status = WheelSatelliteStatus.NO_INERTIA
        self.quaternion = normalise(self.initial_quaternion)
        momentum_body = self.inertia @ self.angular_velocity + self.wheel_momentum
        self.angular_momentum = to_reference(self.quaternion, momentum_body)

    def rate(self, s: SatelliteMotion) -> Vector3:
        """Return the angular velocity (rad/s, body)."""
        return self.inverse_inertia @ (to_body(s.quaternion, s.angular_momentum) - self.axes @ s.spin)

    def derivatives(self, t: float, s: SatelliteMotion, motors: Vector4) -> SatelliteMotion:
        """Return q' = q w/2, G' = R(q) L and h' = u for motor torques u (N m)."""
        w = self.rate(s)
        return SatelliteMotion(
            quaternion=multiply(s.quaternion, quaternion(0.0, 0.5 * w)),
            angular_momentum=to_reference(s.quaternion, self.body_torque) + self.inertial_torque,
            spin=motors + self.drags(self.speeds(s.spin, w)),
        )

    def move(self, t: float, h: float) -> None:
        """Advance the motion by h (s)."""
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
