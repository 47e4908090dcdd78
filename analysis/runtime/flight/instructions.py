"""Instructions of the loop, derived from schedule and layout: the operations of each step, in order."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from ..loop import codes
from ..system.schedule import Schedule
from .orders.connections import Term
from .orders.fmi2 import Fmi2Orders
from .orders.fmi3 import Fmi3Orders
from .orders.instruction_rows import Callee, InstructionRows
from .orders.texts import TextSlots

Orders = Fmi2Orders | Fmi3Orders


class InstructionList(InstructionRows):
    """Writer of a system's instructions.

    ``orders`` contains the writer of the calls of each component. ``connections`` [component] lists the terms of the
    connections to a component, in order. Connections and ``fault_slots`` are numbered as in the program's arrays.
    ``drives`` [component] is the (first, count) of the inputs driven over time. The last entries of ``connections`` and
    ``drives`` are for system connectors. ``texts`` and ``binaries`` contain the positions of Strings and Binaries.
    """

    def __init__(
        self,
        instances: Sequence[Callee],
        connections: Sequence[Sequence[Term]],
        fault_slots: Sequence[int],
        drives: Sequence[tuple[int, int]],
        texts: TextSlots,
        binaries: TextSlots,
    ) -> None:
        super().__init__(instances, fault_slots)
        self.orders: list[Orders] = []
        self.connections = connections
        self.firsts = np.cumsum([0, *(len(group) for group in connections)]).tolist()
        self.texts = ((codes.COPY_TEXT, texts), (codes.COPY_BINARY, binaries))
        self.drives = drives

    def connect(self, group: int, known: Collection[int] | None = None) -> None:
        """Write the transfer of values over the connections to a component; group -1 is the system connectors.

        If ``known`` is passed, only connections with values that originate in these components are written.
        """
        group %= len(self.connections)
        run: list[int] = []
        for number, (code, origins, source, target) in enumerate(self.connections[group], self.firsts[group]):
            if known is not None and any(origin not in known for origin in origins):
                run = []
            elif code in (codes.COPY, codes.COPY_EXACT):
                # copies between adjacent slots are merged into one instruction
                if run and run[0] == code and (source, target) == (run[1] + run[4], run[3] + run[4]):
                    run[4] += 1
                else:
                    run = [code, source, 0, target, 1, group, 0]
                    self.rows.append(run)
            elif run and run[0] == code:
                run[4] += 1
            else:
                run = [code, 0, 0, number, 1, group, 0]
                self.rows.append(run)

    def drive(self, group: int, *, started: bool) -> None:
        """Write the values of a component's inputs that are driven over time; group -1 is the system connectors.

        Once the simulation has ``started``, the values at the communication point are used, before it the values for
        the initialisation.
        """
        first, count = self.drives[group]
        if count:
            self.rows.append([codes.DRIVE, int(started), 0, first, count, 0, 0])

    def set(self, component: int, known: Collection[int] | None = None) -> None:
        """Set the inputs of a component.

        During initialisation, ``known`` contains the components that have been computed; inputs from other components
        have their start values.
        """
        for code, texts in self.texts:
            for start, source, target in texts.connections[component]:
                if known is None or start in known:
                    self.rows.append([code, source, 0, target, 1, component, 0])
        self.orders[component].reset_bases()
        begun = len(self.rows)
        self.drive(component, started=known is None)
        self.connect(component, known)
        self.orders[component].set(begun, started=known is None)

    def write_input_slots(self, component: int) -> None:
        """Write connected values and faults to a component's input slots, without calling its FMU."""
        self.orders[component].reset_bases()
        self.connect(component)
        self.orders[component].apply_input_faults()

    def get(self, component: int) -> None:
        """Get the outputs of a component at the end of its step."""
        self.orders[component].get()

    def read(self, component: int) -> None:
        """Get the outputs of a component and its other recorded variables, which may be non-finite."""
        self.orders[component].get()
        self.orders[component].read()

    def step(self, component: int, period: int = 1) -> None:
        """Write a component's step over ``period`` communication steps, of which the last is the current one."""
        self.orders[component].step(0 if period == 1 else period)

    def reset(self) -> None:
        """Terminate every FMU and reset it to the state after instantiation."""
        for orders in self.orders:
            orders.reset()

    def initialise(self, order: Sequence[int]) -> None:
        """Write parameters and initialisation mode, with one exchange of values in the sequence ``order``.

        The inputs of a component that precedes its sources have declared start values; the outputs passed on do not
        depend on these inputs.
        """
        for orders in self.orders:
            orders.enter_initialization()
        self.drive(-1, started=False)
        known = {-1}
        for component in order:
            self.set(component, known)
            self.get(component)
            known.add(component)
        for orders in self.orders:
            orders.exit_initialization()
        for orders in self.orders:
            orders.read_back()
        for component in range(len(self.orders)):
            self.read(component)  # again, because some FMUs compute outputs only when they leave initialisation mode

    def step_jacobi(self, components: Sequence[int], periods: Mapping[int, int]) -> None:
        """Step all components with their current inputs, then read all outputs (Jacobi's method)."""
        for component in components:
            self.step(component, periods.get(component, 1))
        for component in components:
            self.read(component)

    def step_gauss_seidel(self, components: Sequence[int], periods: Mapping[int, int]) -> None:
        """Step each component with inputs from the end of its step."""
        for component in components:
            self.set(component)
            self.step(component, periods.get(component, 1))
            self.read(component)

    def finish_point(self, components: Sequence[int]) -> None:
        """Write the end of a communication point: set the inputs for the next step and the system connectors."""
        for component in components:
            self.set(component)
        self.connect(-1)


