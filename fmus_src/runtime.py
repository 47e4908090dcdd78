"""The FMI life cycle of one block: initialisation, sampling, complete state.

Shared by the plain Python object and the pythonfmu FMU; the native wrapper does the same in C.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from .block import Block, Input, Output, Parameter, State
from .kernel.matrix_types import Matrix
from .kernel.records import Record
from .kernel.vector_types import vector
from .roles import INTEGRATION_STEPS, SAMPLE_PERIOD, START_TIME
from .start_values import StartError, TuningError, describe_violation, start_range

# How far a communication point may miss a sample instant: importers round t0 + n h, or add up h.
SAMPLE_TOLERANCE = 1e-6  # of a sample period
TIME_TOLERANCE = 1e-15  # of the time
STEP_LIMIT = 1_000_000  # samples, and steps of a block's own integration, in a communication step
POINT_TOLERANCE = 1e-3  # of a step: communication points carry the rounding of whoever adds them up

SCALAR, VECTOR, LIST, RECORD, MATRIX = -1, -2, -3, -4, -5  # in place of an element's number: all of a variable
Access = tuple[str, int, int, int]  # variable, element or one of the above, place of its values and their end


class StepError(ValueError):
    """A communication step that the block cannot take; the message says why."""


class StateError(ValueError):
    """A block's state cannot be saved; the message says why."""


def integration_step(block_class: type[Block]) -> str | None:
    """Return the name of the variable that is the longest step of a block's own integration, if it has one."""
    return next((name for name in INTEGRATION_STEPS if name in block_class.variables), None)


