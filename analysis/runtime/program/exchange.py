"""Variables that a simulation exchanges and records, by name."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from ...options.fault import Fault
from ..fmi.representations import TEXTS
from ..fmi.variable import ScalarVariable
from ..ssp.kinds import PARAMETERS
from ..system.prepared import PreparedSystem
from ..system.schedule import origin


@dataclass(frozen=True)
class Roles:
    """Uses of the variables of a component; all elements of an array of FMI 3.0 have the same use.

    ``inputs`` are inputs, and parameters that change during simulation. ``outputs`` are outputs, and other variables
    connected as sources. ``recorded`` are further variables to read. ``uses_events`` is True if event mode of FMI 3.0
    is used, because the FMU supports it and has a discrete input.
    """

    inputs: Sequence[ScalarVariable]
    outputs: Sequence[ScalarVariable]
    recorded: Sequence[ScalarVariable]
    uses_events: bool


class Exchange:
    """Exchanged variables: ``roles`` by component, system ``connectors`` with values, and ``recorded`` signals.

    The ``selected`` signals are recorded, or all exchanged signals if it is None. Outputs that are not needed are not
    read.
    """

    def __init__(
        self, system: PreparedSystem, faults: Sequence[Fault] = (), selected: Collection[str] | None = None
    ) -> None:
        self._network = network = system.network
        self._selected = set(selected or ())
        links = list(network.links())
        signals = [link.source for link in links if not link.is_parameter]
        self._fetched = None if selected is None else self._selected | {link.source.name for link in links}
        if self._fetched is not None:
            self._fetched |= {fault.name for fault in faults}
        self._changing = {*network.driver, *network.driven}
        self._tuned = {*network.driven, *(fault.name for fault in faults)}
        self._unusual = {node.name for node in signals if node.component is not None and node.kind != "output"}
        self._texts = {
            origin(network, link).name
            for link in links
            if link.target.type_name in TEXTS and link.target.component is not None and not link.is_parameter
        }
        read = {node.name for node in signals}
        self.connectors = [
            node.name
            for node in network.nodes.values()
            if node.component is None and node.type_name not in TEXTS
            if node.name in self._changing or node.name in system.settings.nodes
            if node.kind not in PARAMETERS or node.name in read
        ]
        self.roles = {component: self._find_roles(component) for component in network.fmus}
        exchanged = [
            f"{component}.{each.name}"
            for component, roles in self.roles.items()
            for each in (*roles.inputs, *roles.outputs)
            if each.type not in TEXTS and (each in roles.outputs or self._is_changing(component, each))
        ]
        self.recorded = [*exchanged, *self.connectors] if selected is None else list(selected)

    def _find_roles(self, component: str) -> Roles:
        fmu = self._network.fmus[component]
        inputs: list[ScalarVariable] = []
        outputs: list[ScalarVariable] = []
        recorded: list[ScalarVariable] = []
        for array in arrays_of(fmu.variables.values()):
            first, names = array[0], {f"{component}.{each.name}" for each in array}
            is_output = first.causality == "output" or bool(names & self._unusual)
            is_input = first.causality == "input" and bool(names & self._changing)
            if (is_input and not is_output) or (first.is_tunable and names & self._tuned):
                inputs += array
            elif is_output and self._is_fetched(first, names):
                outputs += array
            elif names & self._selected:
                recorded += array
        discrete = any(each.causality == "input" and each.variability == "discrete" for each in inputs)
        has_events = fmu.version == 3 and bool(fmu.description.coSimulation.hasEventMode)
        return Roles(inputs, outputs, recorded, has_events and discrete)

    def _is_changing(self, component: str, variable: ScalarVariable) -> bool:
        """Return True if a variable itself is driven, not only other elements of its array."""
        return f"{component}.{variable.name}" in (self._tuned if variable.is_tunable else self._changing)

    def _is_fetched(self, variable: ScalarVariable, names: Collection[str]) -> bool:
        selected = self._texts if variable.type in TEXTS else self._fetched
        return selected is None or not selected.isdisjoint(names)


def arrays_of(variables: Iterable[ScalarVariable]) -> list[list[ScalarVariable]]:
    """Return the variables grouped by array; scalars, such as all variables of FMI 2.0, form groups of one."""
    arrays: dict[str, list[ScalarVariable]] = {}
    for each in variables:
        arrays.setdefault(each.array or each.name, []).append(each)
    return list(arrays.values())
