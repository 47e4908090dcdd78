"""Provenance of a stability study: facts, limits, parameters, hashes."""

from __future__ import annotations

import math

from ....stability.results.report import StabilityStudy
from ...cell import Cell, Digest, Inline, Phrase
from ...common.quantities import NONE
from ...model import Fold, Group, Items, KeyNumbers, Missing, Node, Note, Table
from .margins import SCOPES
from .study_cells import fold_long, limit, numbers, numeral

TIMES = ("step", "start_time", "stop_time")  # s
ELSEWHERE = {"system", "system_sha256", "fmus", "parameters", "assumptions"}  # provenance in other tables


def origin_nodes(report: StabilityStudy) -> list[Node]:
    """Return the provenance of a study: all that its numbers depend on."""
    limits, hashes = limit_table(report), hash_table(report)
    parameters = [
        [f"{name} = ", numeral(value, digits=10)] for name, value in report.provenance.get("parameters", {}).items()
    ]
    listed = Fold(f"{len(parameters)} parameters, in SI units", [Items(parameters, "pairs")])
    return [
        KeyNumbers([("system", report.system), *facts(report)]),
        Group(
            "Limits",
            [
                limits if limits.rows else Missing("no limit was used"),
                *([Note(_declared(report.limits))] if report.limits else []),
            ],
        ),
        Group("Parameters", [listed if parameters else Missing("no parameter was set: the FMUs' own values hold")]),
        Group("Hashes", [fold_long(hashes, "hashes") if hashes.rows else Missing("the study uses no file")]),
        Note("Gains are displayed in dB; the exact value of each is its factor."),
    ]


def _declared(limits: dict[str, float]) -> list[Inline]:
    values = [part for name, value in limits.items() for part in (", ", f"{name} = ", numeral(value))]
    return ["As declared: ", *values[1:], "."]


def limit_table(report: StabilityStudy) -> Table:
    """Return the table of applied limits, each once."""
    rows: dict[tuple[str, str], tuple[Cell, ...]] = {}
    for _, item in report.judgements():
        rows.setdefault((item.title, str(item.limit)), (SCOPES[item.scope], item.title, limit(item)))
    return Table(["scope", "quantity", *numbers("limit")], list(rows.values()))


def hash_table(report: StabilityStudy) -> Table:
    """Return the table of hashes of the system and its FMUs."""
    provenance = report.provenance
    rows: list[tuple[Cell, ...]] = []
    if "system_sha256" in provenance:
        rows.append(("system", str(provenance.get("system", "")), Digest(str(provenance["system_sha256"]))))
    for component, fmu in provenance.get("fmus", {}).items():
        name, digest = (fmu.get("fmu", ""), fmu["sha256"]) if isinstance(fmu, dict) else ("", fmu)
        rows.append((component, str(name), Digest(str(digest))))
    return Table(["part", "name", "SHA-256"], rows)


def facts(report: StabilityStudy) -> list[tuple[str, Cell]]:
    """Return all other provenance, such as seed, step and versions, as key numbers."""
    return [
        (key.replace("_", " "), Phrase([*make_fact_cell(value), " s"] if key in TIMES else make_fact_cell(value)))
        for key, value in report.provenance.items()
        if key not in ELSEWHERE
    ]


def make_fact_cell(value: object) -> list[Inline]:
    """Return one fact as a cell: a number, a text, or several."""
    if value is None or value in ([], {}, ()):
        return ["none"]
    if isinstance(value, dict):
        return [part for key, entry in value.items() for part in (", ", f"{key} ", *make_fact_cell(entry))][1:]
    if isinstance(value, list | tuple):
        return [part for entry in value for part in (", ", *make_fact_cell(entry))][1:]
    if isinstance(value, float) and not math.isfinite(value):
        return [NONE]
    return [numeral(value, digits=10)]
