"""The variables of an FMU, the elements of a vector or matrix brought together."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from ...runtime.system.fmu import Fmu

ELEMENT = re.compile(r"(.+)\[(\d+(?:,\d+)*)\]")
LINE = re.compile(r"(.+) lines? (\d+)(?: to (\d+))?")
CAUSALITIES = ("input", "output", "parameter", "calculatedParameter", "local", "independent")


def variables_of(fmu: Fmu, values: Mapping[str, Any] | None = None, origins: Mapping[str, str] | None = None) -> list:
    """A row for each variable: name, size, causality, type, unit, value, limits, description.

    ``values`` are put in place of the FMU's starts, in its own units, and ``origins`` say where they come from.
    ``size`` is 1, or as the elements are counted: 3, or [2, 3]; ``value`` is then a list, in row order.
    """
    values, origins = values or {}, origins or {}
    rows: dict[str, dict[str, Any]] = {}
    for name, variable in fmu.variables.items():
        whole = ELEMENT.fullmatch(name)
        value = values.get(name, _start(variable))
        if whole is not None and whole.group(1) in rows:
            row = rows[whole.group(1)]
            row["value"].append(value)
            row["size"] = [int(index) for index in whole.group(2).split(",")]
            row["from"] = _join_elements(row["from"], origins.get(name))
            continue
        rows[whole.group(1) if whole else name] = {
            "name": whole.group(1) if whole else name,
            "size": 1,
            "causality": variable.causality or "local",
            "type": variable.type,
            "unit": fmu.unit_of(variable),
            "value": [value] if whole else value,
            "minimum": _number(variable.min),
            "maximum": _number(variable.max),
            "from": origins.get(name),
            "description": variable.description or "",
        }
    variables = list(rows.values())
    for row in variables:
        if isinstance(row["size"], list) and len(row["size"]) == 1:
            row["size"] = row["size"][0]
    return sorted(variables, key=lambda row: CAUSALITIES.index(row["causality"]))


def of_causality(rows: list[dict[str, Any]], *causalities: str) -> list[dict[str, Any]]:
    """The rows of some causalities."""
    return [row for row in rows if row["causality"] in causalities]


def _start(variable: Any) -> Any:
    if variable.start is None:
        return None
    if variable.type == "Real":
        return float(variable.start)
    if variable.type == "Boolean":
        return str(variable.start) in ("true", "1")
    return int(variable.start) if variable.type in ("Integer", "Enumeration") else variable.start


def _number(text: Any) -> float | None:
    return None if text is None else float(text)


def _join_elements(before: str | None, now: str | None) -> str | None:
    """Where the elements of a vector come from, each place once, lines that follow each other as one stretch."""
    if now is None or before is None:
        return before or now
    *remainder, last = before.split("; ")
    stretch, line = LINE.fullmatch(last), LINE.fullmatch(now)
    if stretch is not None and line is not None and stretch.group(1) == line.group(1):
        first, end = int(stretch.group(2)), int(stretch.group(3) or stretch.group(2))
        if first <= int(line.group(2)) <= end:
            return before
        if int(line.group(2)) == end + 1:
            return "; ".join([*remainder, f"{line.group(1)} lines {first} to {end + 1}"])
    return before if now in (*remainder, last) else f"{before}; {now}"
