"""perilune describe: what a system, an FMU or a slot has, by name."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import Any

from ..api.describe import described
from ..authoring.describe.variables import of_causality
from ..runtime.system.order.feedthrough import Origin
from .common.options import check_json, system_options, tell
from .common.text_table import text_table

WIDE = 100  # characters of a list of values, beyond which it is cut


def run(options: argparse.Namespace) -> int:
    check_json(options)
    document = described(options.what, options.component, system_options(options))
    return tell(document, options, lambda: _print(document))


def _print(document: dict[str, Any]) -> None:
    if "components" in document:
        _print_system(document)
        return
    if "slot" in document:
        print(f"{document['slot']} ({document['interface']}): {document['description']}")
        print("FMUs")
        _lines(text_table([[f"  {name}", words] for name, words in document["fmus"].items()]))
    elif "fits" in document:
        print(f"{document['name']}: {document['fmu']}, {document['description']}")
        print(f"fits here too   {', '.join(document['fits']) or 'nothing else of this repository'}")
        print(f"feedthrough     {_feedthrough(document)}")
        _print_connections(document)
    else:
        print(f"{document['fmu']}: {document['description']}")
        alone = document["alone"]
        times = f"{alone['start_time']:g} s to {alone['stop_time']:g} s in steps of {alone['step']:g} s"
        if document["undeclared_outputs"]:
            outputs = ", ".join(document["undeclared_outputs"])
            print(f"feedthrough     not declared of {outputs}: assumed none in a system, unless --feedthrough says so")
        print(f"flies alone as {alone['component']}, {times}: perilune run {document['file']}")
    _print_variables(document["variables"])


def _print_system(document: dict[str, Any]) -> None:
    print(f"{document['system']}: {document['file']}, {document['step']:g} s to {document['stop_time']:g} s")
    for title in ("parameter_sets", "campaigns", "loops"):
        print(f"{title.replace('_', ' '):15} {', '.join(document[title]) or 'none'}")
    if document["connectors"]:
        print("connectors      " + ", ".join(f"{c['name']} ({c['kind']})" for c in document["connectors"]))
    print("components (perilune describe SYSTEM COMPONENT: all that one has)")
    _lines(text_table([[f"  {c['name']}", c["fmu"], c["description"]] for c in document["components"]]))
    print("fits there, for --use SLOT=FMU, by the component's name")
    _lines(text_table([[f"  {c['name']}", ", ".join(c["fits"])] for c in document["components"] if c["fits"]]))
    _print_connections(document)
    settled = [component for component in document["components"] if component["feedthrough_origin"] != Origin.FMU]
    if settled:
        print("feedthrough that is not as the FMU declares it")
        _lines(text_table([[f"  {component['name']}", _feedthrough(component)] for component in settled]))
        _lines(f"  {cut}: a loop, cut here at the start" for cut in document["cut_at_start"])
    given = [
        [f"  {component['name']}.{row['name']}", _value(row), row["unit"] or "", row["from"]]
        for component in document["components"]
        for row in component["variables"]
        if row["from"]
    ]
    print("values that are not the FMU's own")
    _lines(text_table(given or [["  none"]]))


def _feedthrough(component: dict[str, Any]) -> str:
    """Whether outputs depend directly on inputs, with where that comes from."""
    return f"{'direct' if component['feedthrough'] else 'none'}, {component['feedthrough_origin']}"


def _print_connections(document: dict[str, Any]) -> None:
    print("connections")
    paths: dict[tuple[str, str], list[str]] = {}
    for row in document["connections"]:
        size = f"[{row['elements']}]" if row["elements"] > 1 else ""
        name = row["output"] if row["output"] == row["input"] else f"{row['output']} as {row['input']}"
        ends = (row["from"] or document["system"], row["to"] or document["system"])
        paths.setdefault(ends, []).append(name + size)
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
