"""Tables of a simulation's values: final values of the most important signals, and statistics of all."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .....fmus_src.roles import STATUS
from ....runtime.flight.results import FlightResult
from ....runtime.ssp.types import WHOLE
from ...cell import Cell, Faint, Phrase, Quantity, QuantityVector
from ...common.quantities import display_unit
from ...common.signals import axes_of, distinct, signal_groups
from ...model import Missing, Node, Table

MOST_KEYS = 12  # largest number of final values listed if no signal has a known name
KEY_VECTORS = ("position", "velocity")


class KeyValue(NamedTuple):
    """Final values of a signal or of a vector's elements, with a ``note`` on axes, magnitude or maximum."""

    label: str
    note: str
    values: list[float]
    unit: str | None


def key_values(result: FlightResult) -> list[KeyValue]:
    """Return the final values of the most important signals.

    These are the system's connectors, positions and velocities with their magnitudes (without inputs that repeat them),
    and the highest status of each component. Without any of these all signals are included, if they are at most
    `MOST_KEYS`.
    """
    if not result.time.size:
        return []
    final, axes = result.final(), axes_of(result)
    rows: list[KeyValue] = []
    groups = signal_groups(result)
    originals = distinct(groups, result)
    for group in sorted(groups, key=lambda group: bool(group.component)):
        if not group.component:
            rows += [KeyValue(name, axes.get(name, ""), [final[name]], group.unit) for name in group.names]
        elif group.variable in KEY_VECTORS and group.is_real and originals[group] == group:
            values = [final[name] for name in group.names]
            rows.append(KeyValue(group.label, group.axes, values, group.unit))
            if len(values) > 1:
                rows.append(KeyValue(group.label, "magnitude", [float(np.linalg.norm(values))], group.unit))
        elif group.variable == STATUS and group.type in WHOLE:
            rows.append(KeyValue(group.label, "maximum over run", [int(group.values(result).max())], group.unit))
    others = [group for group in groups if originals[group] == group]
    if not rows and len(others) <= MOST_KEYS:
        rows = [KeyValue(each.label, each.axes, [final[name] for name in each.names], each.unit) for each in others]
    return rows


def final_values(result: FlightResult) -> Node:
    """Return the table of key values, or the reason why there is none."""
    rows = [
        (row.label, Faint(row.note), QuantityVector(row.values, row.unit), display_unit(row.unit))
        for row in key_values(result)
    ]
    if rows:
        return Table(("signal", "", "value", "unit"), rows, style="")
    if result.time.size:
        return Missing("no position, velocity or status is recorded; all final values are listed under All signals")
    return Missing("the run ended before its first sample; there are no values")


def signal_table(result: FlightResult) -> Table:
    """Return the table of the initial, minimum, maximum and final value of every signal."""
    heads = ("signal", "unit", "initial", "minimum", "maximum", "final")
    rows = [_signal_row(name, result) for name in result.signals] if result.time.size else []
    return Table(heads, rows, style="signals")


def _signal_row(name: str, result: FlightResult) -> list[Cell]:
    convert = {"Integer": int, "Enumeration": int, "Boolean": bool}
    values, type_name, unit = result.signals[name], result.types[name], result.units[name]
    kind = convert.get(type_name, float)
    axis = axes_of(result).get(name, "")
    label: Cell = Phrase([name, " ", Faint(axis)], is_unbroken=False) if axis else name
    unit_text = display_unit(unit) or ("" if type_name == "Real" else type_name)
    numbers = (values[0], np.min(values), np.max(values), values[-1])
    return [label, unit_text, *(Quantity(kind(number), unit, 6, is_bare=True) for number in numbers)]