def write_instructions(
    instructions: InstructionList, names: Sequence[str], schedule: Schedule, algorithm: str, periods: Mapping[str, int]
) -> tuple[np.ndarray, int, np.ndarray]:
    """Return the instructions, and the ends of the reset, of the initialisation and of each repeated section.

    Step n executes section n modulo the number of sections. There is one section for each communication step up to the
    least common multiple of ``periods``, which are numbers of communication steps by component (only those above 1).
    """
    instructions.begin()
    index = {name: position for position, name in enumerate(names)}
    instructions.reset()
    reset_end = instructions.end_part()
    ahead = _ahead(names, schedule, algorithm)
    behind = [] if algorithm == "jacobi" else [index[name] for name in schedule.followers]
    instructions.initialise([index[name] for name in schedule.initial_order])
    instructions.drive(-1, started=True)
    instructions.between_steps = True
    instructions.finish_point(ahead)
    ends = [instructions.end_part()]
    lengths = {index[name]: period for name, period in periods.items()}
    for part in range(math.lcm(*lengths.values())):
        due = [component for component in ahead if (part + 1) % lengths.get(component, 1) == 0]
        instructions.drive(-1, started=True)
        instructions.step_jacobi(due, lengths)
        instructions.step_gauss_seidel([n for n in behind if (part + 1) % lengths.get(n, 1) == 0], lengths)
        instructions.finish_point(due)
        ends.append(instructions.end_part())
    instructions.between_steps = False
    return instructions.array(), reset_end, np.array(ends, dtype=np.int64)


def write_renewal(
    instructions: InstructionList,
    names: Sequence[str],
    schedule: Schedule,
    algorithm: str,
    periods: Mapping[str, int],
    part: int,
) -> dict[int, np.ndarray]:
    """Write instructions that update inputs after a system's inputs or faulty parameters changed between two steps.

    The instructions are returned by component, for the components that step in the next section (number ``part``) with
    inputs from the start of the step. For other arguments see `write_instructions`.
    """
    renewed = {}
    for component in _ahead(names, schedule, algorithm):
        instructions.begin()
        if part % periods.get(names[component], 1) == 0:
            instructions.orders[component].reset_bases()
            instructions.connect(component, {-1})
        if instructions.rows:
            renewed[component] = instructions.array()
    return renewed


def _ahead(names: Sequence[str], schedule: Schedule, algorithm: str) -> Sequence[int]:
    """Return the components that step with inputs from the start of the step."""
    return range(len(names)) if algorithm == "jacobi" else [names.index(name) for name in schedule.sources_first]


def write_ending(instructions: InstructionList, component: int) -> np.ndarray:
    """Write the instructions of the last row when an FMU ends the simulation.

    Its outputs are read and passed on to all connectors.
    """
    instructions.begin()
    instructions.read(component)
    for other in range(len(instructions.orders)):
        instructions.write_input_slots(other)
    instructions.connect(-1)
    return instructions.array()
