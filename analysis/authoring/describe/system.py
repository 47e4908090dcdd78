"""A prepared system: its components with their parameters and what fits there, its connections, what lies with it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ...runtime.system.prepared import PreparedSystem
from ...stability.request.reading import read_declaration
from .fits import fitting
from .variables import ELEMENT, variables_of


def describe_system(prepared: PreparedSystem) -> dict[str, Any]:
    """Components, connections, connectors of the system itself, and its files' names. Times in s."""
    files = prepared.archive.files
    return {
        "system": prepared.archive.name,
        "file": prepared.network.file,
        "step": prepared.step,
        "stop_time": prepared.start + prepared.steps * prepared.step,
        "parameter_sets": sorted(Path(name).name for name in files if name.endswith(".ssv")),
        "campaigns": sorted(prepared.archive.campaign_names()),
        "variants": prepared.archive.variants(),
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
    given = [variable for component, variable in settings.variables if component == name]
    demanded += [(key, fmu.variables[key].causality, fmu.variables[key].type) for key in given]
    return {
        "name": name,
        "fmu": fmu.name,
        "description": fmu.description.description or "",
        "feedthrough": any(feedthrough.stepping[name].values()),
        "feedthrough_origin": feedthrough.origins[name],
        "fits": [other for other in fitting(demanded) if other != fmu.name],
        "variables": variables_of(
            fmu,
            {variable: value for (component, variable), value in settings.variables.items() if component == name},
            {variable: origin for (component, variable), origin in settings.origins.items() if component == name},
        ),
    }


def connections(prepared: PreparedSystem) -> list[dict[str, Any]]:
    """What leads from where to where, the elements of a vector brought together."""
    by_ends: dict[tuple[str, str, str, str], dict[str, Any]] = {}
    for link in prepared.network.driver.values():
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
