"""Plans between hovers: their computation, and reference motion and thrust at any time."""

import math

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import landing
from ..interfaces.ports.landing import HoverStatus
from ..kernel.functions import cos, expm1, sin
from ..kernel.integrators import Translation
from ..mathlib.attitude.rotation import TurningDirection
from ..mathlib.hover.motion import HoverVehicle, motion, propellant, thrust_impulse
from ..mathlib.hover.programme import programme
from ..mathlib.hover.shape import HoverProgramme, HoverShape, pitch, shape_of, without_programme
from ..mathlib.hover.solution import PlanKind
from ..mathlib.hover.transfer_polynomial import (
    Transfer,
    TransferLimits,
    capture,
    expense,
    slow_duration,
    thrust_along,
    transfer,
    transfer_position,
    transfer_velocity,
)
from ..mathlib.lunar.gravity import STANDARD_GRAVITY, from_centre, vertical_at
from ..mathlib.vectors import Vector3, add_along, clip, cross, dot, is_finite, norm, smallest_component, vector
from ..units import deg

LEAST_MEASURED = 0.5  # fraction of the planned minimum; with less measured thrust the engine counts as off
# Limits of a transfer that replaces a programme.
STANDBY_SPEED = 60.0  # m/s
STANDBY_ACCELERATION = 0.5  # m/s2


