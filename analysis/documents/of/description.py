"""Document of a description: of a system, a component, an FMU, a slot or a campaign."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

from ...authoring.campaign_listing import toml_value
from ...runtime.system.feedthrough import Origin
from ..model import Document, Listing, Node, Text

LONGEST_LIST = 60  # characters of a list of values, beyond which it is cut
TITLES = (16,)  # widths of columns of titles
LISTS = ("parameter_sets", "campaigns", "loops")  # lists of a system
VARIABLES = {
    ("input", False): "inputs",
    ("output", False): "outputs",
    ("structuralParameter", False): "structural parameters",
    ("parameter", False): "parameters",
    ("parameter", True): "tunable parameters",
}  # headings by causality and whether they are tunable


def description_document(content: Mapping[str, Any]) -> Document:
    """Return the document of a description; its keys show whether it is of a system, an FMU, a slot or a campaign."""
    if "components" in content:
        title, nodes = content["system"], _system(content)
    elif "campaign" in content:
        title, nodes = content["campaign"], _campaign(content)
    elif "slot" in content:
        title, nodes = content["slot"], [*_slot(content), *_variables(content["variables"])]
    elif "fits" in content:
        title, nodes = content["name"], [*_component(content), *_variables(content["variables"])]
    else:
        title, nodes = content["fmu"], [*_fmu(content), *_variables(content["variables"])]
    return Document(title, nodes, [], dict(content))


def _campaign(content: Mapping[str, Any]) -> list[Node]:
    titled = [["variants", ", ".join(content["variants"])], ["files", ", ".join(content["files"])]]
    return [
        Text(f"{content['campaign']} of {content['system']}: {content['description']}", is_wrapped=True),
        Listing(titled, columns=TITLES),
        Text("values, each with its line in the file above it"),
        *(
            Listing([[f"{row['line']:4}", f"{row['name']} = {toml_value(row['value'])}"] for row in rows], file)
            for file, rows in itertools.groupby(content["values"], key=lambda each: each["file"])
        ),
    ]


def _slot(content: Mapping[str, Any]) -> list[Node]:
    title = f"{content['slot']} ({content['interface']}): {content['description']}"
    return [Text(title, is_wrapped=True), Listing(list(content["fmus"].items()), "FMUs")]


def _component(content: Mapping[str, Any]) -> list[Node]:
    titled = [
        ["compatible FMUs", ", ".join(content["fits"]) or "none in this repository"],
        ["feedthrough", _feedthrough(content)],
    ]
    return [
        Text(f"{content['name']}: {content['fmu']}, {content['description']}", is_wrapped=True),
        Listing(titled, columns=TITLES),
        _connections(content),
    ]


def _fmu(content: Mapping[str, Any]) -> list[Node]:
    alone, titled = content["alone"], []
    if content["undeclared_outputs"]:
        outputs = ", ".join(content["undeclared_outputs"])
        titled.append(
            ["feedthrough", f"not declared for {outputs}: in a system none is assumed, unless --feedthrough is given"]
        )
    times = f"{alone['start_time']:g} s to {alone['stop_time']:g} s in steps of {alone['step']:g} s"
    titled.append(["stand-alone", f"as {alone['component']}, {times}: perilune run {content['file']}"])
    if content["terminals"]:
        terminals = "; ".join(f"{name} ({', '.join(members)})" for name, members in content["terminals"].items())
        titled.append(["terminals", terminals])
    return [Text(f"{content['fmu']}: {content['description']}", is_wrapped=True), Listing(titled, columns=TITLES)]


def _system(content: Mapping[str, Any]) -> list[Node]:
    times = f"{content['step']:g} s to {content['stop_time']:g} s"
    titled = [[title.replace("_", " "), ", ".join(content[title]) or "none"] for title in LISTS]
    titled += [["frame", f"{name}: {', '.join(axes)}"] for name, axes in content["frames"].items()]
    if content["connectors"]:
        titled.append(["connectors", ", ".join(f"{each['name']} ({each['kind']})" for each in content["connectors"])])
    components = content["components"]
    nodes: list[Node] = [
        Text(f"{content['system']}: {content['file']}, {times}", is_wrapped=True),
        Listing(titled, columns=TITLES),
        Listing(
            [[each["name"], each["fmu"], each["description"]] for each in components],
            "components (perilune describe SYSTEM COMPONENT shows all variables of one)",
        ),
        Listing(
            [[each["name"], ", ".join(each["fits"])] for each in components if each["fits"]],
            "compatible FMUs, for --use COMPONENT=FMU",
        ),
        _connections(content),
    ]
    settled = [each for each in components if each["feedthrough_origin"] != Origin.FMU]
    if settled:
        rows = [[each["name"], _feedthrough(each)] for each in settled]
        nodes.append(Listing(rows, "feedthrough that differs from the FMU's declaration"))
        nodes += [Text(f"  {cut}: a loop, cut at the start", is_wrapped=True) for cut in content["cut_at_start"]]
    overridden = [
        [f"{each['name']}.{row['name']}", _value(row), row["unit"] or "", row["from"]]
        for each in components
        for row in each["variables"]
        if row["from"]
    ]
    return [*nodes, Listing(overridden or [["none"]], "overridden values")]


def _feedthrough(component: Mapping[str, Any]) -> str:
    """Return how outputs depend on inputs, and the source of this statement."""
    return f"{'direct' if component['feedthrough'] else 'none'}, {component['feedthrough_origin']}"


def _connections(content: Mapping[str, Any]) -> Listing:
    connected: dict[tuple[str, str], list[str]] = {}
    for row in content["connections"]:
        size = f"[{row['elements']}]" if row["elements"] > 1 else ""
        name = row["output"] if row["output"] == row["input"] else f"{row['output']} as {row['input']}"
        ends = (row["from"] or content["system"], row["to"] or content["system"])
        connected.setdefault(ends, []).append(name + size)
    rows = [[source, f"-> {target}", ", ".join(names)] for (source, target), names in connected.items()]
    return Listing(rows, "connections")


def _variables(rows: Sequence[Mapping[str, Any]]) -> list[Listing]:
    listings = []
    for kind, heading in VARIABLES.items():
        chosen = [
            [f"{row['name']}{_size(row)}", _value(row), row["unit"] or "", row["from"] or "", _about(row)]
            for row in rows
            if (row["causality"], row["tunable"]) == kind
        ]
        listings += [Listing(chosen, heading)] if chosen else []
    return listings


def _about(row: Mapping[str, Any]) -> str:
    """Return a variable's description with the items of an Enumeration, unless the text already lists them."""
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
