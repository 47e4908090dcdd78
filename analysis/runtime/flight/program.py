"""From network, settings and schedule to the arrays that the compiled loop runs on."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..fmi.representations import TEXTS
from ..fmi.variable import Variable
from ..instances.instance import Instance
from ..instances.library import FUNCTION_NAMES
from ..ssp.conversions import IDENTITY
from ..ssp.kinds import PARAMETERS
from ..ssp.names import split_name
from ..system.checks import changeable
from ..system.fault import Fault
from ..system.fmu import Fmu
from ..system.inputs import Drive
from ..system.network import Link, Network
from ..system.passing.parameters import numbers
from ..system.passing.settings import Settings
from ..system.prepared import PreparedSystem
from ..system.schedule import origin
from .compiled import arrays, codes
from .instructions import InstructionList, Orders, Term, write_instructions
from .orders.fmi2 import Fmi2Orders
from .orders.fmi3 import Fmi3Orders
from .orders.placing import TransferPlacing
from .orders.slots import Slots
from .orders.transfers import ComponentTransfers, TransferTable
from .parameters import TYPE_KIND, Parameters
from .texts import Texts

KIND_NUMBERS = {"override": codes.OVERRIDE, "bias": codes.BIAS, "freeze": codes.FREEZE}
NEVER = (math.inf, math.inf)  # the window of a fault that does not fly


class Injection(NamedTuple):
    """One of the loop's faults: a connector, what is done to it, and in which window [from, until) s.

    ``value`` is in the connector's unit; of an excitation it is the column that is added.
    """

    connector: str
    kind: int
    value: float
    window: tuple[float, float]


def of_fault(fault: Fault, margin: float) -> Injection:
    """A fault; ``margin`` (s) is what the times of communication points may lack."""
    window = (fault.start - margin, fault.stop - margin)
    return Injection(fault.name, KIND_NUMBERS[fault.kind], float(fault.value), window)


def of_excitation(connector: str, column: int) -> Injection:
    """A connector to which `Simulation.advance` adds the given column of its excitation, in the connector's unit."""
    return Injection(connector, codes.EXCITE, float(column), (-math.inf, math.inf))


CAUSALITIES = ("input", "output")
GETTERS = (1, 3, 5)  # of EXCHANGES
EXCHANGES = FUNCTION_NAMES[:6]  # set and get of Real, Integer (and Enumeration), Boolean


@dataclass
class Layout:
    """Where everything lies: slots by name, the parameters, the Strings and Binaries that are exchanged.

    ``unfed`` are slots of array elements that nothing is connected to, whose array is given as a whole.
    """

    slots: dict[str, int]
    types: dict[str, str]
    units: dict[str, str | None]
    parameters: Parameters
    texts: Texts
    binaries: Texts
    unfed: frozenset[str] = frozenset()


def build_program(
    prepared: PreparedSystem,
    settings: Settings,
    instances: Mapping[str, Instance],
    wanted: Collection[str] | None,
    injections: Sequence[Injection],
    more: Collection[str] = (),
) -> tuple[arrays.Program, arrays.Fmi3 | None, InstructionList, Layout]:
    """Arrays for the loop, those of FMI 3.0 if there is any, and what writes instructions.

    ``wanted`` names what is recorded (None: all that is exchanged), ``more`` what else is. Only outputs that are
    connected or recorded are fetched, and of other variables those that are named.
    """
    builder = _Builder(prepared.network, settings, wanted, injections, more)
    program, instructions = builder.program(prepared, instances)
    return program, builder.fmi3(instances), instructions, builder.layout()


def layout_of(
    network: Network,
    settings: Settings,
    wanted: Collection[str] | None = None,
    injections: Sequence[Injection] = (),
    more: Collection[str] = (),
) -> Layout:
    """Where everything of a flight will lie, before one flies; arguments as of `build_program`."""
    return _Builder(network, settings, wanted, injections, more).layout()