class HoverPlan(Block, interface=True):
    """Plan of a motion that ends in an upright hover at rest, with its thrust.

    Programmes lie in the plane through start and target that contains the target's vertical. Plans keep margins of
    thrust and angular acceleration for control.

    Frame: landing site.

    Assumes uniform gravity over a plan, the mean of gravity at start and target, and a thrust axis of limited angular
    acceleration.

    Source: Huang 2017 (planar motion); extension to three dimensions: this repository. See
    docs/systems/hover_transfer.md.
    """

    specific_impulse = landing.SPECIFIC_IMPULSE.parameter(300.0)
    maximum_thrust = landing.MAXIMUM_THRUST.parameter(4707.192, "largest thrust of the engine", minimum=1e-3)
    minimum_thrust = landing.MINIMUM_THRUST.parameter(313.8128, "least thrust of the burning engine")
    planned_maximum = Parameter(
        0.9, unit="1", minimum=1e-3, maximum=1.0, description="largest thrust in plans, as a fraction of maximum_thrust"
    )
    planned_minimum = Parameter(
        0.1, unit="1", minimum=1e-3, maximum=1.0, description="least thrust in plans, as a fraction of maximum_thrust"
    )
    planned_angular_acceleration = Parameter(
        deg(0.7),
        unit="rad/s2",
        minimum=1e-5,
        maximum=1.0,
        description="largest angular acceleration of the thrust axis in plans",
    )
    slow_speed = Parameter(4.0, unit="m/s", minimum=1e-3, description="largest speed in a slow transfer")
    slow_acceleration = Parameter(0.3, unit="m/s2", minimum=1e-3, description="largest acceleration in a slow transfer")
    uniform_gravity = landing.UNIFORM_GRAVITY.parameter()
    gravitational_parameter = landing.GRAVITATIONAL_PARAMETER.parameter()
    moon_radius = landing.MOON_RADIUS.parameter(description="distance of the landing site from the Moon's centre")
    target_position = landing.POSITION.input("target position of the next hover, relative to the landing site")
    position = landing.POSITION.input("estimated position of the lander relative to the landing site")
    velocity = landing.VELOCITY.input("estimated velocity of the lander relative to the landing site")
    mass = landing.MASS.input("estimated mass of the lander")
    attitude = landing.DIRECTION.input("measured direction of the thrust axis, unit vector")
    angular_rate = landing.ANGULAR_RATE.input("measured angular rate of the thrust axis")
    velocity_increment = landing.VELOCITY.input("measured time integral of specific force over the last sample period")
    status = Output(HoverStatus, direct=True)
    plan_kind = Output(PlanKind, direct=True, description="kind of the current plan")
    predicted_propellant = landing.PREDICTED_PROPELLANT.output(direct=True)
    programme = Output(
        [0.0] * 5,
        unit="s",
        direct=True,
        description="times t2, t5, w, tp and t7 of the programme since the plan's start; 0: no programme",
    )
    origin = State(
        [0.0, 0.0, 0.0],
        frozen=True,
        unit="m",
        frame="landing site",
        description="start position of the plan relative to the landing site",
    )
    goal = State(
        [0.0, 0.0, 0.0],
        frozen=True,
        unit="m",
        frame="landing site",
        description="end position of the plan relative to the landing site",
    )
    up = State(
        [0.0, 0.0, 1.0],
        frozen=True,
        unit="1",
        frame="landing site",
        description="local vertical of the plan, upwards, unit vector",
    )
    along = State(
        [1.0, 0.0, 0.0],
        frozen=True,
        unit="1",
        frame="landing site",
        description="horizontal direction from start to end of the plan, unit vector",
    )
    plan_gravity = State(
        0.0, frozen=True, unit="m/s2", description="uniform gravitational acceleration assumed by the plan"
    )
    duration = State(0.0, frozen=True, unit="s", description="duration of the plan")
    vehicle = State(HoverVehicle)
    shape = State(HoverShape)
    transfer = State(Transfer)

    def gravity_at(self, position: Vector3) -> float:
        """Return the magnitude of gravity (m/s2) at a position (m)."""
        if self.uniform_gravity > 0.0:
            return self.uniform_gravity
        centred = from_centre(position, self.moon_radius)
        square = dot(centred, centred)
        if not square > 0.0:
            return 0.0
        return self.gravitational_parameter / square

    def vertical(self, position: Vector3) -> Vector3:
        """Return the upward unit vector at a position (m)."""
        if self.uniform_gravity > 0.0:
            return vector(0.0, 0.0, 1.0)
        return vertical_at(position, self.moon_radius)

    def drop_plan(self) -> None:
        """Discard the plan, and hold at the target from now on."""
        self.status = HoverStatus.GOOD
        self.plan_kind = PlanKind.NONE
        self.duration = 0.0
        self.predicted_propellant = 0.0
        self.set_programme(without_programme())
        self.origin = self.position
        self.goal = self.target_position
        self.up = self.vertical(self.goal)
        self.plan_gravity = 0.5 * (self.gravity_at(self.origin) + self.gravity_at(self.goal))

    def can_plan(self) -> bool:
        """Return True if all data are finite and the engine can lift the vehicle; if not, hold with status 3."""
        fine = is_finite(self.position) and is_finite(self.velocity) and is_finite(self.target_position)
        fine = fine and math.isfinite(self.mass) and self.mass > 0.0
        fine = fine and self.maximum_thrust > self.mass * self.plan_gravity
        if not fine:
            self.give_up()
        return fine

    def give_up(self) -> None:
        """Discard the plan, and hold the present position with status 3."""
        self.drop_plan()
        self.status = HoverStatus.NO_PLAN
        if is_finite(self.position):
            self.goal = self.position

    def plan_programme(self) -> None:
        """Plan the programme of least propellant, or a fast polynomial if none exists."""
        exhaust = STANDARD_GRAVITY * self.specific_impulse
        full = self.maximum_thrust / self.mass
        self.vehicle = HoverVehicle(
            full=self.planned_maximum * full,
            least=self.planned_minimum * full,
            exhaust=exhaust,
            gravity=self.plan_gravity,
            swing=self.planned_angular_acceleration,
        )
        way = self.goal - self.origin
        y = dot(way, self.up)
        side = way - y * self.up
        x = norm(side)
        planned = programme(x, y, self.vehicle)
        times = planned.programme
        self.set_programme(times)
        if planned.kind == PlanKind.NONE:
            self.plan_transfer(STANDBY_SPEED, STANDBY_ACCELERATION)
            if self.status == HoverStatus.GOOD:
                self.status = HoverStatus.NO_PROGRAMME
        else:
            if x > 0.0:
                self.along = side / x
            else:
                k, smallest = smallest_component(self.up)
                level = add_along(-smallest * self.up, k, 1.0)
                self.along = level / norm(level)
            if planned.kind == PlanKind.VERTICAL:
                self.origin = self.goal - y * self.up
            shaped = shape_of(times, self.vehicle.swing)
            self.shape = shaped.shape
            if shaped.exists:
                self.plan_kind = planned.kind
                self.duration = times.t7
                self.predicted_propellant = self.mass * propellant(self.shape, self.vehicle, self.duration)

    def set_programme(self, p: HoverProgramme) -> None:
        """Set the outputs of a programme's switching times."""
        self.programme[0] = p.t2
        self.programme[1] = p.t5
        self.programme[2] = p.width
        self.programme[3] = p.last_burn
        self.programme[4] = p.t7

    def plan_transfer(self, speed: float, acceleration: float) -> None:
        """Plan a polynomial from rest to rest within limits of speed (m/s) and acceleration (m/s2)."""
        way = self.goal - self.origin
        height = dot(way, self.up)
        longer = norm(way - height * self.up)
        if abs(height) > longer:
            longer = abs(height)
        duration = slow_duration(longer, speed, acceleration)
        rest = vector(0.0, 0.0, 0.0)
        self.transfer = transfer(self.origin, rest, rest, rest, self.goal, duration)
        spent = expense(self.transfer, duration, self.lift(), self.mass, self.limits(), math.inf)
        self.take_polynomial(duration, spent.impulse)

    def plan_capture(self, cycle: float) -> None:
        """Plan a polynomial from the present motion, with the thrust measured over the last cycle (s).

        Without measured thrust the engine is assumed to support the weight along its axis immediately.
        """
        exhaust = STANDARD_GRAVITY * self.specific_impulse
        force = norm(self.velocity_increment) / cycle
        full = self.maximum_thrust / self.mass
        if force < LEAST_MEASURED * self.planned_minimum * full:
            force = clip(dot(self.lift(), self.attitude), self.planned_minimum * full, self.planned_maximum * full)
        pull = force * self.attitude - self.lift()
        jerk = force * cross(self.angular_rate, self.attitude) + force * force / exhaust * self.attitude
        limits = self.limits()
        best = capture(self.origin, self.velocity, pull, jerk, self.goal, self.lift(), self.mass, limits)
        if best.duration > 0.0:
            self.transfer = best.transfer
        self.take_polynomial(best.duration, best.expense.impulse)
        if self.status == HoverStatus.GOOD and best.expense.excess > 0.0:
            self.status = HoverStatus.BEYOND_LIMITS

    def limits(self) -> TransferLimits:
        """Return the limits of thrust and angular acceleration for plans."""
        return TransferLimits(
            maximum_thrust=self.planned_maximum * self.maximum_thrust,
            minimum_thrust=self.planned_minimum * self.maximum_thrust,
            angular_acceleration=self.planned_angular_acceleration,
            exhaust_speed=STANDARD_GRAVITY * self.specific_impulse,
        )

    def take_polynomial(self, duration: float, spent: float) -> None:
        """Plan the polynomial of this duration (s) and impulse ``spent`` (m/s); status 3 if these are not finite."""
        if duration > 0.0 and math.isfinite(duration) and math.isfinite(spent):
            self.plan_kind = PlanKind.POLYNOMIAL
            self.duration = duration
            exhaust = STANDARD_GRAVITY * self.specific_impulse
            self.predicted_propellant = -self.mass * expm1(-spent / exhaust)
        else:
            self.give_up()

    def lift(self) -> Vector3:
        """Return the thrust over mass (m/s2) that balances the gravity assumed in the plan."""
        return self.plan_gravity * self.up

    def plan_motion(self, t: float) -> Translation:
        """Return the motion of the plan at time t (s) after its start."""
        rest = vector(0.0, 0.0, 0.0)
        if t >= self.duration:
            return Translation(position=self.goal, velocity=rest)
        if self.plan_kind == PlanKind.POLYNOMIAL:
            place = transfer_position(self.transfer, t, self.duration)
            return Translation(position=place, velocity=transfer_velocity(self.transfer, t, self.duration))
        s = motion(self.shape, self.vehicle, t)
        if not s.exists:
            return Translation(position=self.goal, velocity=rest)
        place = self.origin + s.x * self.along + s.y * self.up
        return Translation(position=place, velocity=s.x_rate * self.along + s.y_rate * self.up)

    def plan_direction(self, t: float) -> TurningDirection:
        """Return the thrust direction of the plan at time t (s) after its start."""
        rest = vector(0.0, 0.0, 0.0)
        if t >= self.duration:
            return TurningDirection(direction=self.up, rate=rest)
        if self.plan_kind == PlanKind.POLYNOMIAL:
            thrust = thrust_along(self.transfer, t, self.duration, self.lift())
            return TurningDirection(direction=thrust.direction, rate=thrust.rate)
        turn = pitch(self.shape, self.vehicle.swing, t)
        sine = sin(turn.deviation)
        cosine = cos(turn.deviation)
        direction = cosine * self.up - sine * self.along
        return TurningDirection(direction=direction, rate=-turn.rate * (sine * self.up + cosine * self.along))

    def plan_rate(self, t: float) -> Vector3:
        """Return the angular rate (rad/s) of the plan's thrust axis at time t (s) after its start."""
        turning = self.plan_direction(t)
        return cross(turning.direction, turning.rate)

    def plan_impulse(self, begin: float, end: float) -> float:
        """Return the integral (m/s) of thrust over mass between two times (s) after the start of the plan."""
        if self.plan_kind != PlanKind.POLYNOMIAL:
            return thrust_impulse(self.shape, self.vehicle, begin, end)
        first = thrust_along(self.transfer, begin, self.duration, self.lift())
        middle = thrust_along(self.transfer, 0.5 * (begin + end), self.duration, self.lift())
        last = thrust_along(self.transfer, end, self.duration, self.lift())
        return (end - begin) * (first.size + 4.0 * middle.size + last.size) / 6.0
