"""A point-mass lander over a spherical Moon, with an engine and an attitude that take time."""

import math

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.gravity import STANDARD_GRAVITY, altitude_of, central_gravity
from ..mathlib.pursuit import follow, goal_at
from ..mathlib.vectors import Vector3, norm, vector


class SphericalMoonLander(Block):
    """Point mass with one engine along its thrust axis, in the central field of a Moon that does not rotate.

    The commanded direction at time t is (d + d' (t - command_time)) normalised, the commanded thrust
    is thrust until command_time + burn_duration and 0 from there, inside a step if need be. Thrust
    follows with a first-order lag from 0 at the start; mass' = -thrust/(standard gravity *
    specific_impulse) and ends thrust where there is no mass left. The attitude starts on the first
    command and turns towards it at angle/direction_response, no faster than slew_rate_limit; without
    both it is the command. Where altitude is 0 or less at the end of an internal step everything stops
    and is kept. Frame: landing site (x north, y west, z up), the Moon's centre at (0, 0, -moon_radius).

    Thrust and mass are exact between switchings. Motion: Runge-Kutta-Nystrom of fourth order (Hairer,
    Norsett and Wanner 1993, section II.14), of third where the attitude comes off its limit within a
    step; thrust is scaled so that each step obeys the rocket equation. Steps are internal_step, or
    equal parts of it no longer than lag and response (down to 1/100, below which a response counts as
    none), and cut where thrust ends. So the results depend on how communication points cut a flight
    by rounding only, if these are whole multiples of internal_step apart; other distances are divided
    into equal steps.
    """

    initial_position = Parameter(
        [266731.0, 0.0, -2233.0], unit="m", frame="landing site", description="position at the start"
    )
    initial_velocity = Parameter(
        [-1676.0, 0.0, 208.0], unit="m/s", frame="landing site", description="velocity at the start"
    )
    initial_mass = Parameter(940.0, unit="kg", minimum=1e-3, description="mass at the start")
    specific_impulse = Parameter(319.0, unit="s", minimum=1e-3, description="of the engine")
    moon_radius = Parameter(1.7374e6, unit="m", minimum=1.0, description="of the sphere that the site lies on")
    gravitational_parameter = Parameter(4.9028e12, unit="m3/s2", minimum=0.0, description="of the Moon")
    thrust_lag = Parameter(0.1, unit="s", minimum=0.0, description="time constant of thrust; 0: none")
    direction_response = Parameter(0.5, unit="s", minimum=0.0, description="time constant of the attitude; 0: none")
    slew_rate_limit = Parameter(
        0.17453292519943295, unit="rad/s", minimum=0.0, description="largest rate of the attitude; 0: no limit"
    )
    internal_step = Parameter(0.1, unit="s", minimum=1e-4, description="longest integration step")
    latch_at_burn_end = Parameter(
        False, description="keep the motion as it is when a burn ends inside a step, whatever thrust is left by a lag"
    )
    thrust = Input(0.0, unit="N", description="commanded thrust; below 0 counts as 0")
    thrust_direction = Input(
        [0.0, 0.0, 1.0], unit="1", frame="landing site", description="commanded direction at command_time"
    )
    thrust_direction_rate = Input([0.0, 0.0, 0.0], unit="1/s", frame="landing site", description="its derivative")
    command_time = Input(0.0, unit="s", description="time that direction and duration count from")
    burn_duration = Input(0.0, unit="s", description="how long to thrust from command_time on")
    position = Output([0.0, 0.0, 0.0], unit="m", frame="landing site", description="position")
    velocity = Output([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="velocity")
    speed = Output(0.0, unit="m/s", description="length of velocity")
    mass = Output(940.0, unit="kg", description="mass")
    altitude = Output(0.0, unit="m", description="above the sphere of moon_radius")
    specific_force = Output(
        [0.0, 0.0, 0.0], unit="m/s2", frame="landing site", description="mean of thrust over mass in the last step"
    )
    sensed_velocity = Output(
        [0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="integral of specific force from the start"
    )
    delivered_thrust = Output(0.0, unit="N", description="thrust of the engine")
    attitude = Output([0.0, 0.0, 1.0], unit="1", frame="landing site", description="unit vector of thrust, as flown")
    coast_time = Output(0.0, unit="s", description="time since the commanded burn ended; 0 while it goes on")
    ground_contact = Output(False, description="the ground was reached")
    latched = State(False, description="a burn has ended and the motion is kept")
    aligned = State(False, description="the attitude has been put on the first command")
    response = State(0.5, unit="s", description="direction_response, 0 where it is too short to count")
    longest_step = State(0.1, unit="s", description="internal_step or the part of it that is taken")

    def initialize(self) -> None:
        self.mass = self.initial_mass
        self.position = self.initial_position
        self.velocity = self.initial_velocity
        self.altitude = altitude_of(self.position, self.moon_radius)
        self.speed = norm(self.velocity)
        self.ground_contact = self.altitude <= 0.0
        self.response = self.direction_response
        if self.response < 0.01 * self.internal_step:
            self.response = 0.0
        shortest = self.internal_step
        if self.response > 0.0 and self.response < shortest:
            shortest = self.response
        if self.thrust_lag > 0.0 and self.thrust_lag < shortest:
            shortest = self.thrust_lag
        parts = 100.0
        if shortest > 0.01 * self.internal_step:
            parts = float(math.ceil(self.internal_step / shortest - 1e-9))
        self.longest_step = self.internal_step / parts

    def point(self, t: float) -> None:
        """Put the attitude on the command of time t (s)."""
        since = t - self.command_time
        self.attitude = goal_at(self.thrust_direction, self.thrust_direction_rate, since, self.attitude)

    def turn(self, t: float, h: float) -> None:
        """Advance the attitude by h (s)."""
        self.attitude = follow(
            self.attitude,
            self.thrust_direction,
            self.thrust_direction_rate,
            t - self.command_time,
            h,
            self.response,
            self.slew_rate_limit,
        )

    def burn(self, h: float, commanded: float) -> tuple[Vector3, float]:
        """Thrust over mass (m/s2) at start, middle and end of a step, and the speed gained; spends the mass."""
        exhaust = STANDARD_GRAVITY * self.specific_impulse
        excess = 0.0
        half = 1.0
        if self.thrust_lag > 0.0:
            excess = self.delivered_thrust - commanded
            half = -math.expm1(-0.5 * h / self.thrust_lag)
        middle_used = (0.5 * commanded * h + excess * self.thrust_lag * half) / exhaust
        used = (commanded * h + excess * self.thrust_lag * half * (2.0 - half)) / exhaust
        if used >= self.mass:
            self.delivered_thrust = 0.0
            return vector(0.0, 0.0, 0.0), 0.0
        first = (commanded + excess) / self.mass
        middle = (commanded + excess * (1.0 - half)) / (self.mass - middle_used)
        self.delivered_thrust = commanded + excess * (1.0 - half) * (1.0 - half)
        self.mass = self.mass - used
        return vector(first, middle, self.delivered_thrust / self.mass), exhaust * math.log1p(used / self.mass)

    def move(self, t: float, h: float, commanded: float) -> Vector3:
        """Move by h (s) under one command; returns the velocity that thrust gives (m/s)."""
        force, gain = self.burn(h, commanded)
        simpson = h * (force[0] + 4.0 * force[1] + force[2]) / 6.0
        if simpson > 0.0:
            force = force * gain / simpson
        if self.response <= 0.0 and self.slew_rate_limit <= 0.0:
            self.point(t)
        first = force[0] * self.attitude
        self.turn(t, 0.5 * h)
        middle = force[1] * self.attitude
        self.turn(t + 0.5 * h, 0.5 * h)
        g1 = self.gravity(self.position)
        g2 = self.gravity(self.position + 0.5 * h * (self.velocity + 0.25 * h * (g1 + first)))
        g4 = self.gravity(self.position + h * (self.velocity + 0.5 * h * (g2 + middle)))
        fall = g1 + 2.0 * g2
        push = first + 2.0 * middle
        gained = h * (push + 2.0 * middle + force[2] * self.attitude) / 6.0
        self.position = self.position + h * (self.velocity + h * (fall + push) / 6.0)
        self.velocity = self.velocity + gained + h * (fall + 2.0 * g2 + g4) / 6.0
        self.altitude = altitude_of(self.position, self.moon_radius)
        if self.altitude <= 0.0:
            self.ground_contact = True
            self.delivered_thrust = 0.0
        return gained

    def gravity(self, position: Vector3) -> Vector3:
        """Gravity (m/s2) at a position (m)."""
        return central_gravity(position, self.moon_radius, self.gravitational_parameter)

    def step(self, t: float, h: float) -> None:
        gained = vector(0.0, 0.0, 0.0)
        if not self.aligned:
            self.point(t)
            self.aligned = True
        commanded = self.thrust
        if commanded < 0.0:
            commanded = 0.0
        pieces = int(h / self.longest_step - 1e-9) + 1
        piece = h / pieces
        for k in range(pieces):
            start = t + k * piece
            burning = self.command_time + self.burn_duration - start
            if not self.ground_contact and not self.latched:
                if burning >= piece:
                    pushed = self.move(start, piece, commanded)
                elif burning <= 0.0:
                    pushed = self.move(start, piece, 0.0)
                else:
                    pushed = self.move(start, burning, commanded)
                    self.latched = self.latch_at_burn_end
                    if not self.ground_contact and not self.latched:
                        gained = gained + pushed
                        pushed = self.move(start + burning, piece - burning, 0.0)
                gained = gained + pushed
        self.speed = norm(self.velocity)
        self.coast_time = 0.0
        if t + h > self.command_time + self.burn_duration:
            self.coast_time = t + h - (self.command_time + self.burn_duration)
        self.sensed_velocity = self.sensed_velocity + gained
        self.specific_force = gained / h
