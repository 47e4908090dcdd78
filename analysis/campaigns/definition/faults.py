"""Faults of a campaign: a connector, with expressions over draws for value, times and whether the fault acts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ....common.errors import InputError
from ...options.fault import KINDS, Fault
from ...runtime.system.checks import changeable, check_value
from ...runtime.system.network import Network
from ...runtime.system.passing.flight_table import FaultColumns
from .expressions import Expression
from .table import REQUIRED, TomlTable, choice_of, expression, text

KEYS = ("connector", "kind", "value", "start", "end", "when")


@dataclass(frozen=True)
class CampaignFault:
    """Fault declared in [fault.NAME]: a `perilune.Fault` in every trial, or in the trials for which ``when`` is true.

    ``value`` (in the connector's unit; None for freeze), ``start`` and ``end`` (s; None for no end) are expressions
    over drawn and derived values; the value for a Boolean connector may be a bool. ``file`` is named in errors.
    """

    name: str
    file: str
    connector: str
    kind: str
    value: Expression | bool | None
    start: Expression
    end: Expression | None = None
    when: Expression | None = None

    @property
    def formulas(self) -> list[Expression]:
        return [part for part in (self.value, self.start, self.end, self.when) if isinstance(part, Expression)]

    def where(self, key: str) -> tuple[str, str]:
        """Return file and element of one of the fault's keys, for errors."""
        return self.file, f"fault.{self.name}.{key}"

    def __str__(self) -> str:
        value = "" if self.value is None else f":{_write_number(self.value)}"
        end = "" if self.end is None else f"..{_write_number(self.end)}"
        when = "" if self.when is None else f" when {_write_number(self.when)}"
        return f"{self.name}: {self.connector}={self.kind}{value}@{_write_number(self.start)}{end}{when}"


def _write_number(part: Expression | bool) -> str:
    return str(part).lower() if isinstance(part, bool) else part.text


def read_fault(name: str, table: TomlTable) -> CampaignFault:
    """Return the fault declared in the table [fault.NAME]. Raises InputError."""
    table.only(KEYS)
    kind = table.get("kind", choice_of(*KINDS))
    if kind == "freeze" and "value" in table.content:
        raise table.error("value", "a freeze has no value", "omit the value: a freeze holds the current value")
    return CampaignFault(
        name=name,
        file=table.file,
        connector=table.get("connector", text),
        kind=kind,
        value=table.get("value", _value, None if kind == "freeze" else REQUIRED),
        start=table.get("start", _formula),
        end=table.get("end", _formula, None),
        when=table.get("when", expression, None),
    )


def _value(table: TomlTable, key: str, value: object) -> Expression | bool:
    return value if isinstance(value, bool) else _formula(table, key, value)


def _formula(table: TomlTable, key: str, value: object) -> Expression:
    """Return a finite number, or the expression in a text."""
    if isinstance(value, str):
        return expression(table, key, value)
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise table.error(
            key, f"{value!r} is not a finite number", 'write a number, or an expression such as "t_fail + 10"'
        )
    return expression(table, key, repr(value))


@dataclass(frozen=True)
class DrawnFault:
    """Fault of a campaign in consecutive trials, as arrays with one entry for each trial.

    ``flies`` is True for trials in which the fault acts. In other trials ``value`` (in the connector's unit), ``start``
    and ``end`` (s) are nan. ``end`` is inf for a fault without an end. The value for a Boolean is a bool array; a
    freeze has no ``value``.
    """

    declared: CampaignFault
    flies: np.ndarray
    value: np.ndarray | None
    start: np.ndarray
    end: np.ndarray

    def in_trial(self, trial: int) -> Fault | None:
        """Return the fault in one of the trials, counted from 0, or None if it does not act in it."""
        if not self.flies[trial]:
            return None
        value = 0.0 if self.value is None else self.value[trial].item()
        name, kind = self.declared.connector, self.declared.kind
        return Fault(name, kind, value, float(self.start[trial]), float(self.end[trial]))

    def columns_of(self, rows: slice) -> FaultColumns:
        """Return the fault in a range of these trials."""
        value = np.zeros(self.flies.size) if self.value is None else self.value.astype(np.float64)
        return FaultColumns(self.flies[rows], value[rows], self.start[rows], self.end[rows])

    def columns(self) -> dict[str, np.ndarray]:
        """Return the fault's columns in the table of trials, by name."""
        name = f"fault.{self.declared.name}"
        value = {} if self.value is None else {f"{name}.value": np.where(self.flies, self.value, math.nan)}
        return {name: self.flies, **value, f"{name}.start": self.start, f"{name}.end": self.end}


def fault_columns(fault: Fault, flights: int) -> FaultColumns:
    """Return a fault that is the same in all ``flights`` simulations."""
    value, start, end = (np.full(flights, float(number)) for number in (fault.value, fault.start, fault.stop))
    return FaultColumns(np.ones(flights, dtype=bool), value, start, end)


def fault_of_trials(declared: CampaignFault, draws: Mapping[str, np.ndarray], numbers: range) -> DrawnFault:
    """Evaluate a fault for consecutive trials with these ``numbers``, from their ``draws``.

    Raises InputError if, in a trial in which the fault acts, an expression is not finite or the window is empty.
    """
    trials = len(numbers)
    everywhere = np.ones(trials, dtype=bool)

    def values(key: str, formula: Expression, flies: np.ndarray) -> np.ndarray:
        column = np.broadcast_to(formula.evaluate(draws), (trials,))
        wrong = np.flatnonzero(flies & ~np.isfinite(column))
        if wrong.size:
            problem = f"{formula.text!r} is {column[wrong[0]]} in trial {numbers[wrong[0]]}"
            raise InputError(*declared.where(key), problem, "every value must be finite")
        return np.where(flies, column, math.nan)

    when = declared.when
    flies = everywhere if when is None else values("when", when, everywhere) != 0.0
    value = declared.value
    start = values("start", declared.start, flies)
    end = np.where(flies, math.inf, math.nan) if declared.end is None else values("end", declared.end, flies)
    empty = np.flatnonzero(flies & ~(start < end))
    if empty.size:
        problem = (
            f"{end[empty[0]]:.10g} s is not after the start, {start[empty[0]]:.10g} s, in trial {numbers[empty[0]]}"
        )
        raise InputError(*declared.where("end"), problem, "give an end after the start")
    column = values("value", value, flies) if isinstance(value, Expression) else None
    if isinstance(value, bool):
        column = np.full(trials, value)
    return DrawnFault(declared, flies, column, start, end)


def check_drawn(fault: DrawnFault, network: Network) -> None:
    """Reject a fault that the system cannot have. Raises InputError."""
    declared = fault.declared
    variable = changeable(network, declared.connector, declared.where("connector"), tunable=True)
    for value in () if fault.value is None else np.unique(fault.value[fault.flies]).tolist():
        check_value(variable, declared.kind, value, declared.where("value"))
