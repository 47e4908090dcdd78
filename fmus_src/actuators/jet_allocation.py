"""Interface of jet allocations, which convert a demanded force and torque into the thrusts of eight jets."""

from ..block import Block, Output, State
from ..interfaces.ports import body, inertial, robot, sampling
from ..interfaces.ports.robot import LARGEST
from ..kernel.enumerations import Enumeration, member
from ..mathlib.actuators.jets import JETS, JetStrength, Wrench, jet_strength, jet_wrench
from ..mathlib.attitude.quaternion import is_attitude, normalise, to_body


class JetAllocationStatus(Enumeration):
    """Status of the latest command."""

    GOOD = member("good")
    SATURATED = member("saturated")
    TORQUE_LEFT_OUT = member("torque or unattainable part of the force omitted")
    NOT_FINITE = member("command unusable")
    NO_ATTITUDE = member("no attitude: quaternion shorter than 0.5, no thrust")


class JetAllocation(Block, interface=True):
    """Allocation of a force (inertial axes) and a torque (body axes) to eight jets of adjustable thrust.

    A change of command_count signals a new command; the command at the start counts as new. It is allocated immediately
    with the present attitude, and its thrusts are applied after a delay of delay_fraction times translation_period,
    until the next command's thrusts. Before the first command thrusts are 0. A new command replaces an earlier one
    whose thrusts are not yet applied. The status refers to the latest command; allocated_force and allocated_torque are
    computed from jet_thrust with the declared jet geometry.

    An allocation defines `allocate`, which sets new_thrust and status. jet_tilt is the elevation of the nozzles above
    the body's xy plane, jet_azimuth their angle from x in this plane, jet_arm the position of the first jet.

    Frames: inertial; body.

    Assumes jets at their declared positions, without lag.

    See docs/theory/rendezvous.md.
    """

    to_write = ("allocate",)

    default_step = 0.125

    jet_tilt = robot.JET_TILT.parameter()
    jet_azimuth = robot.JET_AZIMUTH.parameter()
    jet_arm = robot.JET_ARM.parameter()
    maximum_thrust = robot.MAXIMUM_THRUST.parameter()
    delay_fraction = robot.DELAY_FRACTION.parameter()
    force_command = inertial.FORCE.input()
    torque_command = body.TORQUE.input("commanded torque of the jets on the body")
    quaternion = robot.QUATERNION.input()
    command_count = robot.COMMAND_COUNT.input("number of commands since the start; a change signals a new command")
    translation_period = robot.TRANSLATION_PERIOD.input("duration for which the new command holds")
    jet_thrust = robot.JET_THRUST.output(direct=True)
    allocated_force = body.FORCE.output("force on the body produced by jet_thrust", direct=True)
    allocated_torque = body.TORQUE.output("torque on the body produced by jet_thrust", direct=True)
    status = Output(JetAllocationStatus, direct=True)
    start_time = sampling.START_TIME.state()
    strength = State(JetStrength)
    attitude = State(
        [1.0, 0.0, 0.0, 0.0],
        unit="1",
        description="normalised attitude quaternion of the newest command, from body to inertial, scalar first",
    )
    demand = State(Wrench, description="commanded force and torque")
    new_thrust = State([0.0] * 8, unit="N", description="thrust of each jet for the newest command")
    waiting = State(False, description="true: thrusts of the newest command not applied yet")
    due_time = State(0.0, unit="s", description="time at which the thrusts of the newest command are applied")
    counted = State(0, description="command_count of the newest accepted command")

    def allocate(self) -> None:
        """Set new_thrust (N) and status from ``demand``."""

    def read_demand(self) -> bool:
        """Set attitude and the demand in body axes from the command; return True if it is finite."""
        finite = self.translation_period > 0.0 and self.translation_period < LARGEST
        q = self.quaternion
        length = abs(q.w) + abs(q.x) + abs(q.y) + abs(q.z)
        if not length < LARGEST:
            finite = False
        self.attitude = normalise(q)
        self.demand = Wrench(force=to_body(self.attitude, self.force_command), torque=self.torque_command)
        for k in range(3):
            if not (abs(self.demand.force[k]) < LARGEST and abs(self.demand.torque[k]) < LARGEST):
                finite = False
        return finite

    def take(self, time: float) -> None:
        """Allocate the command received at ``time`` (s)."""
        self.counted = self.command_count
        self.waiting = True
        finite = self.read_demand()
        if finite and is_attitude(self.quaternion):
            self.status = JetAllocationStatus.GOOD
            self.due_time = time + self.delay_fraction * self.translation_period
            self.allocate()
        else:
            self.status = JetAllocationStatus.NOT_FINITE
            if finite:
                self.status = JetAllocationStatus.NO_ATTITUDE
            self.due_time = time
            for p in range(JETS):
                self.new_thrust[p] = 0.0

    def output_due_thrusts(self, time: float) -> None:
        """Output the pending thrusts if they are due at ``time`` (s)."""
        if self.waiting and time >= self.due_time - sampling.TIME_ROUNDING:
            self.waiting = False
            wrench = jet_wrench(self.strength, self.new_thrust)
            for p in range(JETS):
                self.jet_thrust[p] = self.new_thrust[p]
            self.allocated_force = wrench.force
            self.allocated_torque = wrench.torque

    def initialize(self) -> None:
        self.strength = jet_strength(self.jet_tilt, self.jet_azimuth, self.jet_arm)
        self.take(self.start_time)
        self.output_due_thrusts(self.start_time)

    def step(self, t: float, h: float) -> None:
        self.output_due_thrusts(t + h)  # thrusts due now, before a new command replaces them
        if self.command_count != self.counted:
            self.take(t + h)
            self.output_due_thrusts(t + h)
