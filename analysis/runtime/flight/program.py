"""Builder of the loop's arrays from network, settings and schedule."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ....fmus_src.roles import FINISHED
from ..fmi.representations import TEXTS
from ..fmi.variable import ScalarVariable
from ..loop import arrays
from ..ssp.kinds import PARAMETERS
from ..ssp.names import split_name
from ..system.checks import changeable
from ..system.fmu import Fmu
from ..system.inputs import Drive
from ..system.network import Network
from ..system.passing.settings import SystemSettings
from ..system.prepared import PreparedSystem
from .instructions import InstructionList, Orders, write_instructions
from .orders.connections import Connections
from .orders.exchanged import Exchanged
from .orders.fmi2 import Fmi2Orders
from .orders.fmi3 import Fmi3Orders
from .orders.injections import Injection
from .orders.instruction_rows import Callee
from .orders.placing_fmi2 import ComponentSlots, place_component
from .orders.placing_fmi3 import TransferPlacing
from .orders.slots import Slots
from .orders.texts import TextSlots
from .orders.transfers import ComponentTransfers, TransferTable
from .parameters import Key, Parameters


@dataclass
class Layout:
    """Layout of the arrays: slots by name, parameters, exchanged Strings and Binaries.

    ``unfed`` contains the slots of unconnected elements of arrays that are set as a whole, and ``bases`` the slots of
    the unchanged values of parameters that change during simulation.
    """

    slots: dict[str, int]
    types: dict[str, str]
    units: dict[str, str | None]
    parameters: Parameters
    texts: TextSlots
    binaries: TextSlots
    unfed: frozenset[str] = frozenset()
    bases: Mapping[Key, int] = field(default_factory=dict)


def build_program(
    prepared: PreparedSystem,
    settings: SystemSettings,
    instances: Mapping[str, Callee],
    requested: Collection[str] | None,
    injections: Sequence[Injection],
    additional: Collection[str] = (),
) -> tuple[arrays.Program, arrays.Fmi3 | None, InstructionList, Layout]:
    """Return the loop's arrays, additional arrays for FMI 3.0 (or None), the writer of instructions, and the layout.

    ``requested`` names the signals to record (None: all exchanged ones), and ``additional`` names further signals.
    Outputs are read only if they are connected or recorded, other variables only if they are named.
    """
    builder = _Builder(prepared.network, settings, requested, injections, additional)
    program, instructions = builder.program(prepared, instances)
    return program, builder.fmi3(instances), instructions, builder.layout()


def make_layout(
    network: Network,
    settings: SystemSettings,
    requested: Collection[str] | None = None,
    injections: Sequence[Injection] = (),
    additional: Collection[str] = (),
) -> Layout:
    """Return the layout of a simulation without building its program; for the arguments see `build_program`."""
    return _Builder(network, settings, requested, injections, additional).layout()


class _Builder:
    def __init__(
        self,
        network: Network,
        settings: SystemSettings,
        requested: Collection[str] | None,
        injections: Sequence[Injection],
        additional: Collection[str],
    ) -> None:
        self.network = network
        self.injections = injections
        self.names = list(network.fmus)
        self.signals = Slots(settings)
        self.slots = self.signals.numbers
        self.exchanged = Exchanged(network, requested, additional, injections)
        self.table = TransferTable()
        self.component_slots: dict[int, ComponentSlots] = {}  # by number of the component, of FMI 2.0
        self.transfers: dict[int, ComponentTransfers] = {}  # by number of the component, of FMI 3.0
        self.parameters = Parameters(network, settings, self.table, self.exchanged.tuned)
        self.texts, self.binaries = (TextSlots(network, settings, kind) for kind in TEXTS)
        placing = TransferPlacing(network, self.exchanged, self.signals, self.table)
        for index, name in enumerate(self.names):
            if network.fmus[name].version == 3:
                self.transfers[index] = self.parameters.transfers[index]
                placing.place(name, self.transfers[index], self._texts(index))
            else:
                self.component_slots[index] = place_component(network, name, self.exchanged, self.signals)
        self._place_system_connectors(settings)

    def _place_system_connectors(self, settings: SystemSettings) -> None:
        for node in self.network.nodes.values():
            known = self.exchanged.is_set(node.name) or node.name in settings.nodes
            is_signal = node.kind not in PARAMETERS or node.name in self.exchanged.passed_parameters
            if node.component is None and is_signal and known and node.type_name not in TEXTS:
                unit = node.unit.name if node.unit else None
                start = float(settings.nodes.get(node.name, np.nan))
                self.signals.add(node.name, 0, start, node.type_name or "Real", unit)

    def _texts(self, index: int) -> list[list[tuple[Sequence[ScalarVariable], int]]]:
        """Return the Strings and Binaries of a component with their first rows, for inputs and for outputs."""
        kinds = (self.texts, self.binaries)
        return [[(each.variables[index][way], int(each.ranges[index, way, 0])) for each in kinds] for way in (0, 1)]

    def _drives(self) -> tuple[list[str], list[tuple[int, int]]]:
        """Return the names of inputs driven over time, grouped by component with system connectors last.

        The (first, count) of each group is returned, too.
        """
        groups: dict[str, list[str]] = {name: [] for name in (*self.names, "")}
        for name in self.network.driven:
            groups[split_name(name, self.network.fmus)[0]].append(name)
        firsts = np.cumsum([0, *(len(group) for group in groups.values())]).tolist()
        ranges = [(first, len(group)) for first, group in zip(firsts, groups.values(), strict=False)]
        return [name for group in groups.values() for name in group], ranges

    def program(
        self, prepared: PreparedSystem, instances: Mapping[str, Callee]
    ) -> tuple[arrays.Program, InstructionList]:
        driven, drives = self._drives()
        connections = Connections(self.network, self.exchanged, self.signals)
        finished = self.network.nodes.get(FINISHED)
        has_finish = finished is not None and finished.kind == "output" and FINISHED in self.slots
        fault_slots = [self._fault_slot(injection) for injection in self.injections]
        collected = InstructionList(
            [instances[name] for name in self.names],
            connections.terms(),
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
            **connections.arrays(),
            finished_slot=self.slots[FINISHED] if has_finish else -1,
            fault_slot=np.array(fault_slots, dtype=np.int64),
            fault_kind=np.array([injection.kind for injection in self.injections], dtype=np.int64),
            fault_window=np.array([injection.window for injection in self.injections], dtype=np.float64).reshape(-1, 2),
            fault_value=np.array([injection.value for injection in self.injections], dtype=np.float64),
            drive_slot=np.array([self.slots[name] for name in driven], dtype=np.int64),
            drive_table=_columns(prepared.drive, driven),
        )
        return program, collected

    def _orders(self, collected: InstructionList, index: int, instance: Callee, references: np.ndarray) -> Orders:
        if index in self.transfers:
            return Fmi3Orders(collected, index, self.transfers[index], self.table)
        slots = self.component_slots[index]
        return Fmi2Orders(
            collected,
            index,
            instance,
            references,
            slots.ranges,
            self.parameters.ranges[index].tolist(),
            self.texts.ranges[index].tolist(),
            slots.recorded,
            slots.tuned,
            one_by_one=self.parameters.is_one_by_one(self.names[index]),
            set_once=self.parameters.is_set_once(self.names[index]),
        )

    def fmi3(self, instances: Mapping[str, Callee]) -> arrays.Fmi3 | None:
        """Return the additional arrays of a system with FMUs of FMI 3.0, else None."""
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

    def _fault_slot(self, injection: Injection) -> int:
        changeable(
            self.network, injection.connector, ("connector", injection.connector), tunable=True
        )  # rejects other connectors
        return self.slots[injection.connector]

    def layout(self) -> Layout:
        table = self.signals
        texts = self.texts, self.binaries
        return Layout(
            self.slots, table.types, table.units, self.parameters, *texts, frozenset(table.unfed), table.bases
        )


def _tolerance(fmu: Fmu) -> float:
    """Return the relative tolerance that an FMU proposes for its solver, NaN if it proposes none."""
    experiment = fmu.description.defaultExperiment
    return float(experiment.tolerance) if experiment is not None and experiment.tolerance is not None else np.nan


def _columns(drive: Drive | None, names: Sequence[str]) -> np.ndarray:
    """Return the table of inputs over time with its columns in the order of ``names``."""
    if drive is None:
        return np.zeros((0, 0))
    places = {name: index for index, name in enumerate(drive.names)}
    return np.ascontiguousarray(drive.table[:, [places[name] for name in names]])
