"""A block with bounds of all kinds, which a user might write."""

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.kernel.integrators import count_steps


class Bounded(Block):
    """Has parameters of all kinds with bounds, and integrates in steps of its own."""

    internal_step = Parameter(0.1, unit="s", minimum=1e-4, description="longest integration step")
    share = Parameter(0.5, unit="1", minimum=0.0, maximum=1.0, description="a share")
    axes = Parameter([1.0, 1.0, 1.0], unit="1", minimum=-1.0, maximum=1.0, description="a vector")
    table = Parameter([0.0] * 4, columns=2, unit="1", maximum=9.0, description="a matrix")
    free = Parameter(0.0, unit="1", description="without bounds")
    count = Parameter(2, minimum=0, maximum=5, description="an Integer")
    u = Input(0.0, unit="1", minimum=0.0, maximum=1.0, description="an input, whose bounds its source may leave")
    w = Input([0.0, 0.0], unit="1", description="another")
    y = Output(0.0, unit="1", description="steps taken")
    starts = State(0, description="initialisations")

    def initialize(self) -> None:
        self.starts = self.starts + 1

    def step(self, t: float, h: float) -> None:
        self.y = self.y + float(count_steps(h, self.internal_step))
