"""Block with behaviour known by construction, and its variables by name."""

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.mathlib.rng import seed_streams, uniform


class Probe(Block):
    """Counts its initialisations and draws random numbers; outputs depend on what was set."""

    gain = Parameter(2.0, unit="1", description="factor")
    level = Input([1.0, 10.0], unit="1", description="two inputs")
    scaled = Output([0.0, 0.0], unit="1", direct=True, description="gain times level, added up over settlings")
    number = Output(0.0, unit="1", description="a random number")
    generator = State([0.0] * 6, description="random number generator")
    runs = State(0, description="initialisations since the last reset")
    on = State(False, description="set by initialisation")

    def initialize(self) -> None:
        seed_streams(self.generator, 1, 2)
        self.runs = self.runs + 1
        self.on = True
        self.scaled = self.scaled + self.gain * self.level
        self.number = self.number + uniform(self.generator)

    def step(self, t: float, h: float) -> None:
        self.scaled = self.gain * self.level
        self.number = uniform(self.generator)


def reference(component, name, element=0):
    """Return value reference of an element: variables in order of declaration, elements numbered through."""
    position = 0
    for variable_name, variable in type(component.block).variables.items():
        if variable_name == name:
            return position + element
        position += variable.size
    raise KeyError(name)


def references(component, *names):
    collected: list[int] = []
    for name in names:
        first = reference(component, name)
        collected += range(first, first + type(component.block).variables[name].size)
    return collected


def everything(component):
    count = sum(variable.size for variable in type(component.block).variables.values())
    return component.get(list(range(count)))
