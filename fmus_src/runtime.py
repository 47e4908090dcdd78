"""The FMI life cycle of one block: initialisation, sampling, complete state.

Shared by the plain Python object and the pythonfmu FMU; the native wrapper does the same in C.
"""

from __future__ import annotations

from typing import Any

from .block import Block, Output, State

# How far a communication point may miss a sample instant: importers round t0 + n h, or add up h.
SAMPLE_TOLERANCE = 1e-6  # of a sample period
TIME_TOLERANCE = 1e-15  # of the time


class StepError(ValueError):
    """A communication step that the block cannot take; the message says why."""


class Component:
    """One instance of a block, driven as an FMI importer drives an FMU.

    Setting a variable during initialisation marks the instance; the next `settle` puts states
    and outputs back to their declared starts and runs `Block.initialize` again. Value
    references number the elements of all variables in order of declaration.

    Raises what the block's arithmetic raises (ZeroDivisionError, ValueError, OverflowError) and
    `StepError` when more than one sample falls into a communication step.
    """

    def __init__(self, block_class: type[Block]) -> None:
        self.block: Any = block_class()
        self.sampled = "sample_period" in block_class.variables
        self.initialising = True
        self.unsettled = True
        self.start_time = 0.0
        self.tick = 0
        # Each element as (container, key): lists are never rebound, scalars live in the instance's dict.
        self.slots: list[tuple[Any, Any]] = []
        for name, variable in block_class.variables.items():
            if variable.is_vector:
                self.slots += [(getattr(self.block, name), index) for index in range(variable.size)]
            else:
                self.slots.append((self.block.__dict__, name))

    def get(self, references: list[int]) -> list:
        """Values at the given value references, settled first if initialisation is under way."""
        if self.unsettled:
            self.settle()
        slots = self.slots
        return [container[key] for container, key in [slots[reference] for reference in references]]

    def set(self, references: list[int], values: list) -> None:
        """Set inputs or parameters by value reference."""
        slots = self.slots
        for reference, value in zip(references, values, strict=True):
            container, key = slots[reference]
            container[key] = value
        if self.initialising:
            self.unsettled = True

    def settle(self) -> None:
        """Run the block's initialisation from the declared starts of states and outputs."""
        for name, variable in self.block.variables.items():
            if isinstance(variable, State | Output):
                if isinstance(variable.start, list):
                    getattr(self.block, name)[:] = variable.start
                else:
                    setattr(self.block, name, variable.start)
        self.tick = 0
        if "start_time" in self.block.variables:
            self.block.start_time = self.start_time
        self.block.initialize()
        self.unsettled = False

    def start(self) -> None:
        """Leave initialisation."""
        if self.unsettled:
            self.settle()
        self.initialising = False

    def do_step(self, t: float, h: float) -> None:
        """Advance from t to t + h (s); a sampled block steps at its sample instants only."""
        if self.sampled and self.block.sample_period > 0.0:
            period = self.block.sample_period
            margin = SAMPLE_TOLERANCE * period + TIME_TOLERANCE * abs(t + h)
            due = self.start_time + (self.tick + 1) * period
            if t + h < due - margin:
                return
            if t + h >= due + period - margin:
                raise StepError(
                    f"communication step {h!r} s holds more than one sample of sample_period {period!r} s; "
                    "use a communication step no longer than the period, or a longer period"
                )
            self.tick += 1
        self.block.step(t, h)

    def get_state(self) -> dict[str, Any]:
        """Complete state: every variable and the life-cycle counters."""
        return {
            "values": [container[key] for container, key in self.slots],
            "life_cycle": [self.initialising, self.unsettled, self.start_time, self.tick],
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore what `get_state` returned."""
        for (container, key), value in zip(self.slots, state["values"], strict=True):
            container[key] = value
        self.initialising, self.unsettled, self.start_time, self.tick = state["life_cycle"]
