"""From schedule and layout to the loop's instructions: what is done, in which order, in each step."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from ..instances.instance import Instance
from ..instances.library import FUNCTION_NAMES
from ..system.schedule import Schedule
from .compiled import codes
from .in_memory import Run, runs_in_memory, with_moves
from .parameters import Texts

Term = tuple[int, tuple[int, ...], int, int]  # of a connection: code, origins, source and target slot
TAKES = {"Real": codes.TAKE_REAL, "Integer": codes.TAKE_WHOLE, "Boolean": codes.TAKE_BOOLEAN}
FUNCTION = {name.removeprefix("fmi2"): number for number, name in enumerate(FUNCTION_NAMES)}
# Real, Integer (and Enumeration), Boolean, String: what sets parameters, what reads them back.
PARAMETER_CALLS = (
    ((codes.PARAMETERS, "SetReal"), (codes.READ_BACK, "GetReal")),
    ((codes.WHOLE_PARAMETERS, "SetInteger"), (codes.WHOLE_READ_BACK, "GetInteger")),
    ((codes.WHOLE_PARAMETERS, "SetBoolean"), (codes.WHOLE_READ_BACK, "GetBoolean")),
    ((codes.TEXT_PARAMETERS, "SetString"), (codes.TEXT_READ_BACK, "GetString")),
)


class InstructionList:
    """Collects instructions.

    ``ranges`` [component][get or set function 0..5] are (first, count) of slots, ``parameter_ranges``
    [component][type] the first parameter, how many there are, and how many of them, the first ones, are set again
    in initialisation mode and read back. ``connections`` [component] lists, for each
    connection that feeds a component, in order, its instruction code, the components that the target's value
    comes from (-1: a system's constant input), source and target slot; the last entry is for
    system connectors.
    Connections and ``fault_slots`` are numbered as in the program's arrays; ``drives`` [component] are (first, count)
    of the inputs driven over time, the last entry of those of system connectors; ``texts`` has the places of Strings;
    the parameters of ``one_by_one`` are read back each in a call of its own; ``recorded`` [component] are the pieces
    (function, first slot, count) of variables that are read for the record only.
    """

    def __init__(
        self,
        instances: Sequence[Instance],
        ranges: np.ndarray,
        parameter_ranges: np.ndarray,
        connections: Sequence[Sequence[Term]],
        fault_slots: Sequence[int],
        drives: Sequence[tuple[int, int]],
        texts: Texts,
        one_by_one: Collection[int] = (),
        references: Sequence[int] = (),
        recorded: Sequence[Sequence[tuple[int, int, int]]] = (),
    ) -> None:
        self.instances = instances
        self.addresses = [(instance.address, instance.function_addresses()) for instance in instances]
        self.references = np.array(references, dtype=np.uint32)
        self.between_steps = False  # all FMUs: what they give and take then may be in their memory
        self.ranges = ranges.tolist()  # single elements of lists are ten times quicker to reach
        self.parameter_ranges = parameter_ranges.tolist()
        self.text_ranges = texts.ranges.tolist()
        self.connections = connections
        self.firsts = np.cumsum([0, *(len(group) for group in connections)]).tolist()
        self.fault_slots = fault_slots
        self.one_by_one = one_by_one
        self.recorded = recorded
        self.texts = texts
        self.drives = drives
        self.rows: list[list[int]] = []

    def array(self) -> np.ndarray:
        """What has been collected."""
        return np.array(self.rows, dtype=np.uint64).reshape(-1, codes.COLUMNS)

    def call(self, code: int, component: int, function: int, piece: Sequence[int] = (0, 0)) -> None:
        """A call of an FMI function on a piece of slots or parameters."""
        instance, addresses = self.addresses[component]
        self.rows.append([code, addresses[function], instance, int(piece[0]), int(piece[1]), component, function])

    def give(self, component: int, piece: Sequence[int], begun: int) -> None:
        """Reals set on a piece of slots; in the FMU's own memory where it says where they lie.

        Rows from ``begun`` on are what carries the values there.
        """
        runs = self._runs(component, piece, "Real", to_set=True)
        moved = with_moves(self.rows[begun:], runs, component, self.addresses[component][0])
        if not runs:
            self.call(codes.SET_REAL, component, FUNCTION["SetReal"], piece)
        elif moved:
            self.rows[begun:] = moved
        else:
            self._exchange(codes.PUT_REAL, component, runs)

    def take(self, component: int, function: int, piece: Sequence[int]) -> None:
        """Reals, Integers or Booleans got on a piece of slots; of the FMU's own memory where it says where they lie."""
        kind = FUNCTION_NAMES[function].removeprefix("fmi2Get")
        call = codes.GET_REAL if kind == "Real" else codes.GET_WHOLE
        runs = self._runs(component, piece, kind)
        if not runs:
            self.call(call, component, function, piece)
        for run in runs:
            self._exchange(TAKES[kind], component, [run])
            if kind == "Integer":
                self.call(call, component, function, (run.first, run.size))

    def _exchange(self, code: int, component: int, runs: Sequence[Run]) -> None:
        instance, _ = self.addresses[component]
        self.rows += [[code, run.address, instance, run.first, run.size, component, 0] for run in runs]

    def _runs(self, component: int, piece: Sequence[int], kind: str, *, to_set: bool = False) -> list[Run]:
        """A piece of slots in an FMU's memory; nothing before all are initialised."""
        if not self.between_steps:
            return []
        first, count = piece
        references = self.references[first : first + count]
        return runs_in_memory(self.instances[component], references, first, kind, to_set=to_set)

    def connect(self, group: int, known: Collection[int] | None = None) -> None:
        """Values over the connections that feed a component; group -1: system connectors.

        With ``known`` only those whose values come from these components alone.
        """
        group %= len(self.connections)
        run: list[int] = []
        for number, (code, origins, source, target) in enumerate(self.connections[group], self.firsts[group]):
            if known is not None and any(origin not in known for origin in origins):
                run = []
            elif code == codes.COPY:
                # neighbouring slots copied to neighbouring slots are one instruction
                if run and (source, target) == (run[1] + run[4], run[3] + run[4]):
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
        """The values over time of a component's driven inputs; group -1: of system connectors.

        Before all has ``started`` they are the initialisation's, then those of the communication point.
        """
        first, count = self.drives[group]
        if count:
            self.rows.append([codes.DRIVE, int(started), 0, first, count, 0, 0])

    def inject(self, piece: Sequence[int]) -> None:
        """The faults on a piece of slots."""
        for number, slot in enumerate(self.fault_slots):
            if piece[0] <= slot < piece[0] + piece[1]:
                self.rows.append([codes.INJECT, 0, 0, number, 1, 0, 0])

    def set(self, component: int, known: Collection[int] | None = None) -> None:
        """Inputs of a component; in the initialisation those whose source is not ``known`` keep their start values."""
        begun = len(self.rows)
        self.drive(component, started=known is None)
        self.connect(component, known)
        for function in (FUNCTION["SetReal"], FUNCTION["SetInteger"], FUNCTION["SetBoolean"]):
            piece = self.ranges[component][function]
            if piece[1]:
                self.inject(piece)
                if function == FUNCTION["SetReal"]:
                    self.give(component, piece, begun)
                else:
                    self.call(codes.SET_WHOLE, component, function, piece)

        for start, source, target in self.texts.connections[component]:
            if known is None or start in known:
                self.rows.append([codes.COPY_TEXT, source, 0, target, 1, component, 0])
        if self.text_ranges[component][0][1]:
            self.call(codes.SET_TEXT, component, FUNCTION["SetString"], self.text_ranges[component][0])

    def carry(self, component: int) -> None:
        """Values and faults to the inputs of a component, which is not given them."""
        self.connect(component)
        for function in (FUNCTION["SetReal"], FUNCTION["SetInteger"], FUNCTION["SetBoolean"]):
            self.inject(self.ranges[component][function])

    def get(self, component: int) -> None:
        """Outputs of a component, at the end of the step."""
        for function in (FUNCTION["GetReal"], FUNCTION["GetInteger"], FUNCTION["GetBoolean"]):
            piece = self.ranges[component][function]
            if piece[1]:
                self.take(component, function, piece)
                self.inject(piece)
        if self.text_ranges[component][1][1]:
            self.call(codes.GET_TEXT, component, FUNCTION["GetString"], self.text_ranges[component][1])

    def read(self, component: int) -> None:
        """Outputs of a component, and what else of it is recorded, whose values may be anything."""
        self.get(component)
        for function, first, count in self.recorded[component] if self.recorded else ():
            code = codes.READ_REAL if function == FUNCTION["GetReal"] else codes.GET_WHOLE
            self.call(code, component, function, (first, count))

    def step(self, component: int, period: int = 1) -> None:
        """A step that ends with this communication step and begins ``period`` of them earlier."""
        self.call(codes.STEP, component, FUNCTION["DoStep"], (0, 0 if period == 1 else period))

    def reset(self) -> None:
        """Every FMU back to the state after instantiation, its flight ended."""
        for component in range(len(self.instances)):
            self.call(codes.MODE, component, FUNCTION["Terminate"])
            self.call(codes.MODE, component, FUNCTION["Reset"])

    def parameters(self, component: int, column: int) -> None:
        """Parameters of a component: column 1 of its ranges sets them, 2 sets them again, 3 reads them back."""
        for kind, (setter, getter) in enumerate(PARAMETER_CALLS):
            first, count = self.parameter_ranges[component][kind][0], self.parameter_ranges[component][kind][column]
            code, function = getter if column == 3 else setter
            size = 1 if column == 3 and component in self.one_by_one else max(1, count)
            for start in range(first, first + count, size):
                self.call(code, component, FUNCTION[function], (start, size))

    def initialise(self, order: Sequence[int]) -> None:
        """Parameters, initialisation mode, one exchange in ``order`` that settles the start.

        Who comes before its sources is given the declared start values, on which what it sends on
        does not depend.
        """
        for component in range(len(self.instances)):
            self.parameters(component, 1)
            self.call(codes.SETUP, component, FUNCTION["SetupExperiment"])
            self.call(codes.MODE, component, FUNCTION["EnterInitializationMode"])
            self.parameters(component, 2)  # again: there are FMUs that lose what they were given before
        self.drive(-1, started=False)
        known = {-1}
        for component in order:
            self.set(component, known)
            self.get(component)
            known.add(component)
        for component in range(len(self.instances)):
            self.call(codes.MODE, component, FUNCTION["ExitInitializationMode"])
        for component in range(len(self.instances)):
            self.parameters(component, 3)
        for component in range(len(self.instances)):
            self.read(component)  # again: there are FMUs that compute outputs only when they leave initialisation

    def side_by_side(self, components: Sequence[int], periods: Mapping[int, int]) -> None:
        """All stepped, with the inputs that they have, then all read: Jacobi's way."""
        for component in components:
            self.step(component, periods.get(component, 1))
        for component in components:
            self.read(component)

    def in_turn(self, components: Sequence[int], periods: Mapping[int, int]) -> None:
        """Each with inputs of the end of its step."""
        for component in components:
            self.set(component)
            self.step(component, periods.get(component, 1))
            self.read(component)

    def hand_over(self, components: Sequence[int]) -> None:
        """The end of every communication point, the first one too: inputs for the next step, system connectors."""
        for component in components:
            self.set(component)
        self.connect(-1)


def write_instructions(
    instructions: InstructionList, names: Sequence[str], schedule: Schedule, algorithm: str, periods: Mapping[str, int]
) -> tuple[np.ndarray, int, np.ndarray]:
    """The instruction array, where resetting ends in it, and where the initialisation and each part end.

    Step n works off part n modulo the parts' number: there is one for each communication step until all ``periods``
    (of components, in communication steps, where longer than 1) have come round together.
    """
    instructions.rows = []
    index = {name: position for position, name in enumerate(names)}
    instructions.reset()
    reset_end = len(instructions.rows)
    sources = [index[name] for name in schedule.sources_first]
    ahead = range(len(names)) if algorithm == "jacobi" else sources
    behind = [] if algorithm == "jacobi" else [index[name] for name in schedule.followers]
    instructions.initialise([index[name] for name in schedule.initial_order])
    instructions.drive(-1, started=True)
    instructions.between_steps = True
    instructions.hand_over(ahead)
    ends = [len(instructions.rows)]
    lengths = {index[name]: period for name, period in periods.items()}
    for part in range(math.lcm(*lengths.values())):
        due = [component for component in ahead if (part + 1) % lengths.get(component, 1) == 0]
        instructions.drive(-1, started=True)
        instructions.side_by_side(due, lengths)
        instructions.in_turn([n for n in behind if (part + 1) % lengths.get(n, 1) == 0], lengths)
        instructions.hand_over(due)
        ends.append(len(instructions.rows))
    instructions.between_steps = False
    return instructions.array(), reset_end, np.array(ends, dtype=np.int64)


def write_ending(instructions: InstructionList, component: int) -> np.ndarray:
    """The instructions of a last row: the outputs of the FMU that asks for the end, carried on to all connectors."""
    instructions.rows = []
    instructions.read(component)
    for other in range(len(instructions.instances)):
        instructions.carry(other)
    instructions.connect(-1)
    return instructions.array()
