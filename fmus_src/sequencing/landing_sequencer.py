"""Sequencer of a landing from orbit to contact: command source, targets and end conditions."""

import math

from ..block import Parameter, State
from ..interfaces.ports.landing import HoverStatus
from .hover_phases import HoverPhases
from .landing_sequence import ROUNDING, LandingPhase, LandingStatus
from .orbit_phases import OrbitPhases, PhaseEnd

LEAST_MARGIN = 0.9  # fraction of the dry weight that the least thrust must not reach


class LandingSequencer(OrbitPhases, HoverPhases):
    """Sequencer of nine landing phases: deorbit, coast, braking, hover, transfer, hover, approach, descent, contact.

    Any phase can be the first. A phase that exceeds its time ends with a status, and the next one follows. Ground
    contact before phase 8 ends the flight as a cut-off without probe. The block refuses to start, with status 9, phase
    0 and finished, if start_phase is undefined; if minimum_thrust is not below both maximum_thrust and 0.9 of the dry
    weight; if preliminary_altitude, final_altitude, cutoff_altitude and probe_length are not in descending order; or if
    a parameter is not finite. free_flight is true in phases 1 to 3 once the engine has been off for settling_time.
    Decisions are made once per cycle, from the inputs of the previous cycle.

    Source: Huang 2017 (phases and altitudes); rules and times: docs/systems/landing_mission.md.
    """

    settling_time = Parameter(2.0, unit="s", minimum=0.0, description="time from engine cut-off to free flight")
    last_thrust = State(0.0, frozen=True, unit="s", description="time at which the engine was last on")

    def initialize(self) -> None:
        self.sample_inputs(self.start_time)
        self.is_sampled = False  # sampled again in the first step, when all inputs are known
        self.last_thrust = self.start_time
        if self.is_refused():
            self.phase = LandingPhase.REFUSED
            self.record_status(LandingStatus.REFUSED, self.start_time)
            self.finished = True
        else:
            self.enter(self.start_phase, self.start_time)

    def is_refused(self) -> bool:
        """Return True if no landing is possible with the parameters."""
        times = self.hold_time + self.deorbit_patience + self.pointing_patience + self.handover_time_to_go
        times = times + self.braking_patience + self.solution_patience + self.hover_time + self.hover_patience
        times = times + self.lookahead + self.descent_wait + self.settling_time + self.coast_patience + self.cycle
        lengths = self.braking_range + self.pericentre_altitude + self.lowest_coast + self.far_range + self.moon_radius
        lengths = lengths + self.settled_distance + self.second_reach + self.lowest_hover + self.cut_altitude
        lengths = lengths + self.coast_clearance
        others = self.deorbit_throttle + self.pointing_tolerance + self.slow_speed + self.settled_speed
        others = others + self.reach_over_drop + self.reserve + self.dry_mass + self.gravitational_parameter
        moves = self.sampled_move_1.x + self.sampled_move_1.y + self.sampled_move_2.x + self.sampled_move_2.y
        if not math.isfinite(times + lengths + others + moves):
            return True
        if not math.isfinite(self.minimum_thrust + self.maximum_thrust + self.preliminary_altitude + self.probe_length):
            return True
        if self.start_phase < LandingPhase.DEORBIT or self.start_phase > LandingPhase.CONTACT:
            return True
        weight = self.dry_mass * self.gravitational_parameter / (self.moon_radius * self.moon_radius)
        if self.minimum_thrust >= self.maximum_thrust or self.minimum_thrust >= LEAST_MARGIN * weight:
            return True
        high = self.preliminary_altitude > self.final_altitude and self.final_altitude > self.cutoff_altitude
        return not (high and self.cutoff_altitude > self.probe_length)

    def enter(self, phase: int, time: float) -> None:
        """Start a phase that begins at ``time`` (s)."""
        self.open_phase(phase, time)
        if phase <= LandingPhase.COAST:
            self.begin_deorbit()
        elif phase == LandingPhase.BRAKING:
            self.begin_braking()
        elif phase == LandingPhase.HOVER_1:
            self.begin_first_hover()
        elif phase == LandingPhase.TRANSFER:
            self.begin_transfer(time)
        elif phase == LandingPhase.HOVER_2:
            self.begin_second_hover()
        elif phase == LandingPhase.APPROACH:
            self.begin_approach(time)
        elif phase == LandingPhase.DESCENT:
            self.begin_descent()
        else:
            self.begin_contact()

    def watch(self, ahead: float) -> None:
        """Record the conditions that can occur in any phase."""
        if self.is_answered() and self.sampled_hover_status != HoverStatus.GOOD:
            self.record_status(LandingStatus.HOVER_GUIDANCE_SAID, ahead)
        if self.sampled_mass <= self.dry_mass:
            self.record_status(LandingStatus.OUT_OF_PROPELLANT, ahead)

    def end_braking(self, how: int, ahead: float) -> None:
        """Start the first hover, over the site or over the point where braking ended."""
        self.enter(LandingPhase.HOVER_1, ahead)
        if how == PhaseEnd.ELSEWHERE:
            self.move_site_ahead(ahead)

    def run_phase(self, t: float, ahead: float) -> None:
        """Run one of the phases up to braking, and start the next one when it ends."""
        if self.phase == LandingPhase.DEORBIT:
            said = self.deorbit(t, ahead)
            if said != PhaseEnd.GOES_ON:
                self.enter(LandingPhase.COAST, ahead)
                self.face_back(t)
        elif self.phase == LandingPhase.COAST:
            said = self.coast(t, ahead)
            if said != PhaseEnd.GOES_ON:
                self.enter(LandingPhase.BRAKING, ahead)
        elif self.phase == LandingPhase.BRAKING:
            said = self.brake(t, ahead)
            if said != PhaseEnd.GOES_ON:
                self.end_braking(said, ahead)
        else:
            self.run_phase_from_hover(t, ahead)

    def run_phase_from_hover(self, t: float, ahead: float) -> None:
        """Run one of the phases from the first hover on, and start the next one when it ends."""
        over = False
        if self.phase == LandingPhase.HOVER_1:
            over = self.first_hover(t, ahead)
        elif self.phase == LandingPhase.TRANSFER:
            over = self.transfer(ahead)
        elif self.phase == LandingPhase.HOVER_2:
            over = self.choose(ahead, self.phase_time[LandingPhase.HOVER_2 - 1])
        elif self.phase == LandingPhase.APPROACH:
            over = self.plan_is_over()
        elif self.phase == LandingPhase.DESCENT:
            over = self.descend(ahead)
        if over:
            self.enter(self.phase + 1, ahead)

    def step(self, t: float, h: float) -> None:
        if not self.finished:
            if not self.is_sampled:
                self.sample_inputs(t)
            due = self.is_due(t + h)
            if due:
                length = h
                if self.cycle > 0.0:
                    length = self.cycle
                self.decide(self.sampled_time, t + h, length)
                self.is_sampled = False

    def decide(self, t: float, ahead: float, length: float) -> None:
        """Set the outputs for one period of ``length`` (s) from ``ahead`` (s) on, from the inputs at ``t`` (s)."""
        if not self.mass_is_known:
            self.mass_is_known = True
            self.phase_mass[self.phase - 1] = self.sampled_mass
        self.watch(ahead)
        if self.phase == LandingPhase.CONTACT:
            self.finished = self.sampled_ground_contact
        elif self.sampled_ground_contact and self.phase < LandingPhase.DESCENT:
            self.record_status(LandingStatus.CUT_OFF, ahead)
            self.enter(LandingPhase.CONTACT, ahead)
        else:
            self.run_phase(t, ahead)
        if self.phase == LandingPhase.CONTACT:
            self.face_up(t)
        if self.engine_on:
            self.last_thrust = ahead + length
        off = ahead - self.last_thrust + ROUNDING >= self.settling_time
        self.free_flight = self.phase <= LandingPhase.BRAKING and not self.engine_on and off
