"""Table of numbers by trial, computed elsewhere from the inputs of these trials, and its agreement with them.

A row has the trial's number, the hash of its inputs and numbers; comments before them name the inputs:

    # made by: perilune design bounds SYSTEM --campaign NAME --store
    # input: mass = plant.initial_mass
    trial,inputs,propellant
    0,3f0c9b1a5d2e4c77,257.005382
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ....common.errors import InputError, suggestion
from .interfaces import Formula

TRIAL, INPUTS = "trial", "inputs"  # the first two columns
DIGITS = 16  # hexadecimal digits of SHA-256
COMMAND, INPUT = "# made by: ", "# input: "
WRITE = "compute the table again; perilune design bounds computes the table of [lookup.bound]"

InputColumns = Mapping[str, Sequence[np.ndarray]]  # one or more arrays (trials,) by name


def input_hashes(columns: InputColumns) -> list[str]:
    """Return a hash of each trial's exact input values, which does not depend on the order of the inputs."""
    rows = {name: np.stack(values, axis=1).tolist() for name, values in sorted(columns.items())}
    trials = len(next(iter(rows.values())))
    hashes = []
    for trial in range(trials):
        text = "\n".join(f"{name} {' '.join(number.hex() for number in row[trial])}" for name, row in rows.items())
        hashes.append(hashlib.sha256(text.encode()).hexdigest()[:DIGITS])
    return hashes


@dataclass(frozen=True)
class LookupTable:
    """Table of ``columns``, arrays (trials,) by name, with the ``hashes`` of the trials' inputs.

    ``inputs`` contains the formulas of the inputs as texts by name. ``command`` is the command that wrote the table, or
    "" if unknown.
    """

    columns: Mapping[str, np.ndarray]
    hashes: Sequence[str]
    inputs: Mapping[str, str]
    command: str = ""

    @property
    def remedy(self) -> str:
        """Remedy for a table that was computed for other trials than the campaign's."""
        return f"write it again: {self.command}" if self.command else WRITE

    def write(self, decimals: Mapping[str, int]) -> bytes:
        """Return the table as CSV; ``decimals`` are the numbers of decimals of the columns."""
        lines = [f"{COMMAND}{self.command}"] if self.command else []
        lines += [f"{INPUT}{name} = {text}" for name, text in self.inputs.items()]
        lines.append(",".join((TRIAL, INPUTS, *self.columns)))
        for trial, hashed in enumerate(self.hashes):
            numbers = (f"{column[trial]:.{decimals[name]}f}" for name, column in self.columns.items())
            lines.append(",".join((str(trial), hashed, *numbers)))
        return ("\n".join(lines) + "\n").encode()


def read_lookup_table(content: bytes, file: str) -> LookupTable:
    """Return the table in a CSV file. Raises InputError."""
    try:
        lines = content.decode("utf-8").splitlines()
    except UnicodeDecodeError as error:
        raise InputError(file, f"byte {error.start}", "not UTF-8", WRITE) from error
    comments = [line for line in lines if line.startswith("#")]
    commands = [line.removeprefix(COMMAND).strip() for line in comments if line.startswith(COMMAND)]
    pairs = (line.removeprefix(INPUT).partition(" = ") for line in comments if line.startswith(INPUT))
    rows = [line.split(",") for line in lines if line.strip() and not line.startswith("#")]
    head = rows.pop(0) if rows else []
    if head[:2] != [TRIAL, INPUTS] or len(set(head)) < len(head) or len(head) < 3:
        raise InputError(file, "", f"the header is not {TRIAL},{INPUTS} followed by distinct names", WRITE)
    numbers = np.empty((len(rows), len(head) - 2))
    for trial, row in enumerate(rows):
        if len(row) != len(head) or row[0] != str(trial):
            raise InputError(
                file, f"row {trial}", f"the row does not contain trial {trial} and {len(head)} columns", WRITE
            )
        try:
            numbers[trial] = [float(text) for text in row[2:]]
        except ValueError as error:
            raise InputError(file, f"row {trial}", f"not numbers: {', '.join(row[2:])}", WRITE) from error
    columns = dict(zip(head[2:], numbers.T, strict=True))
    return LookupTable(
        columns, [row[1] for row in rows], {name: text for name, _, text in pairs}, "".join(commands[:1])
    )


@dataclass(frozen=True)
class Lookup:
    """Numbers of trials under a ``name`` that metrics can use: a ``column`` of a table.

    ``inputs`` contains, by name, one or more formulas over draws, derived values and parameters from which the table
    was computed. ``file`` is the table's path as stated in the campaign's file ``origin``, ``label`` its name in
    messages; ``content`` is None if the file is missing.
    """

    name: str
    column: str
    inputs: Mapping[str, tuple[Formula, ...]]
    origin: str
    file: str
    label: str = field(repr=False)
    content: bytes | None = field(repr=False)

    @property
    def element(self) -> str:
        """Path of the lookup in the campaign's file."""
        return f"lookup.{self.name}"

    @property
    def formulas(self) -> list[Formula]:
        """Formulas of all inputs."""
        return [formula for formulas in self.inputs.values() for formula in formulas]

    @cached_property
    def table(self) -> LookupTable:
        """The lookup's table. Raises InputError if the file or the column is missing."""
        if self.content is None:
            raise InputError(self.origin, f"{self.element}.file", f"no file {self.file}", WRITE)
        table = read_lookup_table(self.content, self.label)
        if self.column not in table.columns:
            remedy = suggestion(self.column, table.columns)
            raise InputError(
                self.origin, f"{self.element}.column", f"{self.label} has no column {self.column!r}", remedy
            )
        return table

    def numbers_of(self, trials: range) -> np.ndarray:
        """Return the numbers of consecutive trials. Raises InputError if the table does not contain all of them."""
        rows = len(self.table.hashes)
        if trials.stop > rows:
            problem = f"has {rows} trials, but the campaign has {trials.stop} or more"
            raise InputError(self.label, "", problem, f"give `trials` at most {rows}, or {self.table.remedy}")
        return self.table.columns[self.column][trials.start : trials.stop]

    def input_columns(self, known: Mapping[str, np.ndarray | float], trials: int) -> InputColumns:
        """Return the inputs of ``trials`` trials; ``known`` contains draws, derived values and parameters by name."""
        return {
            name: [np.array(np.broadcast_to(formula.evaluate(known), (trials,)), dtype=float) for formula in formulas]
            for name, formulas in self.inputs.items()
        }

    def check(self, columns: InputColumns, trials: range, variant: str) -> None:
        """Reject a table that was computed from inputs other than these ``columns`` of a variant. Raises InputError."""
        different = sorted(self.table.inputs.keys() ^ self.inputs.keys())
        if different:
            problem = f"{', '.join(different)}: occurs in only one of the table and [{self.element}.inputs]"
            raise InputError(self.label, "input", problem, self.table.remedy)
        hashes = self.table.hashes[trials.start : trials.stop]
        for trial, stored, actual in zip(trials, hashes, input_hashes(columns), strict=True):
            if stored != actual:
                problem = f"computed for inputs ({', '.join(self.inputs)}) that differ from the inputs of {variant}"
                raise InputError(self.label, f"trial {trial}", problem, self.table.remedy)
