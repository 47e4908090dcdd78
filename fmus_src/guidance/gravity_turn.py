"""Gravity turn: thrust opposite to the velocity, ending at rest at the target's height."""

from ..block import Parameter, State
from ..interfaces.ports.landing import TerminalStatus
from ..kernel.functions import expm1
from ..mathlib.lunar.gravity import altitude_of, from_centre
from ..mathlib.lunar.gravity_turn import GravityTurn, gravity_turn
from ..mathlib.vectors import Vector3, across, dot, norm, vector
from .informed_guidance import LIMIT_THRUST, InformedGuidance


class GravityTurnGuidance(InformedGuidance):
    """Gravity turn: thrust opposite to the velocity, in constant ratio to gravity, to rest at the target's height.

    The law controls neither horizontal position nor velocity: the horizontal part of target_position, target_velocity,
    minimum_thrust, thrust_margin and largest_tilt have no effect, and frozen_time_to_go is not supported. With
    gravity_correction gravity is central gravity minus the centrifugal acceleration. With ignition_fraction there is no
    thrust until the demand reaches that fraction of maximum_thrust. The status is 1 if the demand exceeds
    maximum_thrust, and 3 at or below the target's height or while ascending.

    Assumes constant gravity over the remaining flight.

    Source: Citron, Dunin and Meissinger 1964.
    """

    last_burn = InformedGuidance.last_burn.with_start(2.0)
    ignition_fraction = Parameter(
        0.0,
        unit="1",
        minimum=0.0,
        maximum=1.0,
        description=(
            "demanded thrust at which the engine is ignited, as a fraction of maximum_thrust; 0: immediate ignition"
        ),
    )
    burning = State(False, description="true: engine ignited")

    def plan_frozen(self) -> bool:
        """Return False, since the law has no time to go to hold constant."""
        return False

    def reset_law(self) -> None:
        self.burning = self.burning and self.commanding  # a divert does not switch the engine off

    def local_gravity(self) -> tuple[Vector3, float]:
        """Return the local vertical, and gravity minus the centrifugal acceleration (m/s2) along it."""
        up = vector(0.0, 0.0, 1.0)
        g = self.gravity
        if self.gravity_correction:
            centred = from_centre(self.position, self.moon_radius)
            radius = norm(centred)
            up = centred / radius
            level = norm(across(self.velocity, up))
            g = self.gravitational_parameter / (radius * radius) - level * level / radius
        return up, g

    def height(self) -> float:
        """Return the height (m) above the target."""
        if self.gravity_correction:
            here = altitude_of(self.position, self.moon_radius)
            return here - altitude_of(self.aim_position, self.moon_radius)
        return self.position.z - self.aim_position.z

    def solve(self) -> None:
        self.measure_glide()
        up, g = self.local_gravity()
        speed = norm(self.velocity)
        self.limit = 0
        self.status = TerminalStatus.NO_SOLUTION
        if speed > 0.0:
            turn = gravity_turn(speed, -dot(self.velocity, up) / speed, self.height(), g)
            if turn.ratio > 0.0:
                self.status = TerminalStatus.GOOD
                self.time_to_go = turn.duration
                self.predict(turn, turn.ratio * g, up)
                self.brake(turn.ratio * g, speed, g * up)

    def predict(self, turn: GravityTurn, thrust: float, up: Vector3) -> None:
        """Set predicted propellant and miss of a gravity turn over level ground, with a thrust acceleration (m/s2)."""
        self.predicted_propellant = -self.mass * expm1(-thrust * turn.duration / self.exhaust_speed())
        way = across(self.aim_position - self.position, up)
        level = across(self.velocity, up)
        speed = norm(level)
        if speed > 0.0:
            way = way - turn.distance / speed * level
        self.predicted_miss = norm(way)

    def brake(self, thrust: float, speed: float, gravity: Vector3) -> None:
        """Command a thrust acceleration (m/s2) opposite to the velocity, at ``speed`` (m/s) and ``gravity`` (m/s2)."""
        direction = -1.0 / speed * self.velocity
        demand = thrust * self.mass
        self.burning = self.burning or demand >= self.ignition_fraction * self.maximum_thrust
        self.command.thrust_direction = direction
        self.command.thrust_direction_rate = across(gravity, direction) / speed
        self.command.thrust_acceleration = 0.0
        if self.burning:
            self.command.thrust_acceleration = thrust
        if demand > self.maximum_thrust:
            self.status = TerminalStatus.CLAMPED
            self.limit = LIMIT_THRUST
