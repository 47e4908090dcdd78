"""Wind, and deviation of air density from the standard atmosphere."""

import math

from ..block import Block, Output, Parameter
from ..interfaces.ports import entry, sampling
from ..kernel.functions import cos


class AirDisturbance(Block):
    """Wind gust of shape (1 - cos)/2 and a single change of air density.

        v = wind + gust (1 - cos(2 π (t - t_g)/T_g))/2    if t_g <= t <= t_g + T_g

    with gust_time t_g and gust_duration T_g. The density factor changes from density to later_density at density_time.

    See docs/systems/entry_attitude.md.
    """

    default_step = 0.2

    wind = entry.WIND.parameter(description="steady velocity of the air relative to the rotating Earth")
    gust = Parameter(
        [0.0, 0.0, 0.0], unit="m/s", frame="velocity", description="peak velocity of the gust, added to the steady wind"
    )
    gust_time = Parameter(0.0, unit="s", description="time from the start of the simulation to the start of the gust")
    gust_duration = Parameter(10.0, unit="s", minimum=1e-3, description="duration of the gust")
    density = Parameter(
        1.0, unit="1", minimum=0.0, description="ratio of actual to standard density before density_time"
    )
    density_time = Parameter(
        1e9, unit="s", description="time from the start of the simulation to the change of density"
    )
    later_density = Parameter(
        1.0, unit="1", minimum=0.0, description="ratio of actual to standard density after density_time"
    )
    air_velocity = Output(
        [0.0, 0.0, 0.0],
        unit="m/s",
        frame="velocity",
        description="velocity of the air relative to the rotating Earth, wind and gust",
    )
    density_factor = entry.DENSITY_FACTOR.output()
    start_time = sampling.START_TIME.state()

    def initialize(self) -> None:
        self.set_outputs(0.0)

    def set_outputs(self, time: float) -> None:
        """Set the outputs for ``time`` (s) after the start."""
        since = time - self.gust_time
        fraction = 0.0
        if since > 0.0 and since < self.gust_duration:
            fraction = 0.5 * (1.0 - cos(2.0 * math.pi * since / self.gust_duration))
        self.air_velocity = self.wind + fraction * self.gust
        self.density_factor = self.density
        if time >= self.density_time:
            self.density_factor = self.later_density

    def step(self, t: float, h: float) -> None:
        self.set_outputs(t + h - self.start_time)
