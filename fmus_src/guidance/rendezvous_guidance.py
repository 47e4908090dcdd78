"""Plan of an approach to a passive rotating object, and clock for translation control."""

import math

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import body, inertial, robot
from ..kernel.enumerations import Enumeration, member
from ..kernel.integrators import STEP_ROUNDING, Translation
from ..mathlib.attitude.quaternion import from_rotation_vector
from ..mathlib.attitude.rotation import rotation_between
from ..mathlib.spline import spline, spline_acceleration, spline_rate, spline_value
from ..mathlib.vectors import norm, vector


class RendezvousStatus(Enumeration):
    """Validity of the plan."""

    GOOD = member("good")
    NO_PLAN = member("no plan: phases out of order")
    TURN_TOO_LONG = member("no plan: the turn takes longer than its phase")


class RendezvousPhase(Enumeration, first=1):
    """Phase of the plan."""

    ACCELERATE = member("accelerate")
    TURN = member("turn")
    APPROACH = member("approach")
    HOLD = member("hold")


class RendezvousGuidance(Block):
    """Planned motion of a free-flying robot from rest to a fixed position in front of a passive rotating object.

    Phase 1, until turn_start: constant acceleration from rest at the origin, with inertial body axes. Phase 2, until
    turn_end: coast, and a turn that aligns the camera axis (body x) with the object's spin_axis, about the axis
    perpendicular to both. Phase 3, until arrival_time: a spline that ends at final_distance from the object's centre,
    on the side opposite to spin_axis, with the object's velocity. Phase 4: hold of this position.

        φ = φ_f (20 s^3 - 45 s^4 + 36 s^5 - 10 s^6)    T^2 r'' = s (1 - s) (a + b s)

    with the angle φ of the turn and the fraction s of the phase's time T. The acceleration of phase 1 is chosen so that
    the velocity in phase 3 changes along a straight line without overshoot.

    The block is also the clock of translation control: translation_count increases at each sample, which occurs every
    slow_period (a whole multiple of fast_period) until turn_end and every fast_period from then on. A command takes
    effect after delay_fraction of the period and lasts until the next one does; planned_acceleration is the mean over
    this time. If the times of the phases are not in order there is no plan: the status is 1, and the robot stays at
    rest.

    Frames: inertial; planned body.

    Assumes an object in uniform motion with a known spin axis, and a robot at rest at the origin at the start.

    Source: Somov, Butyrin, Somov and Somova. See docs/theory/rendezvous.md.
    """

    default_step = 0.125

    target_position = inertial.POSITION.parameter(
        [469.8463103929542, 171.01007166283436, 0.0], "position of the object's centre at the start, as known on board"
    )
    target_velocity = inertial.VELOCITY.parameter(
        [-0.05, 0.05, 0.075], "constant velocity of the object, as known on board"
    )
    spin_axis = robot.SPIN_AXIS.parameter()
    turn_start = Parameter(
        1420.0,
        unit="s",
        minimum=0.0,
        description="time from the start of the simulation to the end of acceleration and start of the turn",
    )
    turn_end = Parameter(
        1520.0,
        unit="s",
        minimum=0.0,
        description="time from the start of the simulation to the end of the turn and start of the spline",
    )
    arrival_time = Parameter(
        4250.0, unit="s", minimum=0.0, description="time from the start of the simulation to the end of the spline"
    )
    final_distance = Parameter(
        30.0, unit="m", minimum=0.0, description="final distance from the object's centre, opposite to spin_axis"
    )
    spline_degree = Parameter(5, minimum=5, maximum=6, description="degree of the spline; 6: jerk 0 at the end")
    slow_period = Parameter(
        8.0, unit="s", minimum=1e-3, description="sample period of translation control before turn_end"
    )
    fast_period = Parameter(
        4.0, unit="s", minimum=1e-3, description="sample period of translation control after turn_end"
    )
    delay_fraction = robot.DELAY_FRACTION.parameter()
    attitude_period = Parameter(0.25, unit="s", minimum=0.0, description="sample period of attitude control")
    planned_position = inertial.POSITION.output("planned position of the robot's centre of mass")
    planned_velocity = inertial.VELOCITY.output("planned velocity of the robot's centre of mass")
    planned_acceleration = inertial.ACCELERATION.output(
        "planned acceleration of the robot, mean over the time in which the force of the last sample acts"
    )
    planned_relative_position = inertial.POSITION.output(
        "planned position of the object's centre relative to the robot"
    )
    planned_quaternion = robot.PLANNED_QUATERNION.output(
        "planned attitude quaternion from body to inertial, scalar first"
    )
    planned_angular_velocity = body.ANGULAR_VELOCITY.output(
        "planned angular velocity of the robot relative to the inertial frame"
    )
    planned_angular_acceleration = body.ANGULAR_ACCELERATION.output(
        "planned angular acceleration of the robot, half an attitude_period ahead"
    )
    phase = Output(RendezvousPhase)
    translation_period = Output(8.0, unit="s", description="time from the last to the next translation control sample")
    translation_count = robot.TRANSLATION_COUNT.output(
        "number of translation control samples since the start; a change signals a new sample"
    )
    status = Output(RendezvousStatus)
    start_time = State(0.0, unit="s", description="start time of the simulation")
    acceleration = State(
        [0.0, 0.0, 0.0], unit="m/s2", frame="inertial", description="constant planned acceleration in the first phase"
    )
    splines = State(
        [0.0] * 21,
        columns=7,
        unit="m",
        frame="inertial",
        description="spline coefficients of the planned position in the approach, one axis per row",
    )
    turn_axis = State(
        [0.0, 0.0, 0.0], unit="1", description="rotation axis of the turn, equal in inertial and body axes, unit vector"
    )
    turn_polynomial = State([0.0] * 7, unit="rad", description="polynomial coefficients of the turn's rotation angle")
    place = State(
        [0.0, 0.0, 0.0], unit="m", frame="inertial", description="planned position of the robot at arrival_time"
    )
    next_tick = State(0, description="number of the next translation control sample, counted in fast periods")
    granted_velocity = State(
        [0.0, 0.0, 0.0],
        unit="m/s",
        frame="inertial",
        description="planned velocity at the end of the time in which the last sample's force acts",
    )

    def initialize(self) -> None:
        if not (self.turn_start > 0.0 and self.turn_start < self.turn_end and self.turn_end < self.arrival_time):
            self.status = RendezvousStatus.NO_PLAN
        if self.spin_axis.x == 0.0 and self.spin_axis.y == 0.0 and self.spin_axis.z == 0.0:
            self.status = RendezvousStatus.NO_PLAN
        if self.status == RendezvousStatus.GOOD:
            self.make_plan()
        self.tick(0.0)
        self.publish(0.0)

    def make_plan(self) -> None:
        """Compute the acceleration of phase 1, the splines of phase 3 and the turn."""
        self.turn_axis, angle = rotation_between(vector(1.0, 0.0, 0.0), self.spin_axis)
        self.plan_turn(angle)
        spin = norm(self.spin_axis)
        approach = self.arrival_time - self.turn_end
        # distance per acceleration: phases 1 and 2, and half of phase 3 at the velocity of phase 2
        reach = self.turn_start * (self.turn_end - 0.5 * self.turn_start + 0.5 * approach)
        there = self.target_position + self.arrival_time * self.target_velocity
        self.place = there - self.final_distance * self.spin_axis / spin
        self.acceleration = (self.place - 0.5 * approach * self.target_velocity) / reach
        coasting = self.turn_start * self.acceleration
        begin = (self.turn_end - 0.5 * self.turn_start) * coasting
        c = [0.0] * 7
        for i in range(3):
            spline(begin[i], coasting[i], self.place[i], self.target_velocity[i], approach, self.spline_degree, c)
            for k in range(7):
                self.splines[i, k] = c[k]

    def plan_turn(self, angle: float) -> None:
        """Plan the turn by an angle (rad) within its phase."""
        spline(0.0, 0.0, angle, 0.0, self.turn_end - self.turn_start, 6, self.turn_polynomial)

    def motion(self, time: float) -> Translation:
        """Return the planned motion at a time (s) after the start of the simulation."""
        if self.status != RendezvousStatus.GOOD:
            return Translation(position=vector(0.0, 0.0, 0.0), velocity=vector(0.0, 0.0, 0.0))
        if time <= self.turn_start:
            return Translation(position=0.5 * self.acceleration * time * time, velocity=time * self.acceleration)
        if time <= self.turn_end:
            coasting = self.turn_start * self.acceleration
            return Translation(position=(time - 0.5 * self.turn_start) * coasting, velocity=coasting)
        if time < self.arrival_time:
            return self.approach(time)
        since = time - self.arrival_time
        return Translation(position=self.place + since * self.target_velocity, velocity=self.target_velocity)

    def approach(self, time: float) -> Translation:
        """Return the motion on the splines of phase 3."""
        duration = self.arrival_time - self.turn_end
        s = (time - self.turn_end) / duration
        position = [0.0] * 3
        velocity = [0.0] * 3
        c = [0.0] * 7
        for i in range(3):
            for k in range(7):
                c[k] = self.splines[i, k]
            position[i] = spline_value(c, s)
            velocity[i] = spline_rate(c, s, duration)
        return Translation(position=vector(*position), velocity=vector(*velocity))

    def turn(self, time: float) -> None:
        """Set planned attitude, angular velocity and, half an attitude_period later, angular acceleration."""
        duration = self.turn_end - self.turn_start
        angle = 0.0
        rate = 0.0
        acceleration = 0.0
        if self.status == RendezvousStatus.GOOD:
            s = (time - self.turn_start) / duration
            ahead = s + 0.5 * self.attitude_period / duration
            if s >= 1.0:
                angle = spline_value(self.turn_polynomial, 1.0)
            elif s > 0.0:
                angle = spline_value(self.turn_polynomial, s)
                rate = spline_rate(self.turn_polynomial, s, duration)
            if ahead > 0.0 and ahead < 1.0:
                acceleration = spline_acceleration(self.turn_polynomial, ahead, duration)
        self.set_turn(angle, rate, acceleration)

    def set_turn(self, angle: float, rate: float, acceleration: float) -> None:
        """Output the turn's angle (rad), rate (rad/s) and angular acceleration (rad/s2)."""
        self.planned_quaternion = from_rotation_vector(angle * self.turn_axis)
        self.planned_angular_velocity = rate * self.turn_axis
        self.planned_angular_acceleration = acceleration * self.turn_axis

    def tick(self, time: float) -> None:
        """Start a sample of translation control: set its period and the planned acceleration."""
        ratio = math.floor(self.slow_period / self.fast_period + 0.5)
        if ratio < 1:
            ratio = 1
        change = math.ceil(self.turn_end / self.fast_period - STEP_ROUNDING)
        self.translation_period = self.fast_period
        following = self.next_tick + 1
        if self.next_tick < change:
            self.translation_period = float(ratio) * self.fast_period
            following = self.next_tick + ratio
            if following > change:
                following = change
        begin = time + self.delay_fraction * self.translation_period
        if self.translation_count == 0:
            begin = time  # no force acts before the first command, which compensates for this
        end = (float(following) + self.delay_fraction) * self.fast_period
        if following < change:
            end = float(following) * self.fast_period + self.delay_fraction * self.translation_period
        self.planned_acceleration = vector(0.0, 0.0, 0.0)
        if end > begin:
            planned = self.motion(end)
            self.planned_acceleration = (planned.velocity - self.granted_velocity) / (end - begin)
            self.granted_velocity = planned.velocity
        self.next_tick = following
        self.translation_count = self.translation_count + 1

    def publish(self, time: float) -> None:
        """Set the outputs to the plan for ``time`` (s)."""
        planned = self.motion(time)
        self.planned_position = planned.position
        self.planned_velocity = planned.velocity
        target = self.target_position + time * self.target_velocity
        self.planned_relative_position = target - self.planned_position
        self.turn(time)
        self.phase = RendezvousPhase.HOLD
        if time < self.turn_start:
            self.phase = RendezvousPhase.ACCELERATE
        elif time < self.turn_end:
            self.phase = RendezvousPhase.TURN
        elif time < self.arrival_time:
            self.phase = RendezvousPhase.APPROACH

    def step(self, t: float, h: float) -> None:
        time = t + h - self.start_time
        if time >= (float(self.next_tick) - STEP_ROUNDING) * self.fast_period:
            self.tick(float(self.next_tick) * self.fast_period)
        self.publish(time)