class _Builder:
    def __init__(
        self,
        network: Network,
        settings: Settings,
        wanted: Collection[str] | None,
        injections: Sequence[Injection],
        more: Collection[str],
    ) -> None:
        self.network = network
        self.settings = settings
        self.injections = injections
        self.names = list(network.fmus)
        self.numbers = {name: number for number, name in enumerate(self.names)}
        self.signals = Slots(settings)
        self.slots = self.signals.numbers
        read = {link.source.name for link in network.links()}
        self.fetched = (
            None
            if wanted is None
            else read | set(wanted) | set(more) | {injection.connector for injection in injections}
        )
        self.named = {*(wanted or ()), *more}
        signals = [link.source for link in network.links() if not link.is_parameter]
        self.other_sources = {node.name for node in signals if node.component is not None and node.kind != "output"}
        self.passed_parameters = {node.name for node in signals if node.component is None and node.kind in PARAMETERS}
        self.ranges = np.zeros((len(self.names), len(EXCHANGES), 2), dtype=np.int64)
        self.table = TransferTable()
        self.transfers: dict[int, ComponentTransfers] = {}  # of components of FMI 3.0
        self.parameters = Parameters(network, settings, self.table)
        self.texts, self.binaries = (Texts(network, settings, kind) for kind in TEXTS)
        self.recorded: dict[int, list[tuple[int, int, int]]] = {}  # by component: function, first and count of slots
        placing = TransferPlacing(network, self.signals, self.table, self.fetched, self.named, self.other_sources)
        for index, name in enumerate(self.names):
            if network.fmus[name].version == 3:
                self.transfers[index] = self.parameters.transfers[index]
                placing.place(name, self.transfers[index], self._texts(index))
            else:
                self._place_component(index, name)
        for node in network.nodes.values():
            known = node.name in network.driver or node.name in settings.nodes or node.name in network.driven
            is_signal = node.kind not in PARAMETERS or node.name in self.passed_parameters
            if node.component is None and is_signal and known and node.type_name not in TEXTS:
                unit = node.unit.name if node.unit else None
                self.signals.add(
                    node.name, 0, float(settings.nodes.get(node.name, np.nan)), node.type_name or "Real", unit
                )

    def _texts(self, index: int) -> list[list[tuple[Sequence[Variable], int]]]:
        """The Strings and Binaries of a component with their first rows: inputs, outputs."""
        kinds = (self.texts, self.binaries)
        return [[(each.variables[index][way], int(each.ranges[index, way, 0])) for each in kinds] for way in (0, 1)]

    def _place_component(self, index: int, component: str) -> None:
        fmu = self.network.fmus[component]
        exchanged: list[list[Variable]] = [[] for _ in EXCHANGES]
        for variable in fmu.variables.values():
            kind = TYPE_KIND.get(variable.type, len(EXCHANGES))
            causality = variable.causality
            if self.other_sources and f"{component}.{variable.name}" in self.other_sources:
                causality = "output"
            if causality in CAUSALITIES and 2 * kind < len(EXCHANGES):
                exchanged[2 * kind + CAUSALITIES.index(causality)].append(variable)
        for function, variables in enumerate(exchanged):
            first = len(self.signals.references)
            causality = CAUSALITIES[function % 2]
            for variable in variables:
                name = f"{component}.{variable.name}"
                if causality == "input" and name not in self.network.driver and name not in self.network.driven:
                    continue
                if causality == "output" and self.fetched is not None and name not in self.fetched:
                    continue
                initial = self.signals.start(component, variable) if causality == "input" else np.nan
                self.signals.add(name, variable.reference, initial, variable.type, fmu.unit_of(variable))
            self.ranges[index, function] = first, len(self.signals.references) - first
        self.recorded[index] = self._place_recorded(component) if self.named else []

    def _place_recorded(self, component: str) -> list[tuple[int, int, int]]:
        """Slots of variables that are recorded and not exchanged."""
        fmu = self.network.fmus[component]
        reads = []
        for kind, function in enumerate(GETTERS):
            first = len(self.signals.references)
            for variable in fmu.variables.values():
                name = f"{component}.{variable.name}"
                if name in self.named and name not in self.slots and TYPE_KIND.get(variable.type) == kind:
                    self.signals.add(name, variable.reference, np.nan, variable.type, fmu.unit_of(variable))
            if len(self.signals.references) > first:
                reads.append((function, first, len(self.signals.references) - first))
        return reads

    def _links(self) -> list[list[Link]]:
        """Links grouped by the component they feed, upstream first; the last group feeds system connectors."""
        groups: dict[str | None, dict[str, Link]] = {name: {} for name in self.names}
        groups[None] = {}
        for name in self.slots:
            link = self.network.driver.get(name)
            if link is not None and link.target.component is not None:
                self._chain(name, groups[link.target.component])
        for node in self.network.nodes.values():
            if node.name in self.slots and node.component is None:
                self._chain(node.name, groups[None])
        return [list(group.values()) for group in groups.values()]

    def _chain(self, name: str, group: dict[str, Link]) -> None:
        """Add the links that bring a value to a node, by their targets, those before it first, none twice."""
        link = self.network.driver.get(name)
        if link is None or name in group or name in self.passed_parameters:
            return
        if link.source.component is None:
            self._chain(link.source.name, group)
        group[name] = link

    def _drives(self) -> tuple[list[str], list[tuple[int, int]]]:
        """The inputs driven over time by component, those of system connectors last; first and count of each group."""
        groups: dict[str, list[str]] = {name: [] for name in (*self.names, "")}
        for name in self.network.driven:
            groups[split_name(name, self.network.fmus)[0]].append(name)
        firsts = np.cumsum([0, *(len(group) for group in groups.values())]).tolist()
        ranges = [(first, len(group)) for first, group in zip(firsts, groups.values(), strict=False)]
        return [name for group in groups.values() for name in group], ranges

    def program(
        self, prepared: PreparedSystem, instances: Mapping[str, Instance]
    ) -> tuple[arrays.Program, InstructionList]:
        driven, drives = self._drives()
        groups_of_links = self._links()
        links = [term for linked in groups_of_links for link in linked for term in (link, *link.added)]
        tables = [numbers(self.network, link) + _remainder(link) for link in links]
        firsts = np.cumsum([0, *(len(table) for table in tables)])
        flat = [entry for table in tables for entry in table]
        finished = self.network.nodes.get("finished")
        has_finish = finished is not None and finished.kind == "output" and "finished" in self.slots
        fault_slots = [self._fault_slot(injection) for injection in self.injections]
        collected = InstructionList(
            [instances[name] for name in self.names],
            [[term for link in linked for term in self._terms(link)] for linked in groups_of_links],
            fault_slots,
            drives,
            self.texts,
            self.binaries,
        )
        references = np.array(self.signals.references, dtype=np.uint32)
        collected.orders = [
            self._orders(collected, index, instances[name], references) for index, name in enumerate(self.names)
        ]
        instructions, reset_end, phases = write_instructions(
            collected, self.names, prepared.schedule, prepared.algorithm, prepared.periods
        )
        program = arrays.Program(
            instructions=instructions,
            reset_end=reset_end,
            phases=phases,
            reference=references,
            initial=np.array(self.signals.initial, dtype=np.float64),
            parameter_reference=np.array(self.parameters.references, dtype=np.uint32),
            tolerance=np.array([_tolerance(self.network.fmus[name]) for name in self.names], dtype=np.float64),
            source=np.array([self.slots[link.source.name] for link in links], dtype=np.int64),
            target=np.array([self.slots[link.target.name] for link in links], dtype=np.int64),
            factor=np.array([link.transformation.factor for link in links], dtype=np.float64),
            offset=np.array([link.transformation.offset for link in links], dtype=np.float64),
            table=np.array(
                [(first, len(table)) for first, table in zip(firsts, tables, strict=False)], dtype=np.int64
            ).reshape(-1, 2),
            table_from=np.array([entry[0] for entry in flat], dtype=np.float64),
            table_to=np.array([entry[1] for entry in flat], dtype=np.float64),
            finished_slot=self.slots["finished"] if has_finish else -1,
            fault_slot=np.array(fault_slots, dtype=np.int64),
            fault_kind=np.array([injection.kind for injection in self.injections], dtype=np.int64),
            fault_window=np.array([injection.window for injection in self.injections], dtype=np.float64).reshape(-1, 2),
            fault_value=np.array([injection.value for injection in self.injections], dtype=np.float64),
            drive_slot=np.array([self.slots[name] for name in driven], dtype=np.int64),
            drive_table=_columns(prepared.drive, driven),
        )
        return program, collected

    def _orders(self, collected: InstructionList, index: int, instance: Instance, references: np.ndarray) -> Orders:
        if index in self.transfers:
            return Fmi3Orders(collected, index, self.transfers[index], self.table)
        return Fmi2Orders(
            collected,
            index,
            instance,
            references,
            self.ranges[index].tolist(),
            self.parameters.ranges[index].tolist(),
            self.texts.ranges[index].tolist(),
            self.recorded[index],
            one_by_one=self.parameters.is_one_by_one(self.names[index]),
        )

    def fmi3(self, instances: Mapping[str, Instance]) -> arrays.Fmi3 | None:
        """What the loop has in addition of a system with FMUs of FMI 3.0."""
        if not self.transfers:
            return None
        start = np.zeros(len(self.slots), dtype=np.uint64)
        for slot, number in self.signals.exact.items():
            start[slot] = number % 2**64
        sizes = self.binaries.sizes()
        return arrays.Fmi3(
            transfers=arrays.Transfers(
                rows=self.table.array(),
                reference=np.array(self.table.references, dtype=np.uint32),
                functions=np.array([instances[name].function_addresses() for name in self.names], dtype=np.uint64),
            ),
            start=start,
            stored=arrays.stored(start.size),
            given=self.parameters.words,
            confirmed=np.zeros_like(self.parameters.words),
            binaries=self.binaries.memory(),
            sizes=sizes.copy(),
            initial_sizes=sizes,
        )

    def _terms(self, link: Link) -> list[Term]:
        """What `InstructionList` needs to know of a connection, and of those that are added to it."""
        origins = tuple([self._number(term) for term in (link, *link.added)])
        slots, target = self.slots, self.slots[link.target.name]
        terms = [(self._connection_code(link), origins, slots[link.source.name], target)]
        return terms + [(codes.ADD, origins, slots[term.source.name], target) for term in link.added]

    def _number(self, link: Link) -> int:
        """The number of the component that a value comes from, -1 of a system's input."""
        component = origin(self.network, link).component
        return -1 if component is None else self.numbers[component]

    def _fault_slot(self, injection: Injection) -> int:
        changeable(self.network, injection.connector, ("connector", injection.connector))  # refuses all others
        return self.slots[injection.connector]

    def layout(self) -> Layout:
        table = self.signals
        texts = self.texts, self.binaries
        return Layout(self.slots, table.types, table.units, self.parameters, *texts, frozenset(table.unfed))

    def _connection_code(self, link: Link) -> int:
        """The instruction that carries a connection's value."""
        if link.transformation.table:
            return codes.MAP
        if link.transformation != IDENTITY:
            return codes.TRANSFORM
        start = origin(self.network, link)
        fmu = self.network.fmus.get(start.component or "")
        is_wide = fmu is not None and fmu.variables[start.variable].representation.is_wide
        return codes.COPY_EXACT if is_wide else codes.COPY


def _tolerance(fmu: Fmu) -> float:
    """The relative tolerance that an FMU proposes for its own solver, NaN where it proposes none."""
    experiment = fmu.description.defaultExperiment
    return float(experiment.tolerance) if experiment is not None and experiment.tolerance is not None else np.nan


def _columns(drive: Drive | None, names: Sequence[str]) -> np.ndarray:
    """The table of inputs over time with its columns in the order of ``names``."""
    if drive is None:
        return np.zeros((0, 0))
    places = {name: index for index, name in enumerate(drive.names)}
    return np.ascontiguousarray(drive.table[:, [places[name] for name in names]])


def _remainder(link: Link) -> list[tuple[float, float]]:
    """The end of a table that leaves other values as they are, by which the loop knows it."""
    return [(math.nan, math.nan)] if link.transformation.is_partial else []
