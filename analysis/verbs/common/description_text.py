"""What `perilune describe` prints of a system, a component, an FMU or a slot; columns and lines for a terminal."""

from __future__ import annotations

import itertools
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

from ...authoring.campaign import toml_value
from ...runtime.system.feedthrough import Origin

WIDEST = 100  # columns of a line
LONGEST = 48  # characters of a column, beyond which an entry pushes the rest of its line on


def wrap(line: str, indent: int) -> list[str]:
    """A line as lines of at most WIDEST columns, all but the first indented; words are not broken."""
    if len(line) <= WIDEST:
        return [line.rstrip()]
    return textwrap.wrap(
        line,
        WIDEST,
        subsequent_indent=" " * indent,
        break_long_words=False,
        break_on_hyphens=False,
        replace_whitespace=False,
        drop_whitespace=True,
        expand_tabs=False,
    )


def text_table(rows: Sequence[Sequence[str]]) -> list[str]:
    """Lines for each row, each column but the last as wide as its entries up to LONGEST; the last one is wrapped."""
    if not rows:
        return []
    widths = [
        max((len(entry) for entry in column if len(entry) <= LONGEST), default=0) for column in zip(*rows, strict=True)
    ][:-1]
    indent = min(sum(widths) + 2 * len(widths), LONGEST)
    return [
        line
        for row in rows
        for line in wrap(
            "  ".join(entry.ljust(width) for entry, width in zip(row, [*widths, 0], strict=True)).rstrip(), indent
        )
    ]


LONGEST_LIST = 60  # characters of a list of values, beyond which it is cut
INDENT = 16  # of what goes with a title


def description_lines(document: Mapping[str, Any]) -> list[str]:
    """The lines of a description, by what it is of."""
    if "components" in document:
        return _system_lines(document)
    if "campaign" in document:
        return _campaign_lines(document)
    if "slot" in document:
        title = f"{document['slot']} ({document['interface']}): {document['description']}"
        fmus = text_table([[f"  {name}", text] for name, text in document["fmus"].items()])
        lines = [*wrap(title, 4), "FMUs", *fmus]
    elif "fits" in document:
        compatible = ", ".join(document["fits"]) or "none of this repository"
        lines = [
            *wrap(f"{document['name']}: {document['fmu']}, {document['description']}", 4),
            *wrap(f"compatible FMUs {compatible}", INDENT),
            f"feedthrough     {_feedthrough(document)}",
            *_connection_lines(document),
        ]
    else:
        lines = _fmu_lines(document)
    return lines + _variable_lines(document["variables"])


def _campaign_lines(document: Mapping[str, Any]) -> list[str]:
    values: list[str] = []
    for file, rows in itertools.groupby(document["values"], key=lambda each: each["file"]):
        values.append(file)
        values += text_table([[f"{row['line']:6}", f"{row['name']} = {toml_value(row['value'])}"] for row in rows])
    return [
        *wrap(f"{document['campaign']} of {document['system']}: {document['description']}", 4),
        *wrap(f"{'variants':{INDENT}}{', '.join(document['variants'])}", INDENT),
        *wrap(f"{'files':{INDENT}}{', '.join(document['files'])}", INDENT),
        "values, each with its line in the file above it",
        *values,
    ]


def _fmu_lines(document: Mapping[str, Any]) -> list[str]:
    alone = document["alone"]
    times = f"{alone['start_time']:g} s to {alone['stop_time']:g} s in steps of {alone['step']:g} s"
    terminals = "; ".join(f"{name} ({', '.join(members)})" for name, members in document["terminals"].items())
    undeclared = []
    if document["undeclared_outputs"]:
        outputs = ", ".join(document["undeclared_outputs"])
        text = f"feedthrough     not declared of {outputs}: assumed none in a system, unless --feedthrough says so"
        undeclared = wrap(text, INDENT)
    return [
        *wrap(f"{document['fmu']}: {document['description']}", 4),
        *undeclared,
        *wrap(f"stand-alone     as {alone['component']}, {times}: perilune run {document['file']}", INDENT),
        *(wrap(f"{'terminals':{INDENT}}{terminals}", INDENT) if terminals else []),
    ]


