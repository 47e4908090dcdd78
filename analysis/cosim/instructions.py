"""From schedule and layout to the loop's instructions: what is done, in which order, in each step."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from . import loop
from .fmu import Instance
from .schedule import Schedule

FUNCTION = {name.removeprefix("fmi2"): number for number, name in enumerate(loop.FUNCTION_NAMES)}


class InstructionList:
    """Collects instructions.

    ``ranges`` [component][get or set function 0..5] and ``parameter_ranges`` [component][type]
    are (first, count) of slots and parameters. ``connections`` [component] lists the instruction
    code of each connection that feeds a component, in order; the last entry is for system
    connectors. Connections and ``fault_slots`` are numbered as in the program's arrays.
    """

    def __init__(
        self,
        instances: Sequence[Instance],
        ranges: np.ndarray,
        parameter_ranges: np.ndarray,
        connections: Sequence[Sequence[int]],
        fault_slots: Sequence[int],
    ) -> None:
        self.instances = [(instance.address, instance.function_addresses()) for instance in instances]
        self.ranges = ranges
        self.parameter_ranges = parameter_ranges
        self.connections = connections
        self.fault_slots = fault_slots
        self.rows: list[list[int]] = []

    def call(self, code: int, component: int, function: int, piece: Sequence[int] = (0, 0)) -> None:
        """A call of an FMI function on a piece of slots or parameters."""
        instance, addresses = self.instances[component]
        self.rows.append([code, addresses[function], instance, int(piece[0]), int(piece[1]), component, function, 0])

    def connect(self, group: int) -> None:
        """Values over the connections that feed a component; group -1: system connectors."""
        group %= len(self.connections)
        first = sum(len(codes) for codes in self.connections[:group])
        for code, run in itertools.groupby(self.connections[group]):
            count = len(list(run))
            self.rows.append([code, 0, 0, first, count, group, 0, 0])
            first += count

    def inject(self, piece: Sequence[int], at_end: bool) -> None:
        """The faults on a piece of slots."""
        for number, slot in enumerate(self.fault_slots):
            if piece[0] <= slot < piece[0] + piece[1]:
                self.rows.append([loop.INJECT, 0, 0, number, 1, 0, 0, int(at_end)])

    def set(self, component: int, at_end: bool) -> None:
        """Inputs of a component."""
        self.connect(component)
        for function in (FUNCTION["SetReal"], FUNCTION["SetInteger"], FUNCTION["SetBoolean"]):
            piece = self.ranges[component, function]
            if piece[1]:
                self.inject(piece, at_end)
                code = loop.SET_REAL if function == FUNCTION["SetReal"] else loop.SET_WHOLE
                self.call(code, component, function, piece)

    def get(self, component: int) -> None:
        """Outputs of a component, at the end of the step."""
        for function in (FUNCTION["GetReal"], FUNCTION["GetInteger"], FUNCTION["GetBoolean"]):
            piece = self.ranges[component, function]
            if piece[1]:
                code = loop.GET_REAL if function == FUNCTION["GetReal"] else loop.GET_WHOLE
                self.call(code, component, function, piece)
                self.inject(piece, at_end=True)

    def step(self, component: int) -> None:
        self.call(loop.STEP, component, FUNCTION["DoStep"])

    def reset(self) -> None:
        """Every FMU back to the state after instantiation."""
        for component in range(len(self.instances)):
            self.call(loop.MODE, component, FUNCTION["Reset"])

    def initialise(self, order: Sequence[int]) -> None:
        """Parameters, initialisation mode, one exchange in ``order`` that settles the start."""
        for component in range(len(self.instances)):
            for kind, function in enumerate((FUNCTION["SetReal"], FUNCTION["SetInteger"], FUNCTION["SetBoolean"])):
                if self.parameter_ranges[component, kind, 1]:
                    code = loop.PARAMETERS if kind == 0 else loop.WHOLE_PARAMETERS
                    self.call(code, component, function, self.parameter_ranges[component, kind])
            self.call(loop.SETUP, component, FUNCTION["SetupExperiment"])
            self.call(loop.MODE, component, FUNCTION["EnterInitializationMode"])
        for component in order:
            self.set(component, at_end=True)
            self.get(component)
        for component in range(len(self.instances)):
            self.call(loop.MODE, component, FUNCTION["ExitInitializationMode"])
        self.connect(-1)

    def sequential(self, sources_first: Sequence[int], followers: Sequence[int]) -> None:
        """Sources with inputs of t_n, all stepped, then all read; followers one by one at t_(n+1)."""
        for component in sources_first:
            self.set(component, at_end=False)
            self.step(component)
        for component in sources_first:
            self.get(component)
        for component in followers:
            self.set(component, at_end=True)
            self.step(component)
            self.get(component)
        self.connect(-1)

    def jacobi(self) -> None:
        """All set from the last exchange, all stepped, all read."""
        components = range(len(self.instances))
        for component in components:
            self.set(component, at_end=False)
        for component in components:
            self.step(component)
        for component in components:
            self.get(component)
        self.connect(-1)


def write_instructions(
    instructions: InstructionList, names: Sequence[str], schedule: Schedule, algorithm: str
) -> tuple[np.ndarray, int, int]:
    """The instruction array, and where resetting and initialising end in it."""
    index = {name: position for position, name in enumerate(names)}
    instructions.reset()
    reset_end = len(instructions.rows)
    instructions.initialise([index[name] for name in schedule.initial_order])
    initial_end = len(instructions.rows)
    if algorithm == "jacobi":
        instructions.jacobi()
    else:
        instructions.sequential(
            [index[name] for name in schedule.sources_first], [index[name] for name in schedule.followers]
        )
    return np.array(instructions.rows, dtype=np.int64).reshape(-1, loop.COLUMNS), reset_end, initial_end
