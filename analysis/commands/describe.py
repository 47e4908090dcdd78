"""perilune describe: what a system, an FMU or a slot has, by name."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.available import fmu_flavours
from ..describe.fits import blocks_of_slot, slots
from ..describe.system import describe_system
from ..describe.variables import of_causality, variables_of
from ..errors import InputError, suggestion
from ..system.archive import system_names
from ..system.fmu import load_fmu
from ..system.prepared import find_fmu, prepare_system
from .common.options import check_json, system_options, tell
from .common.text_table import text_table

WIDE = 100  # characters of a list of values, beyond which it is cut


def run(options: argparse.Namespace) -> int:
    check_json(options)
    what = options.what
    if _is_fmu(what):
        return _fmu(options)
    if what in slots():
        return _slot(options)
    if what in system_names() or Path(what).exists():
        return _system(options)
    known = [*system_names(), *slots(), *catalogue()]
    raise InputError("describe", what, "no system, FMU or slot of this name", suggestion(what, known))


def _is_fmu(what: str) -> bool:
    return what.endswith(".fmu") or what in catalogue() or what in fmu_flavours()


def _fmu(options: argparse.Namespace) -> int:
    if options.component is not None:
        raise InputError("describe", options.component, "an FMU has no components", "name a system before it")
    data, label = find_fmu(options.what, options.flavour, "describe")
    fmu = load_fmu(data, label)
    document: dict[str, Any] = {
        "fmu": fmu.name,
        "file": label,
        "description": fmu.description.description or "",
        "native": fmu.is_native,
        "variables": variables_of(fmu),
    }
    return tell(document, options, lambda: _print_fmu(document))


def _print_fmu(document: dict[str, Any]) -> None:
    print(f"{document['fmu']}: {document['description']}")
    _print_variables(document["variables"])


def _slot(options: argparse.Namespace) -> int:
    slot = slots()[options.what]
    rows = [
        {"name": name, "causality": variable.causality, "size": variable.size, "unit": variable.unit, "value": None,
         "minimum": variable.minimum, "maximum": variable.maximum, "from": None, "description": variable.description}
        for name, variable in slot.variables.items()
    ]  # fmt: skip
    fmus = {block.fmu_name: block.summary() for block in blocks_of_slot(slot)}
    document = {"slot": options.what, "description": slot.summary(), "variables": rows, "fmus": fmus}
    return tell(document, options, lambda: _print_slot(document, slot.__name__))


def _print_slot(document: dict[str, Any], interface: str) -> None:
    print(f"{document['slot']} ({interface}): {document['description']}")
    print("FMUs")
    _lines(text_table([[f"  {name}", words] for name, words in document["fmus"].items()]))
    _print_variables(document["variables"])


def _system(options: argparse.Namespace) -> int:
    document = describe_system(prepare_system(options.what, system_options(options)))
    found = {component["name"]: component for component in document["components"]}
    if options.component is None:
        return tell(document, options, lambda: _print_system(document))
    if options.component not in found:
        raise InputError("describe", options.component, "no such component", suggestion(options.component, found))
    component = found[options.component]
    return tell(component, options, lambda: _print_component(document, component))


def _print_component(document: dict[str, Any], component: dict[str, Any]) -> None:
    print(f"{component['name']}: {component['fmu']}, {component['description']}")
    print(f"fits here too   {', '.join(component['fits']) or 'nothing else of this repository'}")
    _print_connections(document, component["name"])
    _print_variables(component["variables"])


def _print_system(document: dict[str, Any]) -> None:
    print(f"{document['system']}: {document['file']}, {document['step']:g} s to {document['stop_time']:g} s")
    for title in ("parameter_sets", "campaigns", "loops"):
        print(f"{title.replace('_', ' '):15} {', '.join(document[title]) or 'none'}")
    if document["connectors"]:
        print("connectors      " + ", ".join(f"{c['name']} ({c['kind']})" for c in document["connectors"]))
    print("components (perilune describe SYSTEM COMPONENT: all that one has)")
    _lines(text_table([[f"  {c['name']}", c["fmu"], c["description"]] for c in document["components"]]))
    print("fits there, for --use COMPONENT=FMU")
    _lines(text_table([[f"  {c['name']}", ", ".join(c["fits"])] for c in document["components"] if c["fits"]]))
    _print_connections(document)
    given = [
        [f"  {component['name']}.{row['name']}", _value(row), row["unit"] or "", row["from"]]
        for component in document["components"]
        for row in component["variables"]
        if row["from"]
    ]
    print("values that are not the FMU's own")
    _lines(text_table(given or [["  none"]]))


def _print_connections(document: dict[str, Any], component: str | None = None) -> None:
    print("connections")
    paths: dict[tuple[str, str], list[str]] = {}
    for row in document["connections"]:
        if component in (None, row["from"], row["to"]):
            size = f"[{row['elements']}]" if row["elements"] > 1 else ""
            name = row["output"] if row["output"] == row["input"] else f"{row['output']} as {row['input']}"
            paths.setdefault((row["from"] or document["system"], row["to"] or document["system"]), []).append(
                name + size
            )
    _lines(text_table([[f"  {source}", f"-> {target}", ", ".join(names)] for (source, target), names in paths.items()]))


def _print_variables(rows: list[dict[str, Any]]) -> None:
    for title, causality in (("inputs", "input"), ("outputs", "output"), ("parameters", "parameter")):
        chosen = of_causality(rows, causality)
        if chosen:
            print(title)
            _lines(
                text_table(
                    [
                        [
                            f"  {row['name']}{_size(row)}",
                            _value(row),
                            row["unit"] or "",
                            row["from"] or "",
                            row["description"],
                        ]
                        for row in chosen
                    ]
                )
            )


def _size(row: dict[str, Any]) -> str:
    if row["size"] == 1:
        return ""
    return str(row["size"]) if isinstance(row["size"], list) else f"[{row['size']}]"


def _value(row: dict[str, Any]) -> str:
    value = row["value"]
    if value is None:
        return ""
    if not isinstance(value, list):
        return _plain(value)
    if all(entry == value[0] for entry in value):
        return f"all {_plain(value[0])}" if value[0] is not None else ""
    text = ", ".join(_plain(entry) for entry in value)
    return text if len(text) <= WIDE else text[:WIDE].rpartition(",")[0] + ", ..."


def _plain(value: Any) -> str:
    return (
        f"{value:.10g}" if isinstance(value, float) else str(value).lower() if isinstance(value, bool) else str(value)
    )


def _lines(lines: Iterable[str]) -> None:
    for line in lines:
        print(line)
