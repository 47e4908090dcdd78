"""Phases 1 to 3 of a landing: from the orbit to the end of braking."""

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
    """Completion of deorbit, coast or braking."""

    GOES_ON = member("in progress")
    OVER = member("complete")
    ELSEWHERE = member("complete, far from the site")


class OrbitPhases(LandingSequence, interface=True):
    """Deorbit, coast and braking with their end conditions.

    The deorbit burn reduces the horizontal velocity. It is centred half a revolution plus braking_range before the
    site, which puts the ellipse's pericentre braking_range before the site. Its duration is recomputed every step until
    hold_time before its end. Braking ends handover_time_to_go before its target or, far from the site, at a low speed
    or when the guidance has finished.
    """

    braking_range = Parameter(
        285e3, unit="m", minimum=0.0, description="ground range from the site at the start of braking"
    )
    pericentre_altitude = Parameter(
        15e3, unit="m", minimum=0.0, description="target pericentre altitude of the deorbit"
    )
    deorbit_throttle = Parameter(
        0.1,
        unit="1",
        minimum=1e-3,
        maximum=1.0,
        description="thrust in the deorbit burn, as a fraction of maximum_thrust",
    )
    hold_time = Parameter(
        1.0, unit="s", minimum=0.0, description="remaining time of the deorbit burn below which its command is held"
    )
    deorbit_patience = Parameter(
        2.0,
        unit="1",
        minimum=1.0,
        description="longest duration of the deorbit burn, as a multiple of the planned duration",
    )
    lowest_coast = Parameter(12e3, unit="m", description="altitude below which a coast is ended if impact is predicted")
    coast_clearance = Parameter(
        300.0,
        unit="m",
        minimum=0.0,
        description="predicted altitude of the coast before braking_range below which impact is predicted",
    )
    coast_patience = Parameter(
        20.0, unit="s", minimum=0.0, description="time for which impact must be predicted before the coast is ended"
    )
    pointing_tolerance = Parameter(
        deg(2.0),
        unit="rad",
        minimum=0.0,
        description="largest angle between measured and commanded thrust axis at ignition",
    )
    pointing_patience = Parameter(
        30.0,
        unit="s",
        minimum=0.0,
        description="longest wait before ignition for the pointing error to fall below pointing_tolerance",
    )
    handover_time_to_go = Parameter(
        28.0, unit="s", minimum=0.0, description="time to go of the braking guidance at which hover 1 begins"
    )
    braking_patience = Parameter(
        450.0, unit="s", minimum=0.0, description="longest duration of braking before it counts as failed"
    )
    solution_patience = Parameter(
        20.0, unit="s", minimum=0.0, description="longest time without a solution of the braking guidance"
    )
    far_range = Parameter(
        5e3,
        unit="m",
        minimum=0.0,
        description="remaining ground range to the site above which braking is completed away from the site",
    )
    slow_speed = Parameter(
        30.0, unit="m/s", minimum=0.0, description="speed below which braking away from the site ends"
    )
    ignition_time = State(
        NEVER, frozen=True, unit="s", description="ignition time of the deorbit burn; -1: not ignited"
    )
    planned_burn = State(0.0, frozen=True, unit="s", description="duration of the deorbit burn planned at ignition")
    holding = State(False, description="true: command of the deorbit burn held until its end")
    falling_since = State(
        NEVER, unit="s", description="time at which impact was first predicted in the coast; -1: not predicted"
    )
    unsolved_since = State(
        NEVER, unit="s", description="time at which the braking guidance lost its solution; -1: solution exists"
    )
    flown_divert = State(0, description="number of diverts of the braking guidance included in the landing site")
    elsewhere = State(False, description="true: braking to be completed away from the site")

    def face_back(self, time: float) -> None:
        """Command a direction opposite to the horizontal velocity, without thrust."""
        turning = against_horizontal(self.sampled_position, self.sampled_velocity, self.moon_radius)
        self.command.thrust_direction = turning.direction
        self.command.thrust_direction_rate = turning.rate
        self.command.thrust_acceleration = 0.0
        self.command.command_time = time
        self.command.burn_duration = 0.0

    def begin_deorbit(self) -> None:
        """Make the sequencer the source of the command; the first step sets its direction."""
        self.take_over(CommandSource.OWN, False)

    def deorbit(self, t: float, ahead: float) -> int:
        """Wait for the ignition point, ignite and burn; return the end condition of the phase."""
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
            self.record_status(LandingStatus.TIMEOUT, ahead)
            return PhaseEnd.OVER
        return PhaseEnd.GOES_ON

    def is_time_to_burn(self, burn: float) -> bool:
        """Return True once the middle of a burn (s) would be half a revolution plus braking_range before the site."""
        turned = norm(self.sampled_velocity) / norm(from_centre(self.sampled_position, self.moon_radius))
        place = math.pi + self.braking_range / self.moon_radius + 0.5 * burn * turned
        return central_angle(self.sampled_position, self.moon_radius) <= place

    def coast(self, t: float, ahead: float) -> int:
        """Coast until the site is braking_range ahead; return the end condition of the phase."""
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
            self.record_status(LandingStatus.TIMEOUT, ahead)
            return PhaseEnd.OVER
        return PhaseEnd.GOES_ON

    def is_falling(self, angle: float) -> bool:
        """Return True if the coast is low and reaches the ground before its end, which is ``angle`` (rad) ahead.

        A low pericentre alone does not justify braking earlier, which would need too much propellant.
        """
        if altitude_of(self.sampled_position, self.moon_radius) >= self.lowest_coast:
            return False
        lowest = lowest_altitude(
            self.sampled_position, self.sampled_velocity, angle, self.moon_radius, self.gravitational_parameter
        )
        return lowest < self.coast_clearance

    def begin_braking(self) -> None:
        """Make the braking guidance the source of the command, without thrust until the thrust axis is aligned."""
        self.take_over(CommandSource.BRAKING, False)
        self.flown_divert = self.sampled_divert

    def divert_site(self) -> None:
        """Move the site to the point below the target to which braking is diverted."""
        if self.sampled_divert != self.flown_divert:
            self.flown_divert = self.sampled_divert
            self.site = site_below(self.sampled_divert_position, self.moon_radius)

    def ignite(self, answered: bool, ahead: float) -> None:
        """Ignite the engine when the thrust axis is aligned with the command, at the latest after pointing_patience."""
        minimum = cos(self.pointing_tolerance) * norm(self.sampled_attitude) * norm(self.sampled_direction)
        if answered and dot(self.sampled_attitude, self.sampled_direction) >= minimum:
            self.engine_on = True
        elif self.since_start(ahead) >= self.pointing_patience - ROUNDING:
            self.record_status(LandingStatus.TIMEOUT, ahead)
            self.engine_on = True

    def brake(self, t: float, ahead: float) -> int:
        """Ignite, then brake until an end condition holds; ignore guidance outputs from before the phase."""
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
            self.record_status(LandingStatus.BRAKING_FAILED, ahead)
            return PhaseEnd.ELSEWHERE if far else PhaseEnd.OVER
        # without a solution since its start, the guidance outputs a time to go of 0
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
