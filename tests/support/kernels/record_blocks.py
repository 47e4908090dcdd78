"""Blocks with every use of records and integrators, valid and invalid."""

from __future__ import annotations

from perilune.fmus_src.block import Block, Input, Output, State
from perilune.fmus_src.kernel.integrators import runge_kutta_4
from perilune.fmus_src.kernel.records import Field, Record, replace
from perilune.fmus_src.mathlib.vectors import Vector2, Vector3, norm, vector


class Motion(Record):
    """A point with a heading and a mass."""

    position = Field(Vector3, unit="m", frame="inertial", description="of the point")
    heading = Field(Vector2, unit="1", description="a direction in the plane")
    mass = Field(unit="kg", description="of the point")


class Pair(Record):
    """Two motions."""

    first = Field(Motion)
    second = Field(Motion)
    weight = Field(unit="1", description="of the second")


class Outcome(Record):
    """Record that is no vector space."""

    motion = Field(Motion)
    count = Field(int, description="how often")
    good = Field(bool, description="whether it is")


def mean_of(pair: Pair) -> Motion:
    """Return the weighted mean."""
    return (1.0 - pair.weight) * pair.first + pair.second * pair.weight


def assess(m: Motion, count: int) -> tuple[Outcome, float]:
    """Return several values with a record among them."""
    size = norm(m.position)
    if size > 3.0:
        return Outcome(motion=m, count=count % 1000 + 1, good=True), size
    return Outcome(motion=-m, count=count % 1000, good=False), -size


def fall(t: float, height: float, rate: float) -> float:
    """Return the rate of a float."""
    return -rate * height + t


class RecordLanguage(Block):
    """Records in every place that a value can have."""

    force = Input([0.5, -0.25, 1.5], unit="N", description="force")
    given = Input(0.75, unit="1", description="a number")
    state = State(Motion, mass=2.0)
    pair = State(Pair, weight=0.25, description="two of them")
    height = Output(1.0, unit="m", description="a float that is integrated")
    arrow = Output([1.0, 0.0], unit="1", description="a vector that is integrated")
    size = Output(0.0, unit="m", description="of the position")
    count = Output(0, description="how often")
    good = Output(False, description="whether it is")

    def initialize(self) -> None:
        start = Motion(position=vector(1.0, 2.0, 3.0), heading=vector(1.0, 0.0), mass=2.0)
        self.state = start
        self.pair = Pair(first=start, second=2.0 * start, weight=0.25)
        self.arrow = vector(1.0, 0.0)

    def derivatives(self, t: float, s: Motion, force: Vector3, rate: float) -> Motion:
        """Return rates."""
        turned = vector(-s.heading.y, s.heading.x)
        return Motion(position=0.1 * force - 0.01 * s.position, heading=rate * turned, mass=-0.001 * s.mass)

    def turning(self, t: float, arrow: Vector2) -> Vector2:
        """Return the rate of a vector, without inputs."""
        return vector(-arrow.y, arrow.x) * self.given / 10.0

    def step(self, t: float, h: float) -> None:
        self.state = runge_kutta_4(self.derivatives, t, self.state, h, self.force, self.given)
        self.height = runge_kutta_4(fall, t, self.height, h, 0.5)
        self.arrow = runge_kutta_4(self.turning, t, self.arrow, h)
        moved = replace(self.state, mass=self.state.mass + 1.0, heading=self.arrow)
        self.pair = replace(self.pair, second=moved, first=self.state)
        mean = mean_of(self.pair)
        chosen = mean if mean.mass > 2.0 else -moved
        outcome, self.size = assess(chosen - self.state / 4.0, self.count)
        self.count = outcome.count
        self.good = outcome.good
        self.pair = 0.5 * (self.pair + replace(self.pair, weight=outcome.motion.position.x / 1e3))


class RecordFaults(Block):
    """Divisions by zero in operators, in rates and in what makes a record."""

    divisor = Input(1.0, unit="1", description="may be 0")
    case = Input(0, minimum=0, maximum=5, description="which")
    state = State(Motion, mass=1.0)

    def initialize(self) -> None:
        self.state = Motion(position=vector(1.0, 2.0, 3.0), heading=vector(1.0, 0.0), mass=1.0)

    def derivatives(self, t: float, s: Motion, divisor: float) -> Motion:
        """Return rates that may fail."""
        return replace(s, mass=1.0 / divisor)

    def step(self, t: float, h: float) -> None:
        if self.case == 0:
            self.state = self.state / self.divisor
        elif self.case == 1:
            self.state = replace(self.state, mass=1.0 / self.divisor)
        elif self.case == 2:
            self.state = Motion(
                position=self.state.position / self.divisor,
                heading=self.state.heading,
                mass=3.0 / (self.divisor - 1.0),
            )
        elif self.case == 3:
            self.state = runge_kutta_4(self.derivatives, t, self.state, h, self.divisor)
        else:
            self.state = 0.5 * (self.state + self.state)
