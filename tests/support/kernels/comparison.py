"""Comparison of a block in Python and in C, with the same random values, to the last bit."""

from __future__ import annotations

import math
import re
import struct
import traceback
from pathlib import Path
from random import Random

from perilune.fmus_src.block import Block
from perilune.fmus_src.export.judge.source import label
from perilune.fmus_src.kernel import functions, matrix_types, operations
from perilune.fmus_src.mathlib.network_operator import BINARY_OPERATIONS, SIZE, UNARY_OPERATIONS
from perilune.fmus_src.runtime import BlockInstance, StepError
from perilune.fmus_src.start_values import StartError
from perilune.fmus_src.variables import Input, Parameter, Variable
from tests.support.kernels.native_instance import ERROR, OK, NativeInstance

LONGEST_FLIGHT = 120  # steps between resets
STUCK = 3  # equal rows in a row after which the flight counts as latched

# Spread of values around a start of zero, by unit; 1 where the unit is not here.
SPREAD = {"m": 2e4, "m/s": 500.0, "m/s2": 5.0, "s": 20.0, "N": 2000.0, "rad/s": 0.1, "N.m": 10.0, "kg": 500.0}
WILD = [0.0, -0.0, 1.0, -1.0, 1e-300, 1e200, -1e308, float("inf"), float("-inf"), float("nan")]
# Operators and functions, called at a kernel's line.
LANGUAGE_FILES = (operations.__file__, matrix_types.__file__, functions.__file__)
FAULT = re.compile(r'File "(?P<file>[^"]+)", line (?P<line>\d+): (?P<error>\w+):')


def another(number: float | int | bool, low: float | None, high: float | None) -> float | int | bool:
    """Return another value of the same type within bounds; the same one where there is none."""
    if isinstance(number, bool):
        return not number
    real = [1.1 * number + 0.01, 0.9 * number - 0.01, 0.5 * number]
    options = [number + 1, number - 1] if isinstance(number, int) else real
    return next((each for each in options if (low is None or each >= low) and (high is None or each <= high)), number)


def bits(values: list) -> bytes:
    """Return values as bytes; all NaNs are one."""
    packed = b""
    for value in values:
        if isinstance(value, float):
            packed += b"nan" if value != value else struct.pack("<d", value)
        else:
            packed += struct.pack("<q", value)
    return packed


def draw(
    random: Random, variable: Variable, position: int, h: float, before: float | None = None
) -> float | int | bool:
    """Draw a value that the declaration admits: near the one before, the declared start, or spread around zero."""
    start = variable.elements[position]
    if isinstance(start, bool):
        return random.random() < 0.5
    if variable.name == "sample_period":
        return max(random.choice([0.0, h, h, 2.0 * h]), h if variable.minimum else 0.0)
    if isinstance(start, int) and variable.columns == SIZE:
        return draw_operation(random, *divmod(position, SIZE))
    low = -float("inf") if variable.minimum is None else variable.minimum
    high = float("inf") if variable.maximum is None else variable.maximum
    if isinstance(start, int):
        return random.randint(int(max(low, 0)), int(high) if variable.maximum is not None else start + 5)
    if before is not None and random.random() < 0.95:
        return min(max(before + 0.01 * random.gauss(0.0, SPREAD.get(variable.unit or "", 1.0)), low), high)
    if random.random() < 0.1:
        return start
    value = start * random.uniform(0.5, 1.5)
    if start == 0.0 or random.random() < 0.3:
        value += random.gauss(0.0, SPREAD.get(variable.unit or "", 1.0))
    return min(max(value, low), high)


def draw_operation(random: Random, row: int, column: int) -> int:
    """Draw an entry of a network operator's matrix, one matrix in ten of which is none."""
    if random.random() < 0.1 / SIZE**2:
        return random.choice([4, 22])
    if row == column:
        return random.choice(BINARY_OPERATIONS)
    return random.choice(UNARY_OPERATIONS) if row < column and random.random() < 0.2 else 0


# Blocks that put out levels, targets, constants or what is kept once and for all: their rows repeat by nature.
LEVELS = ("bank_programme", "no_control", "standard_control", "jet_health", "landing_sequencer", "touchdown_monitor")


def only_switches(block: type[Block]) -> bool:
    """Return True if all outputs of a block are Boolean or one of a few levels, so that most
    rows repeat earlier ones."""
    return block.fmu_name in LEVELS or all(
        v.type_name == "Boolean" for v in block.variables.values() if not isinstance(v, Parameter | Input)
    )


