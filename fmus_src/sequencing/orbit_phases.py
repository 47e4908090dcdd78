"""From the orbit to the end of main braking: phases 1 to 3 of a landing."""

import math

from ..block import Parameter, State
from ..interfaces.ports.landing import CommandSource, TerminalStatus
from ..kernel.enumerations import Enumeration, member
from ..kernel.functions import cos
from ..mathlib.lunar.gravity import altitude_of, from_centre
from ..mathlib.lunar.landing_site import site_below
from ..mathlib.orbits.deorbit import against_horizontal, central_angle, deorbit_burn, ground_range, lowest_altitude
from ..mathlib.vectors import dot, norm
from ..units import deg
from .landing_sequence import NEVER, ROUNDING, LandingPhase, LandingSequence, LandingStatus


class PhaseEnd(Enumeration):
    """Ending of deorbit, coast and braking."""

    GOES_ON = member("goes on")
    OVER = member("over")
    ELSEWHERE = member("over, far from the site")


class OrbitPhases(LandingSequence, interface=True):
    """Deorbit, coast and braking: each says at every step whether it is over.

    Deorbit brakes against the horizontal velocity, its middle where the ellipse's pericentre comes to lie braking_range
    before the site; how long is computed anew in every step, and held from hold_time before the end, since a
    remainder that is computed anew is never burnt. Braking ends handover_time_to_go before its target, or, where it is
    then far from the site, when it is slow or at its end.
    """

    braking_range = Parameter(285e3, unit="m", minimum=0.0, description="ground range from the site at which to brake")
    pericentre_altitude = Parameter(15e3, unit="m", minimum=0.0, description="that the deorbit aims at")
    deorbit_throttle = Parameter(0.1, unit="1", minimum=1e-3, maximum=1.0, description="part of maximum_thrust")
    hold_time = Parameter(1.0, unit="s", minimum=0.0, description="before its end the deorbit's burn is held")
    deorbit_patience = Parameter(2.0, unit="1", minimum=1.0, description="longest burn over the planned one")
    lowest_coast = Parameter(
        12e3, unit="m", description="altitude below which the coast is given up where it would come to the ground"
    )
    coast_clearance = Parameter(
        300.0,
        unit="m",
        minimum=0.0,
        description="least altitude of the coast up to braking_range; below: to the ground",
    )
    coast_patience = Parameter(
        20.0, unit="s", minimum=0.0, description="how long the estimate must say so: the first fixes settle meanwhile"
    )
    pointing_tolerance = Parameter(
        deg(2.0), unit="rad", minimum=0.0, description="ignite with the axis so close to its command"
    )
    pointing_patience = Parameter(30.0, unit="s", minimum=0.0, description="ignite after that in any case")
    handover_time_to_go = Parameter(28.0, unit="s", minimum=0.0, description="left of the braking when hover 1 begins")
    braking_patience = Parameter(450.0, unit="s", minimum=0.0, description="longest braking")
    solution_patience = Parameter(20.0, unit="s", minimum=0.0, description="longest braking without a solution")
    far_range = Parameter(5e3, unit="m", minimum=0.0, description="ground left from which on braking ends elsewhere")
    slow_speed = Parameter(30.0, unit="m/s", minimum=0.0, description="at which braking elsewhere ends")
    ignition_time = State(NEVER, frozen=True, unit="s", description="of the deorbit; -1: not yet")
    planned_burn = State(0.0, frozen=True, unit="s", description="of the deorbit, as it was at ignition")
    holding = State(False, description="the deorbit's burn is held")
    falling_since = State(
        NEVER, unit="s", description="the estimate has led to the ground before braking_range from then on; -1: no"
    )
    unsolved_since = State(
        NEVER, unit="s", description="the braking guidance has had no solution from then on; -1: it has"
    )
    flown_divert = State(0, description="divert_count that the site belongs to")
    elsewhere = State(False, description="braking goes on to an end far from the site")

    def face_back(self, time: float) -> None:
        """Command against the horizontal velocity, without thrust."""
        turning = against_horizontal(self.sampled_position, self.sampled_velocity, self.moon_radius)
        self.command.thrust_direction = turning.direction
        self.command.thrust_direction_rate = turning.rate
        self.command.thrust_acceleration = 0.0
        self.command.command_time = time
        self.command.burn_duration = 0.0

    def begin_deorbit(self) -> None:
        """Begin an own command; the first step sets its direction."""
        self.take_over(CommandSource.OWN, False)

    def deorbit(self, t: float, ahead: float) -> int:
        """Wait, ignite, burn."""
        if not self.holding:
            self.face_back(t)
            acceleration = self.deorbit_throttle * self.maximum_thrust / self.sampled_mass
            burn = deorbit_burn(
                self.sampled_position,
                self.sampled_velocity,
                self.moon_radius + self.pericentre_altitude,
                self.moon_radius,
                self.gravitational_parameter,
                acceleration,
            )
            if self.ignition_time < 0.0 and self.is_time_to_burn(burn):
                self.ignition_time = ahead
                self.planned_burn = burn
                self.engine_on = True
                burn = burn + ahead - t
            if self.engine_on:
                self.command.thrust_acceleration = acceleration
                self.command.burn_duration = burn
                self.holding = burn <= self.hold_time
        if self.engine_on and ahead >= self.command.command_time + self.command.burn_duration - ROUNDING:
            return PhaseEnd.OVER
        if self.engine_on and ahead - self.ignition_time >= self.deorbit_patience * self.planned_burn:
            self.note(LandingStatus.TIMEOUT, ahead)
            return PhaseEnd.OVER
        return PhaseEnd.GOES_ON

    def is_time_to_burn(self, burn: float) -> bool:
        """Return True if a burn (s) from now has its middle braking_range and half a revolution
        before the site, or later."""
        turned = norm(self.sampled_velocity) / norm(from_centre(self.sampled_position, self.moon_radius))
        place = math.pi + self.braking_range / self.moon_radius + 0.5 * burn * turned
        return central_angle(self.sampled_position, self.moon_radius) <= place

    def coast(self, t: float, ahead: float) -> int:
        """Coast until the site is near."""
        self.face_back(t)
        before_site = self.sampled_position.z > -self.moon_radius
        left = ground_range(self.sampled_position, self.moon_radius) - self.braking_range
        if before_site and left <= 0.0:
            return PhaseEnd.OVER
        if not self.is_falling(left / self.moon_radius):
            self.falling_since = NEVER
        elif self.falling_since < 0.0:
            self.falling_since = t
        if self.falling_since >= 0.0 and ahead - self.falling_since >= self.coast_patience - ROUNDING:
            self.note(LandingStatus.TIMEOUT, ahead)
            return PhaseEnd.OVER
        return PhaseEnd.GOES_ON

    def is_falling(self, angle: float) -> bool:
        """Return True if the coast is low and reaches the ground before its end, which is an ``angle`` (rad) ahead.

        A low pericentre alone is no reason to brake from farther away, which takes too much propellant.
        """
        if altitude_of(self.sampled_position, self.moon_radius) >= self.lowest_coast:
            return False
        lowest = lowest_altitude(
            self.sampled_position, self.sampled_velocity, angle, self.moon_radius, self.gravitational_parameter
        )
        return lowest < self.coast_clearance

    def begin_braking(self) -> None:
        """Begin the braking guidance's command, without thrust until the axis is on it."""
        self.take_over(CommandSource.BRAKING, False)
        self.flown_divert = self.sampled_divert

    def divert_site(self) -> None:
        """Move the site below the target that the braking is diverted to."""
        if self.sampled_divert != self.flown_divert:
            self.flown_divert = self.sampled_divert
            self.site = site_below(self.sampled_divert_position, self.moon_radius)

    def ignite(self, answered: bool, ahead: float) -> None:
        """Turn the engine on once the axis is on the guidance's direction, or after a while in any case."""
        minimum = cos(self.pointing_tolerance) * norm(self.sampled_attitude) * norm(self.sampled_direction)
        if answered and dot(self.sampled_attitude, self.sampled_direction) >= minimum:
            self.engine_on = True
        elif self.since_start(ahead) >= self.pointing_patience - ROUNDING:
            self.note(LandingStatus.TIMEOUT, ahead)
            self.engine_on = True

    def brake(self, t: float, ahead: float) -> int:
        """Ignite, and look for the end. What the guidance put out before the phase began does not count."""
        answered = self.sampled_command_time >= self.phase_time[LandingPhase.BRAKING - 1] - ROUNDING
        self.divert_site()
        if not self.engine_on:
            self.ignite(answered, ahead)
        if self.sampled_braking_status < TerminalStatus.NOT_CONVERGED or not answered:
            self.unsolved_since = NEVER
        elif self.unsolved_since < 0.0:
            self.unsolved_since = t
        far = ground_range(self.sampled_position, self.moon_radius) > self.far_range
        unsolved = self.unsolved_since >= 0.0 and ahead - self.unsolved_since >= self.solution_patience - ROUNDING
        if unsolved or self.since_start(ahead) >= self.braking_patience - ROUNDING:
            self.note(LandingStatus.BRAKING_FAILED, ahead)
            return PhaseEnd.ELSEWHERE if far else PhaseEnd.OVER
        # without a solution from its start on, the guidance says that no time is left
        counts = self.sampled_braking_status < TerminalStatus.NOT_CONVERGED or self.sampled_time_to_go > 0.0
        ending = self.sampled_braking_finished or (counts and self.sampled_time_to_go <= self.handover_time_to_go)
        ending = ending and answered
        if ending and far:
            self.elsewhere = True
        if self.elsewhere:
            if self.sampled_braking_finished or norm(self.sampled_velocity) < self.slow_speed:
                return PhaseEnd.ELSEWHERE
        elif ending:
            return PhaseEnd.OVER
        return PhaseEnd.GOES_ON
