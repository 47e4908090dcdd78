"""Divert of the landing site at a predefined time."""

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import landing, sampling
from ..mathlib.lunar.gravity import altitude_of
from ..mathlib.lunar.landing_site import above_site, redesignate, site_below
from ..mathlib.vectors import vector


class SiteDivert(Block):
    """Target of a terminal guidance that moves by an offset at divert_time, where divert_count changes from 0 to 1.

    The offset is added to x and y of the site below target_position; the new target has the altitude of the first.

    Frame: landing site.

    Assumes a spherical Moon.

    See docs/systems/descent_laws.md.
    """

    divert_time = Parameter(
        0.0, unit="s", minimum=0.0, description="time from the start of the simulation to the divert; 0: no divert"
    )
    offset = Parameter(
        [0.0, 0.0], unit="m", frame="landing site", description="offset of the landing site along x and y"
    )
    target_position = landing.POSITION.parameter(
        [0.0, 0.0, 100.0], "target position before the divert, relative to the landing site"
    )
    moon_radius = landing.MOON_RADIUS.parameter()
    divert_count = Output(0, description="number of diverts since the start")
    divert_position = landing.POSITION.output("current target position, relative to the landing site")
    start_time = sampling.START_TIME.state()
    diverted = State(False, description="true: landing site has been moved")

    def initialize(self) -> None:
        self.divert_position = self.target_position
        self.move_site(self.start_time)

    def move_site(self, time: float) -> None:
        """Move the site once ``time`` (s) reaches divert_time."""
        if self.divert_time > 0.0 and not self.diverted and time >= self.divert_time - sampling.TIME_ROUNDING:
            self.diverted = True
            self.divert_count = 1
            altitude = altitude_of(self.target_position, self.moon_radius)
            below = site_below(self.target_position, self.moon_radius)
            site = redesignate(below, vector(self.offset.x, self.offset.y), self.moon_radius)
            self.divert_position = above_site(site, altitude, self.moon_radius)

    def step(self, t: float, h: float) -> None:
        self.move_site(t + h)
