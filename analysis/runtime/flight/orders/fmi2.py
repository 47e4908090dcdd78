"""Instructions for a component of FMI 2.0: calls for ranges of slots, or direct access to memory of Perilune's FMUs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...instances.fmu_library import FUNCTION_NAMES
from ...loop import codes
from .in_memory import SlotRun, runs_in_memory, with_moves
from .instruction_rows import Callee, InstructionRows, Stretch

TAKES = {"Real": codes.TAKE_REAL, "Integer": codes.TAKE_WHOLE, "Boolean": codes.TAKE_BOOLEAN}
FUNCTION = {name.removeprefix("fmi2"): number for number, name in enumerate(FUNCTION_NAMES) if name.startswith("fmi2")}
# Codes that set and read back parameters: Real, Integer (and Enumeration), Boolean, String.
PARAMETER_CALLS = (
    ((codes.PARAMETERS, "SetReal"), (codes.READ_BACK, "GetReal")),
    ((codes.WHOLE_PARAMETERS, "SetInteger"), (codes.WHOLE_READ_BACK, "GetInteger")),
    ((codes.WHOLE_PARAMETERS, "SetBoolean"), (codes.WHOLE_READ_BACK, "GetBoolean")),
    ((codes.TEXT_PARAMETERS, "SetString"), (codes.TEXT_READ_BACK, "GetString")),
)


class Fmi2Orders:
    """Writer of the calls of one component.

    ``ranges`` [get or set function 0..5] and ``text_ranges`` (String inputs, String outputs) contain the (first, count)
    of slots. ``parameter_ranges`` [type] contain the first parameter, and the numbers of parameters to set, to set
    again in initialisation mode, and to read back. Parameters are read back ``one_by_one`` if a single call cannot
    return all of them. ``recorded`` contains the ranges (function, first slot, count) that are read only to be
    recorded. ``tuned`` contains the ranges of parameters that change during simulation, with the first slot of their
    unchanged values. With ``set_once``, parameters are not set in initialisation mode.
    """

    def __init__(
        self,
        rows: InstructionRows,
        component: int,
        instance: Callee,
        references: np.ndarray,
        ranges: Sequence[Stretch],
        parameter_ranges: Sequence[Sequence[int]],
        text_ranges: Sequence[Stretch],
        recorded: Sequence[tuple[int, int, int]],
        tuned: Sequence[tuple[int, int, int, int]],
        *,
        one_by_one: bool,
        set_once: bool,
    ) -> None:
        self._rows = rows
        self._component = component
        self._instance = instance
        self._references = references
        self._ranges = ranges
        self._parameter_ranges = parameter_ranges
        self._text_ranges = text_ranges
        self._recorded = recorded
        self._tuned = tuned
        self._one_by_one = one_by_one
        self._set_once = set_once

    def reset_bases(self) -> None:
        """Reset the slots of parameters that change during simulation to their unchanged values."""
        for _, first, count, base in self._tuned:
            self._rows.rows.append([codes.COPY, base, 0, first, count, self._component, 0])

    def set(self, begun: int, *, started: bool) -> None:
        """Set all inputs.

        The instructions from index ``begun`` on fill the slots; direct writes to memory may replace them.
        """
        for name in ("SetReal", "SetInteger", "SetBoolean"):
            stretch = self._ranges[FUNCTION[name]]
            if stretch[1]:
                self._rows.inject(stretch)
                if name == "SetReal":
                    self._set_reals(stretch, begun)
                else:
                    self._call(codes.SET_WHOLE, name, stretch)
        if self._text_ranges[0][1]:
            self._call(codes.SET_TEXT, "SetString", self._text_ranges[0])

        for function, first, count, _ in self._tuned if started or not self._set_once else ():
            self._rows.inject((first, count))
            code = codes.SET_REAL if function == FUNCTION["SetReal"] else codes.SET_WHOLE
            self._rows.call(code, self._component, function, (first, count))

    def apply_input_faults(self) -> None:
        """Apply faults to the input slots without setting the inputs."""
        for _, first, count, _ in self._tuned:
            self._rows.inject((first, count))
        for name in ("SetReal", "SetInteger", "SetBoolean"):
            self._rows.inject(self._ranges[FUNCTION[name]])

    def get(self) -> None:
        """Get all outputs."""
        for name in ("GetReal", "GetInteger", "GetBoolean"):
            stretch = self._ranges[FUNCTION[name]]
            if stretch[1]:
                self._get_values(name, stretch)
                self._rows.inject(stretch)
        if self._text_ranges[1][1]:
            self._call(codes.GET_TEXT, "GetString", self._text_ranges[1])

    def read(self) -> None:
        """Get the variables that are only recorded."""
        for function, first, count in self._recorded:
            code = codes.READ_REAL if function == FUNCTION["GetReal"] else codes.GET_WHOLE
            self._rows.call(code, self._component, function, (first, count))

    def step(self, count: int) -> None:
        """Write a step over ``count`` communication steps; 0 also means one."""
        self._call(codes.STEP, "DoStep", (0, count))

    def reset(self) -> None:
        """Terminate and reset the FMU."""
        self._call(codes.MODE, "Terminate")
        self._call(codes.MODE, "Reset")

    def enter_initialization(self) -> None:
        """Set parameters, enter initialisation mode, and set parameters again, since some FMUs lose earlier values."""
        self._parameters(1)
        self._call(codes.SETUP, "SetupExperiment")
        self._call(codes.MODE, "EnterInitializationMode")
        self._parameters(2)

    def exit_initialization(self) -> None:
        self._call(codes.MODE, "ExitInitializationMode")

    def read_back(self) -> None:
        """Read back the parameters of the FMU."""
        self._parameters(3)

    def _parameters(self, column: int) -> None:
        """Write the calls for parameters; ``column`` of their ranges is 1 to set, 2 to set again, 3 to read back."""
        for ranges, (setter, getter) in zip(self._parameter_ranges, PARAMETER_CALLS, strict=True):
            first, count = ranges[0], ranges[column]
            code, name = getter if column == 3 else setter
            size = 1 if column == 3 and self._one_by_one else max(1, count)
            for start in range(first, first + count, size):
                self._call(code, name, (start, size))

    def _set_reals(self, stretch: Stretch, begun: int) -> None:
        """Set Reals from a range of slots, directly in the FMU's memory if possible."""
        runs = self._runs(stretch, "Real", to_set=True)
        rows = self._rows.rows
        moved = with_moves(rows[begun:], runs, self._component, self._instance.address)
        if not runs:
            self._call(codes.SET_REAL, "SetReal", stretch)
        elif moved:
            rows[begun:] = moved
        else:
            self._exchange(codes.PUT_REAL, runs)

    def _get_values(self, name: str, stretch: Stretch) -> None:
        """Get Reals, Integers or Booleans into a range of slots, directly from the FMU's memory if possible."""
        kind = name.removeprefix("Get")
        call = codes.GET_REAL if kind == "Real" else codes.GET_WHOLE
        runs = self._runs(stretch, kind)
        if not runs:
            self._call(call, name, stretch)
        for run in runs:
            self._exchange(TAKES[kind], [run])
            if kind == "Integer":
                self._call(call, name, (run.first, run.size))

    def _exchange(self, code: int, runs: Sequence[SlotRun]) -> None:
        instance = self._instance.address
        self._rows.rows += [[code, run.address, instance, run.first, run.size, self._component, 0] for run in runs]

    def _runs(self, stretch: Stretch, kind: str, *, to_set: bool = False) -> list[SlotRun]:
        """Return the places of a range of slots in the FMU's memory; an empty list during initialisation."""
        if not self._rows.between_steps:
            return []
        first, count = stretch
        return runs_in_memory(self._instance, self._references[first : first + count], first, kind, to_set=to_set)

    def _call(self, code: int, name: str, stretch: Stretch = (0, 0)) -> None:
        self._rows.call(code, self._component, FUNCTION[name], stretch)
