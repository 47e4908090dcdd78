"""Values that components exchange and that are recorded, by name."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from ..fmi.variable import ScalarVariable
from ..ssp.kinds import PARAMETERS
from ..system.network import Node, NodeLink
from ..system.prepared import PreparedSystem
from ..system.schedule import origin
from .component import Sample, Samples
from .connection import target_sample
from .exchange import Exchange
from .faults import Faults
from .numbers import check_output
from .start_values import start_of


class Signals:
    """``values`` of connectors and variables after faults, and recorded ``rows`` by signal at ``times`` (s).

    Faults are evaluated at ``time`` (s). Inputs over time have one value for the initialisation, then one for every
    communication point.
    """

    def __init__(self, system: PreparedSystem, exchange: Exchange, faults: Faults) -> None:
        self._system, self._network = system, system.network
        self._exchange, self._faults = exchange, faults
        self.time = system.start
        self._drive_row = 0
        self._starts = {  # values of inputs before their sources are known, and unchanged values of parameters
            f"{component}.{each.name}": start_of(system.settings, component, each)
            for component, roles in exchange.roles.items()
            for each in roles.inputs
        }
        self.values: Samples = dict(self._starts)
        self.times: list[float] = []
        self.rows: dict[str, list[float]] = {name: [] for name in exchange.recorded}

    @property
    def is_finished(self) -> bool:
        """True once the system's output ``finished`` is not 0."""
        node = self._network.nodes.get("finished")
        is_there = node is not None and node.kind == "output" and node.name in self._exchange.connectors
        return is_there and self.values["finished"] != 0.0

    def move_to(self, point: int) -> None:
        """Set the time for faults, and the row of inputs over time, to communication point number ``point``."""
        self.time = self._system.start + point * self._system.step
        self._drive_row = point + 1

    def inputs(self, component: str, known: Collection[str] | None = None) -> Samples:
        """Return the inputs of a component; if ``known`` is passed, inputs from other components have start values."""
        return {each.name: self._input(component, each, known) for each in self._exchange.roles[component].inputs}

    def outputs(self, component: str, *, settled: bool) -> list[str]:
        """Return the names of a component's outputs and, once it is ``settled``, of its other recorded variables."""
        roles = self._exchange.roles[component]
        return [each.name for each in (*roles.outputs, *(roles.recorded if settled else ()))]

    def take(self, component: str, values: Mapping[str, Sample]) -> None:
        """Store values read from a component. Raises NonFiniteError and FailedError for invalid outputs."""
        for each in self._exchange.roles[component].outputs:
            check_output(each, values[each.name])
        for variable, sample in values.items():
            name = f"{component}.{variable}"
            self.values[name] = self._faults.apply(name, sample, self.time)

    def record(self, *, carries: bool = False) -> None:
        """Add a row; with ``carries``, update the values of connected inputs to this time without setting them."""
        for component, roles in self._exchange.roles.items() if carries else ():
            for each in roles.inputs:
                if f"{component}.{each.name}" in self._network.driver:
                    self._input(component, each, None)
        for name in self._exchange.connectors:
            self.values[name] = self._source(self._network.nodes[name])
        self.times.append(self.time)
        for name, row in self.rows.items():
            row.append(float(self.values[name]))

    def _input(self, component: str, variable: ScalarVariable, known: Collection[str] | None) -> Sample:
        name = f"{component}.{variable.name}"
        link = self._network.driver.get(name)
        if name in self._network.driven:
            sample = self._sample(name)
        elif link is not None and not link.is_parameter and self._all_known((link, *link.added), known):
            sample = target_sample(self._network, link, self._source)
        else:
            sample = self._starts[name]
        self.values[name] = self._faults.apply(name, sample, self.time)
        return self.values[name]

    def _all_known(self, links: Iterable[NodeLink], known: Collection[str] | None) -> bool:
        """Return True if the values of all links originate in known components or outside the system."""
        if known is None:
            return True
        origins = [origin(self._network, link).component for link in links]
        return all(each is None or each in known for each in origins)

    def _source(self, node: Node) -> Sample:
        """Return the value of a connection's source: an output, or the value at the source of a system connector."""
        link = self._network.driver.get(node.name)
        if node.component is not None:
            return self.values[node.name]
        if link is not None and node.kind not in PARAMETERS:
            return target_sample(self._network, link, self._source)
        return self._sample(node.name) if node.name in self._network.driven else self._system.settings.nodes[node.name]

    def _sample(self, name: str) -> Sample:
        drive = self._system.drive
        assert drive is not None
        row = min(self._drive_row, len(drive.table) - 1)
        return float(drive.table[row, drive.names.index(name)])
