"""Blocks as a user writes them: with every integrator, with bundles of connectors, with bounds of all kinds."""

from __future__ import annotations

from perilune import (
    Block,
    Bundle,
    Forcing,
    Input,
    Inputs,
    Output,
    Outputs,
    Parameter,
    Port,
    State,
    Translation,
    Vector3,
    cos,
    count_steps,
    exp,
    norm,
    runge_kutta_4,
    runge_kutta_nystrom,
    simpson,
    sin,
    vector,
)


class Integrators(Block):
    """Two bodies about a centre of attraction, and a third under an acceleration over time."""

    thrust = Input([0.0, 0.0, 0.0], unit="m/s2", frame="inertial", description="of the first two bodies")
    first = State(Translation, description="by Kutta's method")
    second = State(Translation, description="by Nystrom's method")
    third = State(Translation, description="by Simpson's rule")

    def initialize(self) -> None:
        circle = Translation(position=vector(1.0, 0.0, 0.0), velocity=vector(0.0, 1.0, 0.0))
        self.first = circle
        self.second = circle
        self.third = circle

    def gravity(self, position: Vector3) -> Vector3:
        """Return attraction (m/s2) of the centre, 1 at 1 m."""
        distance = norm(position)
        return -position / (distance * distance * distance)

    def derivatives(self, t: float, s: Translation, thrust: Vector3) -> Translation:
        """Return rates."""
        return Translation(position=s.velocity, velocity=self.gravity(s.position) + cos(t) * thrust)

    def acceleration(self, t: float) -> Vector3:
        """Return the acceleration by the third body (m/s2)."""
        return vector(-cos(t), -sin(t), exp(-t))

    def step(self, t: float, h: float) -> None:
        self.first = runge_kutta_4(self.derivatives, t, self.first, h, self.thrust)
        forcing = Forcing(
            start=cos(t) * self.thrust, middle=cos(t + 0.5 * h) * self.thrust, end=cos(t + h) * self.thrust
        )
        self.second = runge_kutta_nystrom(self.gravity, self.second, forcing, h)
        self.third = simpson(self.acceleration, t, self.third, h)


class EngineCommand(Bundle):
    """Command of an engine."""

    thrust = Port(0.0, unit="N", description="thrust")
    direction = Port([0.0, 0.0, 1.0], unit="1", frame="body", description="of thrust")
    number = Port(0, description="of the command")
    engine_on = Port(True, description="thrust is given")


class Bundles(Block):
    """Members read and assigned in every place that a variable can have; divides by an input that may be 0."""

    choice = Input(0, minimum=0, maximum=9, description="which to pass on")
    factor = Input(2.0, unit="1", description="divisor of thrust")
    first = Inputs(EngineCommand)
    second = Inputs(EngineCommand, prefix="second_", about="of the second source:", thrust=2.5)
    command = Outputs(EngineCommand, prefix="commanded_", direct=True)
    last = Outputs(EngineCommand, prefix="last_", engine_on=False)

    def initialize(self) -> None:
        self.command = self.first

    def weaken(self, thrust: float) -> tuple[float, float]:
        """Return a thrust over the factor (N), and the length of the second direction."""
        return thrust / self.factor, norm(self.second.direction)

    def step(self, t: float, h: float) -> None:
        self.last = self.command
        if self.choice < 2:
            self.command = self.second
        elif self.choice < 4:
            self.command = self.first
            self.command.thrust, length = self.weaken(self.first.thrust)
            self.command.direction = self.first.direction + length * self.second.direction
        elif self.choice < 6:
            self.command.number = self.second.number // 2 + self.first.number % 7
            self.command.thrust += self.second.direction[self.second.number % 3]
        elif self.choice < 8:
            self.command.direction = vector(self.first.direction.y, self.second.thrust, self.factor)
            self.command.engine_on = self.first.engine_on and not self.second.engine_on
        else:
            self.commanded_thrust = self.thrust + self.second_thrust  # the variables by their own names
            self.last.thrust = self.command.thrust


class Bounded(Block):
    """Block with parameters of all kinds with bounds and an internal integration step."""

    internal_step = Parameter(0.1, unit="s", minimum=1e-4, description="longest integration step")
    fraction = Parameter(0.5, unit="1", minimum=0.0, maximum=1.0, description="a fraction")
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


class Gains(Block):
    """Adds up its input times gains, which are tunable; the offset is read at the start only."""

    x = Input(1.0, description="what to add")
    gain = Parameter(1.0, minimum=0.0, maximum=10.0, description="factor")
    axes = Parameter([1.0, 2.0], minimum=-5.0, description="two more factors")
    count = Parameter(1, minimum=0, maximum=5, description="times")
    on = Parameter(True, description="whether to add")
    offset = Parameter(3.0, description="of the total at the start")
    total = Output(0.0, direct=True, description="the sum")
    steps = State(0, description="taken")

    def initialize(self) -> None:
        self.total = self.offset

    def step(self, t: float, h: float) -> None:
        if self.on:
            self.total = self.total + float(self.count) * (self.gain * self.axes.x * self.x + self.axes.y)
        self.steps = self.steps + 1
