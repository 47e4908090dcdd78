"""Phases 4 to 9 of a landing: from the first hover to the ground."""

from ..block import Parameter, State
from ..interfaces.ports.landing import CommandSource, HoverMode
from ..mathlib.lunar.gravity import altitude_of, from_centre, vertical_at
from ..mathlib.lunar.landing_site import above_site, redesignate, site_below, within_reach
from ..mathlib.vectors import Vector2, across, clip, norm
from .landing_sequence import NEVER, ROUNDING, LandingSequence, LandingStatus


class HoverPhases(LandingSequence, interface=True):
    """Hovers, transfer, approach, descent and contact with their end conditions.

    Hover targets lie on the local vertical of `site`. The site is initially the origin or the point where braking
    ended; each re-designation moves it, projected on the Moon's sphere.
    """

    hover_time = Parameter(
        20.0,
        unit="s",
        minimum=0.0,
        description="duration of hover 1 and of hover 2, in which the landing site is re-designated",
    )
    hover_patience = Parameter(60.0, unit="s", minimum=0.0, description="longest duration of hover 1 and of hover 2")
    settled_speed = Parameter(0.5, unit="m/s", minimum=0.0, description="largest speed at which a hover can end")
    settled_distance = Parameter(
        10.0, unit="m", minimum=0.0, description="largest distance from the target at which a hover can end"
    )
    reach_over_drop = Parameter(
        1.3,
        unit="1",
        minimum=0.0,
        description="largest distance of the first re-designation, as a fraction of the altitude lost in the transfer",
    )
    second_reach = Parameter(100.0, unit="m", minimum=0.0, description="largest distance of the second re-designation")
    reserve = Parameter(25.0, unit="kg", minimum=0.0, description="propellant that must remain after the transfer")
    lookahead = Parameter(
        8.0,
        unit="s",
        minimum=0.0,
        description="time over which the velocity is extrapolated to the hover position after an early end of braking",
    )
    lowest_hover = Parameter(
        300.0, unit="m", minimum=0.0, description="least target altitude of the hover after an early end of braking"
    )
    descent_wait = Parameter(3.0, unit="s", minimum=0.0, description="duration of the hover before the descent")
    cut_altitude = Parameter(
        0.5,
        unit="m",
        minimum=0.0,
        description="estimated altitude at which the engine is cut off without probe contact",
    )
    plan_end = State(NEVER, frozen=True, unit="s", description="end time of the plan to hover 1; -1: no end known yet")
    plan_judged = State(False, description="true: predicted propellant of the transfer checked against the reserve")
    first_site = State(
        [0.0, 0.0, 0.0],
        frozen=True,
        unit="m",
        frame="landing site",
        description="position of the landing site before the transfer",
    )

    def begin_first_hover(self) -> None:
        """Request a capture to the hover over the site; a simulation that starts here holds until inputs are
        sampled.
        """
        self.target_position = above_site(self.site, self.preliminary_altitude, self.moon_radius)
        if self.since_start(self.sampled_time) < 0.0:
            self.request_plan(HoverMode.CAPTURE)
        else:
            self.request_plan(HoverMode.HOLD)

    def move_site_ahead(self, time: float) -> None:
        """Move the site below the position extrapolated by the velocity over lookahead."""
        place = self.sampled_position + self.lookahead * self.sampled_velocity
        self.site = site_below(place, self.moon_radius)
        altitude = clip(altitude_of(place, self.moon_radius), self.lowest_hover, self.preliminary_altitude)
        self.target_position = above_site(self.site, altitude, self.moon_radius)
        self.record_status(LandingStatus.SITE_MOVED, time)

    def is_settled(self) -> bool:
        """Return True if the vehicle hovers at its target."""
        close = norm(self.sampled_position - self.target_position) <= self.settled_distance
        return close and norm(self.sampled_velocity) <= self.settled_speed

    def choose(self, ahead: float, chosen_since: float) -> bool:
        """Hover while the site is re-designated, from ``chosen_since`` (s) on; return True when this is over."""
        waited = ahead - chosen_since + ROUNDING
        if waited >= self.hover_time and self.is_settled():
            return True
        if waited >= self.hover_patience:
            self.record_status(LandingStatus.TIMEOUT, ahead)
            return True
        return False

    def first_hover(self, t: float, ahead: float) -> bool:
        """Complete the capture, then hover for the re-designation; return True when the re-designation is over."""
        if self.hover_mode == HoverMode.HOLD and self.since_start(t) < ROUNDING and not self.is_settled():
            self.request_plan(HoverMode.CAPTURE)
        if self.plan_end < 0.0 and self.plan_is_over():
            self.plan_end = t
        if self.plan_end < 0.0:
            return False
        return self.choose(ahead, self.plan_end)

    def move_site(self, move: Vector2, reach: float, time: float) -> None:
        """Move the site by a re-designation of at most ``reach`` (m)."""
        reached, allowed = within_reach(move, reach)
        if not reached:
            self.record_status(LandingStatus.SHORTENED, time)
        self.site = redesignate(self.site, allowed, self.moon_radius)

    def begin_transfer(self, time: float) -> None:
        """Request the descent to the second hover, over the site of the first re-designation."""
        self.first_site = self.site
        reach = self.reach_over_drop * (self.preliminary_altitude - self.final_altitude)
        self.move_site(self.sampled_move_1, reach, time)
        self.target_position = above_site(self.site, self.final_altitude, self.moon_radius)
        self.request_plan(HoverMode.PROGRAMME)

    def transfer(self, ahead: float) -> bool:
        """Return True when the transfer is complete; drop a re-designation that needs too much propellant."""
        if self.is_answered() and not self.plan_judged:
            self.plan_judged = True
            if self.sampled_mass - self.sampled_propellant - self.reserve < self.dry_mass:
                self.record_status(LandingStatus.DROPPED, ahead)
                self.site = self.first_site
                self.target_position = above_site(self.site, self.final_altitude, self.moon_radius)
                self.request_plan(HoverMode.PROGRAMME)
                return False
        return self.plan_is_over()

    def begin_second_hover(self) -> None:
        """Request a hold at the end of the transfer."""
        self.target_position = above_site(self.site, self.final_altitude, self.moon_radius)
        self.request_plan(HoverMode.HOLD)

    def begin_approach(self, time: float) -> None:
        """Request the slow descent to the last hover, over the site of the second re-designation."""
        self.move_site(self.sampled_move_2, self.second_reach, time)
        self.target_position = above_site(self.site, self.cutoff_altitude, self.moon_radius)
        self.request_plan(HoverMode.SLOW)

    def begin_descent(self) -> None:
        """Request a hold over the site."""
        self.target_position = above_site(self.site, self.cutoff_altitude, self.moon_radius)
        self.request_plan(HoverMode.HOLD)

    def descend(self, ahead: float) -> bool:
        """Descend after descent_wait, until the probe touches the ground."""
        if self.sampled_probe_contact:
            return True
        if self.sampled_ground_contact or altitude_of(self.sampled_position, self.moon_radius) <= self.cut_altitude:
            self.record_status(LandingStatus.CUT_OFF, ahead)
            return True
        if self.hover_mode == HoverMode.HOLD and self.since_start(ahead) >= self.descent_wait - ROUNDING:
            self.request_plan(HoverMode.DESCEND)
        return False

    def begin_contact(self) -> None:
        """Start contact without thrust."""
        self.take_over(CommandSource.OWN, False)

    def face_up(self, time: float) -> None:
        """Command the local vertical, without thrust."""
        up = vertical_at(self.sampled_position, self.moon_radius)
        self.command.thrust_direction = up
        self.command.thrust_direction_rate = across(self.sampled_velocity, up) / norm(
            from_centre(self.sampled_position, self.moon_radius)
        )
        self.command.thrust_acceleration = 0.0
        self.command.command_time = time
        self.command.burn_duration = 0.0
