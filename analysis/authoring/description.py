"""Description of a prepared system: components, their variables and replacements, connections, files."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..runtime.system.fmu import Fmu
from ..runtime.system.prepared import PreparedSystem
from ..stability.request.loop_declaration import read_declaration
from .fits import find_fitting_fmus

ELEMENT = re.compile(r"(.+)\[(\d+(?:,\d+)*)\]")
LINE = re.compile(r"(.+) lines? (\d+)(?: to (\d+))?")
CAUSALITIES = ("input", "output", "structuralParameter", "parameter", "calculatedParameter", "local", "independent")


def variables_of(fmu: Fmu, values: Mapping[str, Any] | None = None, origins: Mapping[str, str] | None = None) -> list:
    """Return a row for each variable: name, size, causality, tunable, type, unit, value, limits, description, items.

    ``values``, in the variables' units, replace the start values of the FMU; ``origins`` are the places at which they
    are set. ``size`` is 1, the number of elements of a vector, or [rows, columns] of a matrix; the ``value`` of an
    array is a list in row-major order.
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
            "tunable": variable.is_tunable,
            "type": variable.type,
            "unit": variable.unit,
            "value": [value] if whole else value,
            "minimum": _number(variable.minimum),
            "maximum": _number(variable.maximum),
            "from": origins.get(name),
            "description": variable.description or "",
            "items": [
                {"name": label, "value": number, "description": variable.meanings.get(label, "")}
                for label, number in variable.items.items()
            ],
        }
    variables = list(rows.values())
    for row in variables:
        if isinstance(row["size"], list) and len(row["size"]) == 1:
            row["size"] = row["size"][0]
    return sorted(variables, key=lambda row: CAUSALITIES.index(row["causality"]))


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
    """Return the distinct origins of a vector's elements as one text, with consecutive lines as a range."""
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


def describe_system(prepared: PreparedSystem) -> dict[str, Any]:
    """Return the components, connections, system connectors and file names of a prepared system. Times are in s."""
    files = prepared.archive.files
    return {
        "system": prepared.archive.name,
        "file": prepared.network.file,
        "step": prepared.step,
        "stop_time": prepared.start + prepared.steps * prepared.step,
        "parameter_sets": sorted(Path(name).name for name in files if name.endswith(".ssv")),
        "campaigns": sorted(prepared.archive.campaign_names()),
        "variants": prepared.archive.variants(),
        "frames": {name: list(axes) for name, axes in prepared.network.frames.items()},
        "loops": [loop.name for loop in read_declaration(prepared.network.description).loops],
        "connectors": [
            {
                "name": node.name,
                "kind": node.kind,
                "type": node.type_name,
                "unit": node.unit.name if node.unit else None,
            }
            for node in prepared.network.nodes.values()
            if node.component is None
        ],
        "components": [_component(prepared, name) for name in prepared.network.fmus],
        "connections": connections(prepared),
        "cut_at_start": list(prepared.schedule.feedthrough.cuts),
    }


def _component(prepared: PreparedSystem, name: str) -> dict[str, Any]:
    network, settings = prepared.network, prepared.settings
    fmu, feedthrough = network.fmus[name], prepared.schedule.feedthrough
    demanded = [
        (node.variable, node.kind, node.type_name or "Real")
        for node in network.nodes.values()
        if node.component == name
    ]
    assigned = [variable for component, variable in settings.variables if component == name]
    demanded += [(key, fmu.variables[key].causality, fmu.variables[key].type) for key in assigned]
    return {
        "name": name,
        "fmu": fmu.name,
        "description": fmu.description.description or "",
        "feedthrough": any(feedthrough.stepping[name].values()),
        "feedthrough_origin": feedthrough.origins[name],
        "fits": [other for other in find_fitting_fmus(demanded) if other != fmu.name],
        "variables": variables_of(
            fmu,
            {variable: value for (component, variable), value in settings.variables.items() if component == name},
            {variable: origin for (component, variable), origin in settings.origins.items() if component == name},
        ),
    }


def connections(prepared: PreparedSystem) -> list[dict[str, Any]]:
    """Return the connections; element-wise connections of a vector are joined into one."""
    by_ends: dict[tuple[str, str, str, str], dict[str, Any]] = {}
    for link in prepared.network.links():
        ends = []
        for node in (link.source, link.target):
            whole = ELEMENT.fullmatch(node.variable)
            ends.append((node.component or "", whole.group(1) if whole else node.variable))
        (source, left), (target, right) = ends
        row = by_ends.setdefault(
            (source, left, target, right), {"from": source, "output": left, "to": target, "input": right, "elements": 0}
        )
        row["elements"] += 1
    return list(by_ends.values())
