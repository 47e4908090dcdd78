"""Blocks in a user's file with exactly known behaviour: the FMUs of exact_systems.py."""

from __future__ import annotations

from pathlib import Path

import fmpy

from perilune.common.paths import FLAVOURS
from perilune.fmus_src.export.own_blocks import build_own_blocks

BLOCKS = '''
import math

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.kernel.functions import cos, cosh, exp, sin, sinh
from perilune.fmus_src.mathlib.vectors import vector

LONGEST = 32


class HeldMass(Block):
    """x'' = u with u held over a step."""

    start = Parameter(1.0, unit="m", description="position at the start")
    speed = Parameter(0.0, unit="m/s", description="velocity at the start")
    u = Input(0.0, unit="m/s2", description="acceleration")
    position = Output(0.0, unit="m", description="position")
    velocity = Output(0.0, unit="m/s", description="velocity")

    def initialize(self) -> None:
        self.position = self.start
        self.velocity = self.speed

    def step(self, t: float, h: float) -> None:
        self.position = self.position + h * (self.velocity + 0.5 * h * self.u)
        self.velocity = self.velocity + h * self.u


class HeldPendulum(Block):
    """x'' = rate^2 x + u, an upright pendulum, with u held over a step."""

    rate = Parameter(0.5, unit="rad/s", description="of falling")
    start = Parameter(0.1, unit="rad", description="angle at the start")
    u = Input(0.0, unit="rad/s2", description="angular acceleration")
    position = Output(0.0, unit="rad", description="angle")
    velocity = Output(0.0, unit="rad/s", description="rate of the angle")

    def initialize(self) -> None:
        self.position = self.start

    def step(self, t: float, h: float) -> None:
        c = cosh(self.rate * h)
        s = sinh(self.rate * h)
        rest = -self.u / (self.rate * self.rate)  # where it would stand still
        away = self.position - rest
        x = rest + c * away + s * self.velocity / self.rate
        self.velocity = self.rate * s * away + c * self.velocity
        self.position = x


class HeldResonance(Block):
    """x'' + 2 damping rate x' + rate^2 x = rate^2 u with u held over a step."""

    rate = Parameter(1.0, unit="rad/s", description="undamped natural frequency")
    damping = Parameter(0.1, unit="1", description="damping ratio, below 1")
    start = Parameter(1.0, unit="m", description="x at the start")
    u = Input(0.0, unit="m", description="input")
    position = Output(0.0, unit="m", description="x")
    velocity = Output(0.0, unit="m/s", description="x'")

    def initialize(self) -> None:
        self.position = self.start

    def step(self, t: float, h: float) -> None:
        sigma = self.damping * self.rate
        w = self.rate * math.sqrt(1.0 - self.damping * self.damping)
        e = exp(-sigma * h)
        c = cos(w * h)
        s = sin(w * h)
        away = self.position - self.u
        sine = (self.velocity + sigma * away) / w
        x = self.u + e * (away * c + sine * s)
        self.velocity = e * ((sine * w - sigma * away) * c - (away * w + sigma * sine) * s)
        self.position = x


class HeldPair(Block):
    """x1'' = u1 + coupling u2, x2'' = u2 - coupling u1 with both held over a step."""

    coupling = Parameter(0.4, unit="1", description="of each input into the other axis")
    start = Parameter([1.0, -0.5], unit="m", description="positions at the start")
    u = Input([0.0, 0.0], unit="m/s2", description="accelerations")
    position = Output([0.0, 0.0], unit="m", description="positions")
    velocity = Output([0.0, 0.0], unit="m/s", description="velocities")

    def initialize(self) -> None:
        self.position = self.start

    def step(self, t: float, h: float) -> None:
        a = vector(self.u.x + self.coupling * self.u.y, self.u.y - self.coupling * self.u.x)
        self.position = self.position + h * (self.velocity + 0.5 * h * a)
        self.velocity = self.velocity + h * a


class Late(Block):
    """y is u of some steps ago."""

    samples = Parameter(1, minimum=1, maximum=LONGEST, description="steps")
    u = Input(0.0, description="input")
    y = Output(0.0, description="output")
    line = State([0.0] * LONGEST, description="inputs to come out, the next one first")

    def step(self, t: float, h: float) -> None:
        self.line[self.samples - 1] = self.u
        self.y = self.line[0]
        for i in range(LONGEST - 1):
            self.line[i] = self.line[i + 1]


class Difference(Block):
    """y = -(proportional u + derivative (u - u of the last sample)/period)."""

    sample_period = Parameter(0.0, unit="s", minimum=0.0, description="of control; 0: every step")
    proportional = Parameter(0.2, description="gain")
    derivative = Parameter(0.6, unit="s", description="gain of the rate")
    u = Input(0.0, description="input")
    y = Output(0.0, direct=True, description="command")
    last = State(0.0, description="u of the last sample")

    def initialize(self) -> None:
        self.y = -self.proportional * self.u
        self.last = self.u

    def step(self, t: float, h: float) -> None:
        period = h
        if self.sample_period > 0.0:
            period = self.sample_period
        self.y = -(self.proportional * self.u + self.derivative * (self.u - self.last) / period)
        self.last = self.u


class DifferencePair(Block):
    """Difference twice, as vectors."""

    sample_period = Parameter(0.0, unit="s", minimum=0.0, description="of control; 0: every step")
    proportional = Parameter([0.2, 0.3], description="gains")
    derivative = Parameter([0.6, 0.9], unit="s", description="gains of the rates")
    u = Input([0.0, 0.0], unit="m", description="inputs")
    y = Output([0.0, 0.0], direct=True, unit="m/s2", description="commands")
    last = State([0.0, 0.0], description="u of the last sample")

    def initialize(self) -> None:
        self.y = -self.proportional * self.u
        self.last = self.u

    def step(self, t: float, h: float) -> None:
        period = h
        if self.sample_period > 0.0:
            period = self.sample_period
        self.y = -(self.proportional * self.u + self.derivative * (self.u - self.last) / period)
        self.last = self.u


class LowPass(Block):
    """y = -gain g with g = keep g + (1 - keep) u at every sample."""

    sample_period = Parameter(0.0, unit="s", minimum=0.0, description="of control; 0: every step")
    keep = Parameter(0.8, unit="1", description="share of g that stays")
    gain = Parameter(0.5, unit="1", description="at rest")
    u = Input(0.0, unit="m", description="input")
    y = Output(0.0, direct=True, unit="m", description="command")
    g = State(0.0, unit="m", description="filtered input")

    def initialize(self) -> None:
        self.g = self.u
        self.y = -self.gain * self.g

    def step(self, t: float, h: float) -> None:
        self.g = self.keep * self.g + (1.0 - self.keep) * self.u
        self.y = -self.gain * self.g


class TustinLead(Block):
    """y = -gain (lead s + 1)/(lag s + 1) u by Tustin's rule at every step."""

    gain = Parameter(0.01, description="at rest")
    lead = Parameter(20.0, unit="s", description="time of the zero")
    lag = Parameter(2.0, unit="s", description="time of the pole")
    u = Input(0.0, unit="m", description="input")
    y = Output(0.0, direct=True, unit="m/s2", description="command")
    last_u = State(0.0, unit="m", description="u of the last step")

    def initialize(self) -> None:
        self.y = -self.gain * self.u
        self.last_u = self.u

    def step(self, t: float, h: float) -> None:
        change = (2.0 * self.lead + h) * self.u - (2.0 * self.lead - h) * self.last_u
        self.y = ((2.0 * self.lag - h) * self.y - self.gain * change) / (2.0 * self.lag + h)
        self.last_u = self.u


class UnitGain(Block):
    """y = u."""

    u = Input(0.0, unit="m/s2", description="input")
    y = Output(0.0, direct=True, unit="m/s2", description="output")

    def initialize(self) -> None:
        self.y = self.u

    def step(self, t: float, h: float) -> None:
        self.y = self.u


class ThreeLevelRelay(Block):
    """y = level with the sign of u, 0 within the dead zone."""

    level = Parameter(0.06, unit="m/s2", description="size of y")
    dead_zone = Parameter(0.02, unit="m/s2", description="largest u without an answer")
    u = Input(0.0, unit="m/s2", description="input")
    y = Output(0.0, direct=True, unit="m/s2", description="output")

    def initialize(self) -> None:
        self.answer()

    def answer(self) -> None:
        self.y = 0.0
        if self.u > self.dead_zone:
            self.y = self.level
        if self.u < -self.dead_zone:
            self.y = -self.level

    def step(self, t: float, h: float) -> None:
        self.answer()


class NoisyCounter(Block):
    """y = u and uniform noise from a Lehmer generator; counts its steps."""

    seed = Parameter(1234.0, description="first state of the generator")
    sigma = Parameter(0.0, unit="m", description="size of the noise")
    u = Input(0.0, unit="m", description="input")
    y = Output(0.0, unit="m", direct=True, description="output")
    count = Output(0, description="steps taken")
    even = Output(True, description="count is even")
    generator = State(1.0, frozen=True, description="last random number")
    mean = State([0.0, 0.0], unit="m", description="of the outputs, slow and slower")

    def initialize(self) -> None:
        self.generator = self.seed
        self.y = self.u

    def step(self, t: float, h: float) -> None:
        self.generator = math.fmod(16807.0 * self.generator, 2147483647.0)
        self.y = self.u + self.sigma * (self.generator / 1073741823.5 - 1.0)
        self.count = self.count + 1
        self.even = self.count % 2 == 0
        slow, slower = self.mean
        self.mean = vector(slow + 0.1 * (self.y - slow), slower + 0.1 * (slow - slower))
'''


def build_exact_fmus(folder: Path) -> None:
    """Build the blocks above into ``folder``/native and ``folder``/python."""
    folder.mkdir(parents=True, exist_ok=True)
    blocks = folder / "exact_blocks.py"
    blocks.write_text(BLOCKS)
    build_own_blocks(blocks, folder, FLAVOURS, [fmpy.platform])
