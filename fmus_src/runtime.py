"""FMI life cycle of one block: initialisation, sampling, complete state.

Used for plain Python objects and for pythonfmu FMUs; the native wrapper implements the same life cycle in C.
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

# Tolerances for communication points at sample instants: importers round t0 + n h, or add up h.
SAMPLE_TOLERANCE = 1e-6  # fraction of a sample period
TIME_TOLERANCE = 1e-15  # fraction of the time
STEP_LIMIT = (
    1_000_000  # largest number of samples, or of steps of a block's internal integration, in a communication step
)
POINT_TOLERANCE = 1e-3  # fraction of a step by which importers may round communication points

SCALAR, VECTOR, LIST, RECORD, MATRIX = (
    -1,
    -2,
    -3,
    -4,
    -5,
)  # replace the index of an element if the access is to the whole variable
Access = tuple[str, int, int, int]  # variable, element or one of the above, first and last position of the values


class StepError(ValueError):
    """Error raised for a communication step that the block cannot perform; the message gives the reason."""


class StateError(ValueError):
    """Error raised if the state of a block cannot be saved; the message gives the reason."""


def integration_step(block_class: type[Block]) -> str | None:
    """Return the name of the variable that limits the step of a block's internal integration, or None."""
    return next((name for name in INTEGRATION_STEPS if name in block_class.variables), None)


class BlockInstance:
    """Instance of a block, with the interface of an FMU towards its importer.

    Value references number the elements of all variables in order of declaration. If a variable is set during
    initialisation, the next `settle` restores states and outputs to their declared starts, checks parameters and
    inputs, and runs `Block.initialize`. Between steps, inputs and parameters that are ``tunable``
    (`export.judge.tunable`) can be set; they take effect in the next step, and outputs do not change earlier.

    Raises the errors of the block's arithmetic (ZeroDivisionError, ValueError, OverflowError); `StepError` if a
    communication step contains too many samples or integration steps; `StartError` if a parameter is outside its
    bounds, or a parameter or input is not finite; `TuningError` if another variable is set between steps, or a tunable
    parameter to a value outside its bounds.
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
        # Cache of the variables for each list of value references, since importers repeat their lists.
        self.known: dict[tuple[int, ...], list[Access]] = {}
        self.tunable = frozenset(tunable)
        self.tuned: dict[tuple[int, ...], list[int]] = {}  # tunable parameters among references, by place in the list

    def accesses(self, references: list[int]) -> list[Access]:
        """Return the variables that value references refer to, in order; consecutive references to all elements of a
        variable give one entry.
        """
        key = tuple(references)
        accesses = self.known.get(key)
        if accesses is None:
            accesses = self.known[key] = self.find_accesses(key)
        return accesses

    def find_accesses(self, references: tuple[int, ...]) -> list[Access]:
        """Compute the result of `accesses` for references not requested before."""
        accesses: list[Access] = []
        position = 0
        while position < len(references):
            first = references[position]
            if first < 0:
                raise IndexError(f"no value reference {first}")
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
        """Return the values at value references, after settling a pending initialisation."""
        if self.unsettled:
            self.settle()
        return self.read(references)

    def read(self, references: list[int]) -> list:
        """Return the values at value references without settling."""
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
        """Return all values in order of value references without settling."""
        return self.read(list(range(len(self.elements))))

    def set(self, references: list[int], values: list) -> None:
        """Set variables by value reference: inputs and, before the start, parameters; later only tunable parameters."""
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
        """Return the positions of tunable parameters among references. Raises TuningError for other non-inputs."""
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
        """Reject tunable parameters outside their bounds, by value reference."""
        ranges = dict(zip(self.checked, self.ranges, strict=True))
        for reference, number in settings:
            name, low, high = ranges.get(reference, ("", -math.inf, math.inf))
            if not low <= number <= high:
                raise TuningError(describe_violation(name, number, low, high))

    def write(self, references: list[int], values: list) -> None:
        """Store values, already of their variables' types, at value references."""
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
        self.block.drop_external()  # before new ones are created, so that memory holds one simulation only
        self.tick = 0
        if START_TIME in self.block.variables:
            self.block.start_time = self.start_time
        self.block.initialize()
        self.unsettled = False

    def check_start_values(self) -> None:
        """Reject parameters outside their bounds, and parameters and inputs that are not finite."""
        for number, (name, low, high) in zip(self.read(self.checked), self.ranges, strict=True):
            if not low <= number <= high:
                raise StartError(describe_violation(name, number, low, high))

    def start(self) -> None:
        """Complete the initialisation."""
        if self.unsettled:
            self.settle()
        self.initialising = False

    def check_point(self, t: float, h: float, here: float) -> None:
        """Reject a step that begins at t (s) although the current time is ``here`` (s)."""
        if abs(t - here) > POINT_TOLERANCE * h + TIME_TOLERANCE * abs(here):
            raise StepError(
                f"the step begins at {t!r} s, and the FMU is at {here!r} s; "
                "continue from there, or restore the state at the step's beginning"
            )

    def check_end(self, t: float, h: float, stop: float) -> None:
        """Reject a step from t over h (s) beyond the stop time (s; infinite if the importer has not set one)."""
        end = t + h
        if end > stop and end > stop + POINT_TOLERANCE * h + TIME_TOLERANCE * abs(end):
            raise StepError(f"the step ends at {end!r} s, after the stop time of {stop!r} s")

    def do_step(self, t: float, h: float) -> None:
        """Advance from t to t + h (s); a sampled block steps at each of its sample instants in that interval only.

        If the interval contains one instant, the block's step has the length of the importer's; if it contains several,
        the block steps from instant to instant, as if the importer stepped by the sample period with constant inputs.
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
        """Reject a communication step of h (s) that contains too many steps of the block's internal integration."""
        if self.integration_step is None:
            return
        longest = getattr(self.block, self.integration_step)
        if h > STEP_LIMIT * longest:
            raise StepError(
                f"communication step {h!r} s holds more than {STEP_LIMIT} integration steps of {longest!r} s; "
                "use a shorter communication step, or a longer internal_step"
            )

    def get_state(self) -> dict[str, Any]:
        """Return the complete state: all variables and life-cycle counters. Raises StateError for external state."""
        if self.block.external:
            names = ", ".join(self.block.external)
            raise StateError(f"{names} of {self.block.fmu_name} is external state, which cannot be saved")
        return {
            "values": self.values(),
            "life_cycle": [self.initialising, self.unsettled, self.start_time, self.tick],
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore a state returned by `get_state`."""
        self.write(list(range(len(self.elements))), state["values"])
        self.initialising, self.unsettled, self.start_time, self.tick = state["life_cycle"]
