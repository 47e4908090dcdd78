"""Three-dimensional descent by a network operator."""

from ..block import State
from ..interfaces.ports import landing
from ..interfaces.ports.landing import UNLIMITED, TerminalStatus
from ..kernel.functions import atan2, cos, expm1, sin
from ..mathlib.lunar.gravity import STANDARD_GRAVITY, altitude_of, from_centre
from ..mathlib.vectors import Vector3, dot, norm, vector
from .network_operator_law import NetworkOperatorLaw
from .terminal_guidance import TerminalGuidance

LEAST_HORIZONTAL_SPEED = 0.5  # m/s, below which the horizontal direction is kept constant


class NetworkOperatorGuidance(NetworkOperatorLaw, TerminalGuidance):
    """Braking by a network operator, down to the hand-over to another guidance.

    The planar law acts in the plane of position (from the Moon's centre) and velocity. The flight ends at the first
    sample below handover_speed within the altitude limits. Direction rates are 0; sample periods of at most 0.1 s are
    suitable.

    time_to_go is the time in which the present thrust reduces the speed to handover_speed, accurate to 10 % in the
    published descents; it is 0 when the vehicle is slow but the altitude is outside the limits.

    Of the slot's parameters the law uses moon_radius and the altitude of target_position, or of a divert; the other
    parameters of target, gravity and last burn, and frozen_time_to_go, have no effect. If the matrix is not a network
    operator, the status is 3 and there is no thrust.

    Source: Diveev, Pupkov and Sofronova 2013. See docs/systems/lunar_descent_2d.md.
    """

    target_position = TerminalGuidance.target_position.with_start([0.0, 0.0, 1500.0])
    specific_impulse = landing.SPECIFIC_IMPULSE.parameter(
        description="specific impulse of the engine, used for time_to_go"
    )
    # hand-over is specified for 6 m/s, with a speed known to 0.1 m/s
    handover_speed = landing.HANDOVER_SPEED.parameter()
    handover_altitude_low = landing.HANDOVER_ALTITUDE_LOW.parameter()
    handover_altitude_high = landing.HANDOVER_ALTITUDE_HIGH.parameter()
    final_altitude = State(0.0, unit="m", description="altitude of the target above the sphere of moon_radius")
    altitude = State(0.0, unit="m", description="altitude of the lander above the sphere of moon_radius")
    forward = State(
        [1.0, 0.0, 0.0],
        unit="1",
        frame="landing site",
        description="horizontal direction of flight at the start, unit vector",
    )

    def begin(self, time: float) -> None:
        self.final_altitude = altitude_of(self.aim_position, self.moon_radius)
        self.command.command_time = time
        self.decode_law()
        self.solve()

    def solve(self) -> None:
        centred = from_centre(self.position, self.moon_radius)
        radius = norm(centred)
        if self.edge_count >= 0 and self.mass > 0.0 and radius > 0.0:
            self.altitude = radius - self.moon_radius
            self.command_thrust(centred / radius)
            self.status = TerminalStatus.GOOD
        else:
            self.status = TerminalStatus.NO_SOLUTION

    def command_thrust(self, up: Vector3) -> None:
        """Set the command from the law, with the local vertical ``up``."""
        vertical_speed = dot(self.velocity, up)
        horizontal = self.velocity - vertical_speed * up
        horizontal_speed = norm(horizontal)
        if horizontal_speed >= LEAST_HORIZONTAL_SPEED:
            self.forward = horizontal / horizontal_speed
        self.evaluate_law(-atan2(horizontal_speed, vertical_speed), self.altitude, self.final_altitude)
        angle = self.law_angle()
        direction = cos(angle) * up - sin(angle) * self.forward
        self.command.thrust_direction = direction / norm(direction)
        self.command.thrust_acceleration = self.law_thrust() / self.mass
        self.estimate_time()

    def estimate_time(self) -> None:
        """Set time_to_go by the rocket equation."""
        excess = norm(self.velocity) - self.handover_speed
        exhaust_speed = STANDARD_GRAVITY * self.specific_impulse
        self.time_to_go = 0.0
        if excess > 0.0:
            self.time_to_go = UNLIMITED
            if self.command.thrust_acceleration > 0.0:
                self.time_to_go = -expm1(-excess / exhaust_speed) * exhaust_speed / self.command.thrust_acceleration

    def reset_law(self) -> None:
        self.forward = vector(1.0, 0.0, 0.0)

    def process_sample(self, t: float, h: float) -> None:
        if not self.finished:
            if self.divert_count != self.flown_divert:
                self.divert()
                self.final_altitude = altitude_of(self.aim_position, self.moon_radius)
            self.solve()
            if self.status == TerminalStatus.GOOD:
                self.command.command_time = t + h
                slow = norm(self.velocity) < self.handover_speed
                low = self.altitude <= self.handover_altitude_high
                if slow and low and self.altitude >= self.handover_altitude_low:
                    self.finish(t + h)