class Pair:
    """One block in both forms, called alike."""

    def __init__(self, block: type[Block], random: Random, native: NativeInstance | None = None) -> None:
        self.block = block
        self.random = random
        self.native = native or NativeInstance(block)
        self.references = {
            kind: [
                (reference, variable, position)
                for reference, (variable, position) in enumerate(elements(block))
                if isinstance(variable, kind)
            ]
            for kind in (Parameter, Input)
        }
        self.all = list(range(len(elements(block))))
        self.computed = [
            reference
            for reference, (variable, _) in enumerate(elements(block))
            if not isinstance(variable, Parameter | Input)
        ]
        self.faults: list[str] = []
        self.wild = False

    def set(self, kind: type[Variable], h: float, drift: bool = False) -> None:
        """Draw and set all parameters or inputs."""
        chosen = self.references[kind]
        numbers = [reference for reference, _, _ in chosen]
        held = self.plain.values()
        before = [held[number] if drift else None for number in numbers]
        values = [
            draw(self.random, variable, position, h, value)
            for (_, variable, position), value in zip(chosen, before, strict=True)
        ]
        if self.wild and kind is Input:
            wild = WILD if drift else [each for each in WILD if math.isfinite(each)]  # others are refused at the start
            values = [self.random.choice(wild) if self.wild_now(value) else value for value in values]
        self.plain.set(numbers, values)
        assert self.native.set(numbers, values) == OK

    def wild_now(self, value: float | int | bool) -> bool:
        """Return True if a value is to be replaced by one that no declaration admits."""
        return isinstance(value, float) and self.random.random() < 0.1

    def both(self, plain: object, native: object) -> bool:
        """Return True if both calls succeed; when one faults, the other does so at the same line."""
        before = len(self.native.log)
        error = None
        try:
            plain()  # type: ignore[operator]
        except (ArithmeticError, LookupError, ValueError) as caught:
            error = caught
        status = native()  # type: ignore[operator]
        if error is None:
            assert status == OK, self.native.log[before:]
            return True
        assert status == ERROR, f"Python raised {error!r}"
        message = self.native.log[-1]
        if isinstance(error, StepError | StartError):
            assert message == f"{type(error).__name__}: {error}"
        else:
            frames = traceback.extract_tb(error.__traceback__)
            frame = [each for each in frames if each.filename not in LANGUAGE_FILES][-1]
            collected = FAULT.match(message)
            assert collected, message
            place = (label(Path(frame.filename)), frame.lineno)
            assert (collected["file"], int(collected["line"])) == place, f"{error!r} at {place}, C: {message}"
            assert collected["error"] == type(error).__name__
        self.faults.append(message)
        return False

    def row(self) -> bytes:
        """Return all values, which must be the same; those computed by the block as bytes."""
        plain = self.plain.values()
        native = self.native.get(self.all)
        assert native is not None, self.native.log
        for reference in self.all:
            variable, position = elements(self.block)[reference]
            where = f"{variable.name}[{position}]: Python {plain[reference]!r}, C {native[reference]!r}"
            assert bits([plain[reference]]) == bits([native[reference]]), where
        return bits([native[reference] for reference in self.computed])

    def begin(self, h: float, start_time: float) -> bool:
        """Restart with drawn parameters and inputs, read twice during initialisation."""
        self.native.reset()
        self.plain = BlockInstance(self.block)
        self.plain.start_time = start_time
        self.set(Parameter, h)
        self.set(Input, h)
        self.native.enter(start_time)
        for _ in range(2):
            if not self.both(
                lambda: self.plain.get(self.all), lambda: ERROR if self.native.get(self.all) is None else OK
            ):
                self.row()
                return False
            self.row()
            self.set(Input, h)
        fine = self.both(self.plain.start, self.native.start)
        self.row()
        return fine

    def step(self, t: float, h: float) -> bool:
        """Step once after the inputs have moved a little."""
        self.set(Input, h, drift=True)
        return self.both(lambda: self.plain.do_step(t, h), lambda: self.native.do_step(t, h))


def elements(block: type[Block]) -> list[tuple[Variable, int]]:
    """Return variable and position of every value reference."""
    return [(variable, position) for variable in block.variables.values() for position in range(variable.size)]


def fly(pair: Pair, steps: int) -> tuple[list[bytes], int]:
    """Compare flights of random length for ``steps`` steps; return the rows of all steps, and the number of flights."""
    rows: list[bytes] = []
    flights = 0
    while len(rows) < steps:
        flights += 1
        if flights > 2 * steps:
            return rows, flights
        h = pair.block.default_step * pair.random.choice([0.5, 1.0, 1.0])
        start_time = pair.random.choice([0.0, 12.5])
        if not pair.begin(h, start_time):
            continue
        for n in range(LONGEST_FLIGHT):
            fine = pair.step(start_time + n * h, h)
            rows.append(pair.row())
            latched = len(rows) > STUCK and len(set(rows[-STUCK:])) == 1
            if not fine or latched or len(rows) >= steps:
                break
    return rows, flights
