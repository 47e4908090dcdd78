"""A free-flying robot in deep space: a rigid body with eight jets and a cluster of four gyros."""

import math

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.gyros import ISOTROPIC_ANGLES, cluster_momentum
from ..mathlib.jets import JETS, jet_strengths, jet_wrench
from ..mathlib.quaternion import copy4, multiply, normalise, to_body, to_reference
from ..mathlib.rng import normal, seed_streams
from ..mathlib.vectors import clip, copy3


class FreeFlyingRobot(Block):
    """Rigid body without external forces, moved by jets and turned by jets and gyros.

    m r'' = R(q) P, J w' + w x (J w + H) = M - H', q' = q w/2, with force P and torque M of the jets (body),
    H = rotor_momentum h(gimbal angles), and gimbals that turn at the commanded rates from the first
    instant; mass and inertia do not change. It is integrated as G' = R(q) M, w = J^-1 (R'(q) G - H), G
    being the angular momentum in inertial axes: without jets G does not change by a bit, whatever the gimbals do.
    Thrusts are kept within 0 and maximum_thrust and scaled by 1 + thrust_error times a normal number per jet,
    constant over a flight and not below 0. Frames: body, principal axes with the origin at the centre of mass;
    inertial. Equations: docs/robot_rendezvous.md.

    Runge-Kutta of fourth order in steps of internal_step, or equal parts of the communication step no longer
    than that: results are the same to the bit for all communication steps that are whole multiples of
    an internal_step which is a power of two.
    """

    default_step = 0.125

    mass = Parameter(1000.0, unit="kg", minimum=1e-3, description="mass")
    inertia = Parameter([812.0, 587.0, 910.0], unit="kg.m2", minimum=1e-3, frame="body", description="principal")
    jet_tilt = Parameter(35.25 * math.pi / 180.0, unit="rad", description="nozzles above the body's xy plane")
    jet_azimuth = Parameter(math.pi / 4.0, unit="rad", description="nozzles from x in the xy plane")
    jet_arm = Parameter([1.0, 0.7, 0.6], unit="m", frame="body", description="place of the first jet")
    maximum_thrust = Parameter(0.5, unit="N", minimum=0.0, description="of one jet")
    thrust_error = Parameter(
        0.0, unit="1", minimum=0.0, description="relative error of thrust, 1 sigma per jet, constant over a flight"
    )
    rotor_momentum = Parameter(30.0, unit="N.m.s", minimum=0.0, description="angular momentum of one rotor")
    initial_position = Parameter([0.0, 0.0, 0.0], unit="m", frame="inertial", description="position at the start")
    initial_velocity = Parameter([0.0, 0.0, 0.0], unit="m/s", frame="inertial", description="velocity at the start")
    initial_quaternion = Parameter(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="attitude at the start, from body to inertial, scalar first"
    )
    initial_angular_velocity = Parameter(
        [0.0, 0.0, 0.0], unit="rad/s", frame="body", description="angular velocity at the start"
    )
    initial_gimbal_angles = Parameter(ISOTROPIC_ANGLES, unit="rad", description="gimbal angles at the start")
    internal_step = Parameter(0.0625, unit="s", minimum=1e-3, description="longest integration step")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    jet_thrust = Input([0.0] * 8, unit="N", description="thrust of each jet")
    gimbal_rates = Input([0.0] * 4, unit="rad/s", description="gimbal rates")
    position = Output([0.0, 0.0, 0.0], unit="m", frame="inertial", description="centre of mass")
    velocity = Output([0.0, 0.0, 0.0], unit="m/s", frame="inertial", description="velocity")
    quaternion = Output(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="attitude, from body to inertial, scalar first, continuous"
    )
    angular_velocity = Output([0.0, 0.0, 0.0], unit="rad/s", frame="body", description="angular velocity")
    gimbal_angles = Output(ISOTROPIC_ANGLES, unit="rad", description="gimbal angles, not wrapped")
    gyro_momentum = Output([0.0, 0.0, 0.0], unit="N.m.s", frame="body", description="angular momentum H of the cluster")
    jet_force = Output([0.0, 0.0, 0.0], unit="N", frame="body", description="force of the jets over the last step")
    jet_torque = Output([0.0, 0.0, 0.0], unit="N.m", frame="body", description="their torque over the last step")
    impulse = Output(0.0, unit="N.s", description="thrusts of all jets, summed and integrated: the propellant")
    generator = State([0.0] * 6, frozen=True, description="random number generator")
    thrust_factor = State([1.0] * 8, unit="1", description="thrust of each jet over the commanded one")
    strength = State([0.0] * 6, description="force (N/N) and torque (N.m/N) of the jets, by rows of signs")
    angular_momentum = State(
        [0.0, 0.0, 0.0], unit="N.m.s", frame="inertial", description="G of body and gyros about the centre of mass"
    )

    def initialize(self) -> None:
        jet_strengths(self.jet_tilt, self.jet_azimuth, self.jet_arm, self.strength)
        seed_streams(self.generator, self.seed, self.stream)
        for p in range(JETS):
            error = normal(self.generator)
            self.thrust_factor[p] = clip(1.0 + self.thrust_error * error, 0.0, math.inf)
        copy3(self.position, self.initial_position)
        copy3(self.velocity, self.initial_velocity)
        copy4(self.quaternion, self.initial_quaternion)
        normalise(self.quaternion)
        copy3(self.angular_velocity, self.initial_angular_velocity)
        copy4(self.gimbal_angles, self.initial_gimbal_angles)
        body = [0.0] * 3
        self.measure_gyros()
        for i in range(3):
            body[i] = self.inertia[i] * self.angular_velocity[i] + self.gyro_momentum[i]
        to_reference(self.quaternion, body, self.angular_momentum)

    def measure_gyros(self) -> None:
        """gyro_momentum from the gimbal angles."""
        cluster_momentum(self.gimbal_angles, self.gyro_momentum)
        for i in range(3):
            self.gyro_momentum[i] = self.rotor_momentum * self.gyro_momentum[i]

    def rotate(self, q: list, momentum: list, rate: list, quaternion_rate: list) -> None:
        """Angular velocity (rad/s, body) for attitude and momentum G at the gyros' present state, and q'."""
        spin = [0.0] * 4
        to_body(q, momentum, rate)
        for i in range(3):
            rate[i] = (rate[i] - self.gyro_momentum[i]) / self.inertia[i]
            spin[i + 1] = 0.5 * rate[i]
        multiply(q, spin, quaternion_rate)

    def turn_gimbals(self, h: float) -> None:
        """Turn the gimbals for h (s)."""
        for i in range(4):
            self.gimbal_angles[i] = self.gimbal_angles[i] + h * self.gimbal_rates[i]
        self.measure_gyros()

    def move(self, h: float) -> None:
        """Move by h (s) under the jets' force and torque."""
        q = [0.0] * 4
        momentum = [0.0] * 3
        rate = [0.0] * 3
        q_rate = [0.0] * 4
        torque = [0.0] * 3
        force = [0.0] * 3
        q_sum = [0.0] * 4
        torque_sum = [0.0] * 3
        force_sum = [0.0] * 3
        early_force = [0.0] * 3
        copy4(q, self.quaternion)
        copy3(momentum, self.angular_momentum)
        for stage in range(4):
            if stage == 1 or stage == 3:
                self.turn_gimbals(0.5 * h)
            self.rotate(q, momentum, rate, q_rate)
            to_reference(q, self.jet_torque, torque)
            to_reference(q, self.jet_force, force)
            weight = 1.0
            if stage == 1 or stage == 2:
                weight = 2.0
            reach = 0.5 * h
            if stage == 2:
                reach = h
            for i in range(4):
                q_sum[i] = q_sum[i] + weight * q_rate[i]
                q[i] = self.quaternion[i] + reach * q_rate[i]
            for i in range(3):
                torque_sum[i] = torque_sum[i] + weight * torque[i]
                force_sum[i] = force_sum[i] + weight * force[i]
                momentum[i] = self.angular_momentum[i] + reach * torque[i]
                if stage < 3:
                    early_force[i] = early_force[i] + force[i]
        for i in range(4):
            self.quaternion[i] = self.quaternion[i] + h * q_sum[i] / 6.0
        for i in range(3):
            # Nystroem's form of the method, for r'' without r'
            moved = self.velocity[i] + h * early_force[i] / (6.0 * self.mass)
            self.position[i] = self.position[i] + h * moved
            self.velocity[i] = self.velocity[i] + h * force_sum[i] / (6.0 * self.mass)
            self.angular_momentum[i] = self.angular_momentum[i] + h * torque_sum[i] / 6.0
        normalise(self.quaternion)
        self.rotate(self.quaternion, self.angular_momentum, self.angular_velocity, q_rate)

    def step(self, t: float, h: float) -> None:
        thrust = [0.0] * 8
        wrench = [0.0] * 6
        total = 0.0
        for p in range(JETS):
            thrust[p] = self.thrust_factor[p] * clip(self.jet_thrust[p], 0.0, self.maximum_thrust)
            total = total + thrust[p]
        jet_wrench(self.strength, thrust, wrench)
        for i in range(3):
            self.jet_force[i] = wrench[i]
            self.jet_torque[i] = wrench[3 + i]
        pieces = int(h / self.internal_step - 1e-9) + 1
        piece = h / pieces
        for _ in range(pieces):
            self.move(piece)
            self.impulse = self.impulse + total * piece
