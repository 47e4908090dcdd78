"""Meanings and units of the columns of trial tables, stored in the metadata of each Arrow field."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

import pyarrow

from .definition.campaign import Metric
from .draws.supplied import stream_component


class Column(NamedTuple):
    """Column in a table of trials. ``unit`` is "1" for a dimensionless column, None if the results state no unit."""

    unit: str | None
    meaning: str


Describe = Callable[[str], Column]
FLIGHT = {
    "variant": Column(None, "FMUs in the compared slots"),
    "trial": Column("1", "number of the trial, which has the same samples in every variant"),
    "status": Column(None, "status of the simulation, and the worst status of its components"),
    "message": Column(None, "reason for which the simulation failed, else empty"),
    "end_time": Column("s", "time of the last row"),
}
FAULT = {
    ".value": Column(None, "value in the trial; nan where the fault is absent"),
    ".start": Column("s", "start time; nan where the fault is absent"),
    ".end": Column("s", "end time; inf if the fault has no end, nan where the fault is absent"),
}


def describe_column(name: str, provenance: Mapping[str, Any]) -> Column:
    """Return unit and meaning of a column, from its campaign's ``provenance``."""
    if name in FLIGHT:
        return FLIGHT[name]
    if name == "success":
        return Column("1", f"whether {provenance['success']}")
    kind, _, remainder = name.partition(".")
    if kind == "metric":
        fact = provenance["metrics"][remainder]
        return Column(fact["unit"], describe_metric(fact) or f"{fact['reduction']} of {fact['expression']}")
    if kind == "final":
        return Column(provenance["signals"].get(remainder, {}).get("unit"), f"last value of {remainder}")
    if kind == "fault":
        end = next((end for end in FAULT if remainder.endswith(end)), None)
        if end is None:
            return Column("1", f"1 in trials with the fault {remainder}, else 0")
        return Column(FAULT[end].unit, f"fault {remainder.removesuffix(end)}: {FAULT[end].meaning}")
    component = stream_component(remainder)
    if component is not None:
        whose = f"random stream {component}" if component else "random streams"
        return Column("1", f"number of the trial whose {whose} this trial uses")
    swept = provenance.get("sweep", {}).get(remainder)
    return Column(None, f"drawn or derived: {remainder}" if swept is None else f"swept: {remainder}, {swept}")


def describe_metric(fact: Mapping[str, Any]) -> str:
    """Return a metric's description or, for an element with a named axis, a text such as "final of velocity up"."""
    if fact["description"] or "axis" not in fact:
        return str(fact["description"])
    return f"{fact['reduction']} of {fact['expression'].rpartition('[')[0]} {fact['axis']}"


def describe_metrics(metrics: Iterable[Metric]) -> Describe:
    """Return a function that returns unit and meaning of a column; both are empty except for these metrics."""
    known = {f"metric.{each.name}": Column(each.unit, each.description) for each in metrics}
    return lambda name: known.get(name, Column(None, ""))


def with_metadata(schema: pyarrow.Schema, describe: Describe) -> pyarrow.Schema:
    """Return the schema with metadata in every field: kind, meaning, and unit if there is one."""
    fields = []
    for field in schema:
        unit, meaning = describe(field.name)
        kind = field.name.partition(".")[0] if "." in field.name else "trial"
        fields.append(
            field.with_metadata({"kind": kind, "meaning": meaning} | ({} if unit is None else {"unit": unit}))
        )
    return pyarrow.schema(fields)
