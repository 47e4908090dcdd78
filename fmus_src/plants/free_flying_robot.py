"""Free-flying robot in deep space: a rigid body with eight jets and a cluster of four gyros."""

import math

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import body, inertial, landing, robot, sampling
from ..kernel.integrators import count_steps
from ..kernel.records import Field, Record
from ..mathlib.actuators.gyros import ISOTROPIC_ANGLES, cluster_momentum
from ..mathlib.actuators.jets import JETS, JetStrength, jet_strength, jet_wrench
from ..mathlib.attitude.quaternion import multiply, normalise, quaternion, to_body, to_reference
from ..mathlib.rng import normal, seed_streams
from ..mathlib.vectors import Vector3, Vector4, clip, vector


class RobotRotation(Record):
    """Attitude and angular momentum of the robot, or their time derivatives."""

    quaternion = Field(Vector4, unit="1", description="attitude quaternion from body to inertial, scalar first")
    angular_momentum = Field(
        Vector3,
        unit="N.m.s",
        frame="inertial",
        description="angular momentum of body and gyros about the centre of mass",
    )


class FreeFlyingRobot(Block):
    """Rigid body without external forces, with eight jets and four control moment gyros.

    With force P and torque M of the jets in body axes, and the gyros' momentum H:

        m r'' = R(q) P    J ω' + ω × (J ω + H) = M - H'    q' = q ω/2

    The integrated state is the total angular momentum G in inertial axes:

        G' = R(q) M    ω = J^-1 (R(q)^T G - H)    H = h_g h(β)

    so that G is exactly constant without jets. Gimbals follow the commanded rates without lag. Thrusts are limited to 0
    to maximum_thrust and scaled by 1 + thrust_error n, with a normal number n per jet, constant over a simulation.

    The motion is integrated by the fourth-order Runge-Kutta method in steps of internal_step, or in equal parts of the
    communication step. If internal_step is a power of two, all communication steps that are multiples of it give the
    same results bit for bit.

    Frames: body, principal axes with the origin at the centre of mass; inertial.

    Assumes constant mass and inertia, rotors of constant speed, and jets without lag.

    Source: Somov, Butyrin, Somov and Somova. See docs/systems/robot_rendezvous.md and docs/theory/rendezvous.md.
    """

    default_step = 0.125

    mass = landing.MASS.parameter(1000.0, minimum=1e-3, description="mass of the robot")
    inertia = Parameter(
        [812.0, 587.0, 910.0],
        unit="kg.m2",
        minimum=1e-3,
        frame="body",
        description="principal moments of inertia of the robot about x, y and z",
    )
    jet_tilt = robot.JET_TILT.parameter()
    jet_azimuth = robot.JET_AZIMUTH.parameter()
    jet_arm = robot.JET_ARM.parameter()
    maximum_thrust = robot.MAXIMUM_THRUST.parameter()
    thrust_error = Parameter(
        0.0, unit="1", minimum=0.0, description="relative thrust error of each jet, 1 sigma, constant over a simulation"
    )
    rotor_momentum = robot.ROTOR_MOMENTUM.parameter(minimum=0.0)
    initial_position = inertial.POSITION.parameter(description="initial position of the robot's centre of mass")
    initial_velocity = inertial.VELOCITY.parameter(description="initial velocity of the robot's centre of mass")
    initial_quaternion = Parameter(
        [1.0, 0.0, 0.0, 0.0],
        unit="1",
        description="initial attitude quaternion of the robot from body to inertial, scalar first",
    )
    initial_angular_velocity = body.ANGULAR_VELOCITY.parameter(
        description="initial angular velocity of the robot relative to the inertial frame"
    )
    initial_gimbal_angles = Parameter(
        ISOTROPIC_ANGLES, unit="rad", description="initial gimbal angles of the control moment gyros"
    )
    internal_step = sampling.INTERNAL_STEP.parameter(0.0625, minimum=1e-3)
    seed, stream = sampling.random_stream()
    jet_thrust = robot.JET_THRUST.input("thrust of each jet")
    gimbal_rates = robot.GIMBAL_RATES.input("commanded gimbal rates of the control moment gyros")
    position = inertial.POSITION.output("position of the robot's centre of mass")
    velocity = inertial.VELOCITY.output("velocity of the robot's centre of mass")
    quaternion = robot.QUATERNION.output(
        "attitude quaternion of the robot from body to inertial, scalar first, without jumps of sign"
    )
    angular_velocity = body.ANGULAR_VELOCITY.output("angular velocity of the robot relative to the inertial frame")
    gimbal_angles = robot.GIMBAL_ANGLES.output("gimbal angles of the control moment gyros, unwrapped")
    gyro_momentum = body.ANGULAR_MOMENTUM.output("angular momentum of the gyro cluster")
    jet_force = body.FORCE.output("force of the jets on the robot over the last step")
    jet_torque = body.TORQUE.output("torque of the jets about the centre of mass over the last step")
    impulse = Output(
        0.0, unit="N.s", description="time integral of the sum of all jet thrusts, proportional to the propellant used"
    )
    generator = State([0.0] * 6, frozen=True, description="state of the random number generator")
    thrust_factor = State([1.0] * 8, unit="1", description="ratio of actual to commanded thrust of each jet")
    strength = State(JetStrength)
    angular_momentum = State(
        [0.0, 0.0, 0.0],
        unit="N.m.s",
        frame="inertial",
        description="angular momentum of body and gyros about the centre of mass",
    )

    def initialize(self) -> None:
        self.strength = jet_strength(self.jet_tilt, self.jet_azimuth, self.jet_arm)
        seed_streams(self.generator, self.seed, self.stream)
        for p in range(JETS):
            error = normal(self.generator)
            self.thrust_factor[p] = clip(1.0 + self.thrust_error * error, 0.0, math.inf)
        self.position = self.initial_position
        self.velocity = self.initial_velocity
        self.quaternion = normalise(self.initial_quaternion)
        self.angular_velocity = self.initial_angular_velocity
        self.gimbal_angles = self.initial_gimbal_angles
        self.measure_gyros()
        momentum_body = self.inertia * self.angular_velocity + self.gyro_momentum
        self.angular_momentum = to_reference(self.quaternion, momentum_body)

    def measure_gyros(self) -> None:
        """Set gyro_momentum from the gimbal angles."""
        self.gyro_momentum = self.rotor_momentum * cluster_momentum(self.gimbal_angles)

    def rate(self, q: Vector4, momentum_inertial: Vector3) -> Vector3:
        """Return the angular velocity (rad/s, body) for an attitude and momentum G with the present gyro momentum."""
        return (to_body(q, momentum_inertial) - self.gyro_momentum) / self.inertia

    def turn_gimbals(self, h: float) -> None:
        """Advance the gimbal angles by h (s)."""
        self.gimbal_angles = self.gimbal_angles + h * self.gimbal_rates
        self.measure_gyros()

    def derivatives(self, s: RobotRotation) -> RobotRotation:
        """Return q' = q w/2 and G' = R(q) M with the present gyro momentum."""
        return RobotRotation(
            quaternion=multiply(s.quaternion, quaternion(0.0, 0.5 * self.rate(s.quaternion, s.angular_momentum))),
            angular_momentum=to_reference(s.quaternion, self.jet_torque),
        )

    def force(self, s: RobotRotation) -> Vector3:
        """Return the force R(q) P = m r'' (N, inertial)."""
        return to_reference(s.quaternion, self.jet_force)

    def move(self, h: float) -> None:
        """Advance the motion by h (s) under the force and torque of the jets.

        The stages of `runge_kutta_4` are written out, since the gimbals advance by h/2 between them and r'' is
        integrated by Nystrom's formula from the forces of all stages. A single state with both would be rounded
        differently.
        """
        s1 = RobotRotation(quaternion=self.quaternion, angular_momentum=self.angular_momentum)
        k1 = self.derivatives(s1)
        self.turn_gimbals(0.5 * h)
        s2 = s1 + 0.5 * h * k1
        k2 = self.derivatives(s2)
        s3 = s1 + 0.5 * h * k2
        k3 = self.derivatives(s3)
        self.turn_gimbals(0.5 * h)
        s4 = s1 + h * k3
        k4 = self.derivatives(s4)
        # adding 0 avoids results of -0
        zero = vector(0.0, 0.0, 0.0)
        still = RobotRotation(quaternion=vector(0.0, 0.0, 0.0, 0.0), angular_momentum=zero)
        end = s1 + h * (still + k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
        force1 = zero + self.force(s1)
        force2 = self.force(s2)
        force3 = self.force(s3)
        self.position = self.position + h * (self.velocity + h * (force1 + force2 + force3) / (6.0 * self.mass))
        total = force1 + 2.0 * force2 + 2.0 * force3 + self.force(s4)
        self.velocity = self.velocity + h * total / (6.0 * self.mass)
        self.angular_momentum = end.angular_momentum
        self.quaternion = normalise(end.quaternion)
        self.angular_velocity = self.rate(self.quaternion, self.angular_momentum)

    def step(self, t: float, h: float) -> None:
        thrust = [0.0] * 8
        total = 0.0
        for p in range(JETS):
            thrust[p] = self.thrust_factor[p] * clip(self.jet_thrust[p], 0.0, self.maximum_thrust)
            total = total + thrust[p]
        wrench = jet_wrench(self.strength, thrust)
        self.jet_force = wrench.force
        self.jet_torque = wrench.torque
        pieces = count_steps(h, self.internal_step)
        piece = h / pieces
        for _ in range(pieces):
            self.move(piece)
            self.impulse = self.impulse + total * piece
