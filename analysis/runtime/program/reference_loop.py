"""Step-by-step simulation, written for readability: every executor must produce its rows and status bit for bit.

The components ``ahead`` step together, with inputs from the start of the step. The components ``behind`` then step in
turn, with inputs from the end of the step.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from ..system.prepared import PreparedSystem
from .component import REFUSALS, ComponentInstance, NonFiniteError, TerminationError
from .signals import Signals


class ReferenceLoop:
    """Simulation of ``components`` by name; ``signals`` transfers their values and collects the rows."""

    ahead: Sequence[str]
    behind: Sequence[str] = ()
    refusal: Exception | None = None  # the error that ended the simulation

    def __init__(self, system: PreparedSystem, components: Mapping[str, ComponentInstance], signals: Signals) -> None:
        self.system, self.components, self.signals = system, components, signals

    def fly(self) -> str:
        """Simulate from the start to the stop time, or to an earlier end; return the status."""
        try:
            self.initialise()
            for point in range(self.system.steps + 1):
                self.signals.move_to(point)
                if point > 0:
                    self.advance(point)
                for name in self.due(self.ahead, point):
                    self.set(name)  # for the component's next step
                self.signals.record()
                if self.signals.is_finished:
                    return "finished"
            return "stop_time"
        except TerminationError as end:
            self.signals.time = end.time
            self.get(end.component)
            self.signals.record(carries=True)
            return "terminated"
        except REFUSALS as error:
            self.refusal = error
            return "nonfinite" if isinstance(error, NonFiniteError) else "failed"

    def initialise(self) -> None:
        """Initialise each component after the components that it reads; inputs from later ones have start values."""
        for component in self.components.values():
            component.initialise(self.system.start, self.system.start + self.system.steps * self.system.step)
        order = self.system.schedule.initial_order
        for position, name in enumerate(order):
            self.set(name, known=order[:position])
            self.get(name, settled=False)
        for component in self.components.values():
            component.settle()
        for name in self.components:
            self.get(name)  # again, because some FMUs compute outputs only when they leave initialisation mode

    def advance(self, point: int) -> None:
        """Step to communication point number ``point``."""
        for name in self.due(self.ahead, point):
            self.step(name, point)
        for name in self.due(self.ahead, point):
            self.get(name)
        for name in self.due(self.behind, point):
            self.set(name)
            self.step(name, point)
            self.get(name)

    def due(self, names: Sequence[str], point: int) -> list[str]:
        """Return the components with a step, of one or more communication steps, that ends at ``point``."""
        return [name for name in names if point % self.system.periods.get(name, 1) == 0]

    def step(self, name: str, point: int) -> None:
        start, period, step = self.system.start, self.system.periods.get(name, 1), self.system.step
        self.components[name].step(start + (point - period) * step, period * step, start + point * step)

    def set(self, name: str, known: Collection[str] | None = None) -> None:
        self.components[name].set(self.signals.inputs(name, known))

    def get(self, name: str, *, settled: bool = True) -> None:
        self.signals.take(name, self.components[name].get(self.signals.outputs(name, settled=settled)))


class Sequential(ReferenceLoop):
    """Sequential algorithm: FMUs without direct feedthrough step ahead; other FMUs follow the FMUs that they read."""

    def __init__(self, system: PreparedSystem, components: Mapping[str, ComponentInstance], signals: Signals) -> None:
        super().__init__(system, components, signals)
        self.ahead, self.behind = system.schedule.sources_first, system.schedule.followers


class Jacobi(ReferenceLoop):
    """Jacobi's algorithm: all FMUs step ahead, with the outputs of other FMUs at the start of the step."""

    def __init__(self, system: PreparedSystem, components: Mapping[str, ComponentInstance], signals: Signals) -> None:
        super().__init__(system, components, signals)
        self.ahead = list(components)