class Component:
    """One instance of a block, driven as an FMI importer drives an FMU.

    Setting a variable during initialisation marks the instance; the next `settle` puts states
    and outputs back to their declared starts, checks parameters and inputs and runs `Block.initialize` again. Value
    references number the elements of all variables in order of declaration. Between steps inputs can be set, and the
    parameters that are ``tunable`` (`export.judge.tunable`), which the next step reads: outputs stand till then.

    Raises what the block's arithmetic raises (ZeroDivisionError, ValueError, OverflowError) and
    `StepError` when too many samples, or integration steps, fall into a communication step; `StartError`
    where a parameter is outside its bounds, or a parameter or an input is not finite; `TuningError` where another
    variable is set between steps, or a tunable parameter to a value outside its bounds.
    """

    def __init__(self, block_class: type[Block], tunable: Iterable[str] = ()) -> None:
        self.block: Any = block_class()
        self.sampled = SAMPLE_PERIOD in block_class.variables
        self.integration_step = integration_step(block_class)
        self.initialising = True
        self.unsettled = True
        self.start_time = 0.0
        self.tick = 0
        self.elements = [
            (name, index if variable.is_array else SCALAR)
            for name, variable in block_class.variables.items()
            for index in range(variable.size)
        ]
        self.checked: list[int] = []  # value references of parameters and inputs that are numbers
        self.ranges: list[tuple[str, float, float]] = []  # their names, least and largest values
        first = 0
        for variable in block_class.variables.values():
            if isinstance(variable, Parameter | Input) and variable.type_name != "Boolean":
                self.checked += range(first, first + variable.size)
                self.ranges += [(name, *start_range(variable)) for name in variable.element_names()]
            first += variable.size
        # For each list of value references that was asked for: the variables behind it. Importers repeat theirs.
        self.known: dict[tuple[int, ...], list[Access]] = {}
        self.tunable = frozenset(tunable)
        self.tuned: dict[tuple[int, ...], list[int]] = {}  # tunable parameters among references, by place in the list

    def accesses(self, references: list[int]) -> list[Access]:
        """Return variables behind value references, in order; those of which all elements are named come as wholes."""
        key = tuple(references)
        accesses = self.known.get(key)
        if accesses is None:
            accesses = self.known[key] = self.find_accesses(key)
        return accesses

    def find_accesses(self, references: tuple[int, ...]) -> list[Access]:
        """Compute the result of `accesses`."""
        accesses: list[Access] = []
        position = 0
        while position < len(references):
            first = references[position]
            if first < 0:
                raise IndexError(f"there is no value reference {first}")
            name, index = self.elements[first]
            variable = self.block.variables[name]
            end = position + variable.size
            whole = index == 0 and references[position:end] == tuple(range(first, first + variable.size))
            if whole:
                index = RECORD if variable.record else VECTOR if variable.is_vector else LIST
                index = MATRIX if variable.shape else index
            else:
                end = position + 1
            accesses.append((name, index, position, end))
            position = end
        return accesses

    def get(self, references: list[int]) -> list:
        """Return values at these value references, settled first if initialisation is under way."""
        if self.unsettled:
            self.settle()
        return self.read(references)

    def read(self, references: list[int]) -> list:
        """Return values at these value references, as they are."""
        attributes = self.block.__dict__
        values: list = []
        for name, index, _, _ in self.accesses(references):
            if index == SCALAR:
                values.append(attributes[name])
            elif index in (VECTOR, RECORD, MATRIX):
                values += attributes[name].elements()
            elif index == LIST:
                values += attributes[name]
            else:
                value = attributes[name]
                values.append((value.elements() if isinstance(value, Record | Matrix) else value)[index])
        return values

    def values(self) -> list:
        """Return all values in order of value references, as they are."""
        return self.read(list(range(len(self.elements))))

    def set(self, references: list[int], values: list) -> None:
        """Set inputs or parameters by value reference; between steps inputs and tunable parameters."""
        if self.initialising:
            self.write(references, values)
            self.unsettled = True
            return
        tuned = self.tuned.get(tuple(references))
        if tuned is None:
            tuned = self.tuned[tuple(references)] = self.find_tuned(references)
        if tuned:
            self.check_tuned([(references[k], values[k]) for k in tuned if k < len(values)])
        self.write(references, values)

    def find_tuned(self, references: list[int]) -> list[int]:
        """Return positions of tunable parameters among references. Raises TuningError for fixed and computed ones."""
        tuned = []
        for k, reference in enumerate(references):
            name, index = self.elements[reference]
            variable = self.block.variables[name]
            if name in self.tunable:
                tuned.append(k)
            elif not isinstance(variable, Input):
                fixed = isinstance(variable, Parameter)
                why = "a parameter, fixed after initialisation" if fixed else "computed and cannot be set"
                raise TuningError(f"{variable.element_names()[max(index, 0)]} is {why}")
        return tuned

    def check_tuned(self, settings: list[tuple[int, Any]]) -> None:
        """Refuse parameters outside their bounds, by value reference."""
        ranges = dict(zip(self.checked, self.ranges, strict=True))
        for reference, number in settings:
            name, low, high = ranges.get(reference, ("", -math.inf, math.inf))
            if not low <= number <= high:
                raise TuningError(describe_violation(name, number, low, high))

    def write(self, references: list[int], values: list) -> None:
        """Put values, which have their variables' types, where the value references say."""
        if len(references) != len(values):
            raise ValueError(f"{len(values)} values for {len(references)} value references")
        attributes = self.block.__dict__
        for name, index, position, end in self.accesses(references):
            if index == SCALAR:
                attributes[name] = values[position]
            elif index == VECTOR:
                attributes[name] = vector(*values[position:end])
            elif index == RECORD:
                attributes[name] = type(attributes[name]).of_elements(values[position:end])
            elif index == MATRIX:
                attributes[name].rows = Matrix.of_elements(values[position:end], attributes[name].shape[1]).rows
            elif index == LIST:
                attributes[name][:] = values[position:end]
            else:
                value = attributes[name]
                changed = list(value.elements() if isinstance(value, Record | Matrix) else value)
                changed[index] = values[position]
                setattr(self.block, name, changed)

    def settle(self) -> None:
        """Run the block's initialisation from the declared starts of states and outputs."""
        for name, variable in self.block.variables.items():
            if isinstance(variable, State | Output):
                setattr(self.block, name, variable.start)
        self.check_start_values()
        self.block.drop_external()  # before new ones: two simulations at once would take twice the memory
        self.tick = 0
        if START_TIME in self.block.variables:
            self.block.start_time = self.start_time
        self.block.initialize()
        self.unsettled = False

    def check_start_values(self) -> None:
        """Refuse parameters outside their bounds, and parameters and inputs that are not finite."""
        for number, (name, low, high) in zip(self.read(self.checked), self.ranges, strict=True):
            if not low <= number <= high:
                raise StartError(describe_violation(name, number, low, high))

    def start(self) -> None:
        """Leave initialisation."""
        if self.unsettled:
            self.settle()
        self.initialising = False

    def check_point(self, t: float, h: float, here: float) -> None:
        """Refuse a step that begins at t (s) where the FMU is elsewhere, ``here`` (s)."""
        if abs(t - here) > POINT_TOLERANCE * h + TIME_TOLERANCE * abs(here):
            raise StepError(
                f"the step begins at {t!r} s, and the FMU is at {here!r} s; "
                "go on from there, or restore its state of then"
            )

    def check_end(self, t: float, h: float, stop: float) -> None:
        """Refuse a step from t (s) over h (s) past the stop time (s; infinite: the importer has not said it)."""
        end = t + h
        if end > stop and end > stop + POINT_TOLERANCE * h + TIME_TOLERANCE * abs(end):
            raise StepError(f"the step ends at {end!r} s, after the stop time of {stop!r} s")

    def do_step(self, t: float, h: float) -> None:
        """Advance from t to t + h (s); a sampled block steps at its sample instants only, at each of them.

        With one instant the block's step is the importer's; with several there is a step from each instant to the
        next, as of an importer that steps by the period and holds its inputs.
        """
        period = self.block.sample_period if self.sampled else 0.0
        if not period > 0.0:
            self.check_integration(h)
            self.block.step(t, h)
            return
        margin = SAMPLE_TOLERANCE * period + TIME_TOLERANCE * abs(t + h)
        due = self.start_time + (self.tick + 1) * period
        if t + h < due - margin:
            return
        if t + h < due + period - margin:
            self.tick += 1
            self.check_integration(h)
            self.block.step(t, h)
            return
        last = (t + h + margin - self.start_time) / period
        if last - self.tick >= STEP_LIMIT + 1:
            raise StepError(
                f"communication step {h!r} s holds more than {STEP_LIMIT} samples of sample_period {period!r} s; "
                "use a shorter communication step, or a longer period"
            )
        self.check_integration(h)
        for tick in range(self.tick, int(last)):
            self.tick = tick + 1
            self.block.step(self.start_time + tick * period, period)

    def check_integration(self, h: float) -> None:
        """Refuse a communication step of h (s) with too many steps of the block's own integration."""
        if self.integration_step is None:
            return
        longest = getattr(self.block, self.integration_step)
        if h > STEP_LIMIT * longest:
            raise StepError(
                f"communication step {h!r} s holds more than {STEP_LIMIT} integration steps of {longest!r} s; "
                "use a shorter communication step, or a longer internal_step"
            )

    def get_state(self) -> dict[str, Any]:
        """Return complete state: every variable and the life-cycle counters. Raises StateError for a block with
        more."""
        if self.block.external:
            names = ", ".join(self.block.external)
            raise StateError(f"{names} of {self.block.fmu_name} is external state, which cannot be saved")
        return {
            "values": self.values(),
            "life_cycle": [self.initialising, self.unsettled, self.start_time, self.tick],
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore what `get_state` returned."""
        self.write(list(range(len(self.elements))), state["values"])
        self.initialising, self.unsettled, self.start_time, self.tick = state["life_cycle"]