def _system_lines(document: Mapping[str, Any]) -> list[str]:
    times = f"{document['step']:g} s to {document['stop_time']:g} s"
    lines = wrap(f"{document['system']}: {document['file']}, {times}", 4)
    for title in ("parameter_sets", "campaigns", "loops"):
        lines += wrap(f"{title.replace('_', ' '):{INDENT}}{', '.join(document[title]) or 'none'}", INDENT)
    for name, axes in document["frames"].items():
        lines += wrap(f"{'frame':{INDENT}}{name}: {', '.join(axes)}", INDENT)
    if document["connectors"]:
        connectors = ", ".join(f"{each['name']} ({each['kind']})" for each in document["connectors"])
        lines += wrap(f"{'connectors':{INDENT}}{connectors}", INDENT)
    components = document["components"]
    lines.append("components (perilune describe SYSTEM COMPONENT: all that one has)")
    lines += text_table([[f"  {each['name']}", each["fmu"], each["description"]] for each in components])
    lines.append("compatible FMUs, for --use COMPONENT=FMU")
    lines += text_table([[f"  {each['name']}", ", ".join(each["fits"])] for each in components if each["fits"]])
    lines += _connection_lines(document)
    settled = [each for each in components if each["feedthrough_origin"] != Origin.FMU]
    if settled:
        lines.append("feedthrough that is not as the FMU declares it")
        lines += text_table([[f"  {each['name']}", _feedthrough(each)] for each in settled])
        lines += [line for cut in document["cut_at_start"] for line in wrap(f"  {cut}: a loop, cut at the start", 4)]
    overridden = [
        [f"  {each['name']}.{row['name']}", _value(row), row["unit"] or "", row["from"]]
        for each in components
        for row in each["variables"]
        if row["from"]
    ]
    return [*lines, "overridden values", *text_table(overridden or [["  none"]])]


def _feedthrough(component: Mapping[str, Any]) -> str:
    """Whether outputs depend directly on inputs, with where that comes from."""
    return f"{'direct' if component['feedthrough'] else 'none'}, {component['feedthrough_origin']}"


def _connection_lines(document: Mapping[str, Any]) -> list[str]:
    connected: dict[tuple[str, str], list[str]] = {}
    for row in document["connections"]:
        size = f"[{row['elements']}]" if row["elements"] > 1 else ""
        name = row["output"] if row["output"] == row["input"] else f"{row['output']} as {row['input']}"
        ends = (row["from"] or document["system"], row["to"] or document["system"])
        connected.setdefault(ends, []).append(name + size)
    rows = [[f"  {source}", f"-> {target}", ", ".join(names)] for (source, target), names in connected.items()]
    return ["connections", *text_table(rows)]


def _variable_lines(rows: list[dict[str, Any]]) -> list[str]:
    lines = []
    titles = {
        ("input", False): "inputs",
        ("output", False): "outputs",
        ("structuralParameter", False): "structural parameters",
        ("parameter", False): "parameters",
        ("parameter", True): "tunable parameters",
    }
    for kind, title in titles.items():
        chosen = [
            [f"  {row['name']}{_size(row)}", _value(row), row["unit"] or "", row["from"] or "", _about(row)]
            for row in rows
            if (row["causality"], row["tunable"]) == kind
        ]
        lines += [title, *text_table(chosen)] if chosen else []
    return lines


def _about(row: Mapping[str, Any]) -> str:
    """Return a variable's description with the items of an Enumeration, unless it lists them, as those of ours do."""
    about = row["description"]
    members = [(each["value"], each["name"], each["description"]) for each in row["items"]]
    if all(f"{number} {meaning or name}" in about for number, name, meaning in members):
        return str(about)
    texts = [f"{number} {name}" + (f" ({meaning})" if meaning else "") for number, name, meaning in members]
    return ": ".join(filter(None, (about, ", ".join(texts))))


def _size(row: Mapping[str, Any]) -> str:
    if row["size"] == 1:
        return ""
    return str(row["size"]) if isinstance(row["size"], list) else f"[{row['size']}]"


def _value(row: Mapping[str, Any]) -> str:
    value = row["value"]
    if value is None:
        return ""
    if not isinstance(value, list):
        return _plain(value)
    if all(entry == value[0] for entry in value):
        return f"all {_plain(value[0])}" if value[0] is not None else ""
    text = ", ".join(_plain(entry) for entry in value)
    return text if len(text) <= LONGEST_LIST else text[:LONGEST_LIST].rpartition(",")[0] + ", ..."


def _plain(value: Any) -> str:
    return (
        f"{value:.10g}" if isinstance(value, float) else str(value).lower() if isinstance(value, bool) else str(value)
    )
