"""Tables of a stability page: the verdict, the summary of all loops, points, limits and the header's facts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from ...stability.loops.margin_values import UNSTABLE
from ...stability.results.report import LoopReport, PointReport, StabilityReport
from ...stability.results.requirement import Requirement, Scope, Verdict
from ..common.quantities import display_unit, number
from .orders import order_note
from .words import (
    NO_CROSSING,
    crossing_text,
    gain_margin,
    in_decibels,
    in_degrees,
    limit,
    numeral,
    per_cent,
    phase_margin,
    samples,
    size,
    state,
    text_of_closed_loop,
    verdict,
)

TIMES = ("step", "start_time", "stop_time")  # s
SCOPES = {Scope.NOMINAL: "nominal", Scope.DISPERSED: "dispersed", Scope.JOINT: "simultaneous"}
LONG = 30  # rows; longer tables are folded away
Cell = Markup | str


@dataclass(frozen=True)
class Table:
    """Head cells, how each column is set (``t`` text, ``s`` short text,
    which stays on one line, ``l`` long text, ``n`` number, ``c`` code or hash), and rows of cells."""

    head: tuple[str, ...]
    kinds: str
    rows: Sequence[tuple[Cell, ...]]
    what: str = ""

    @property
    def is_long(self) -> bool:
        return len(self.rows) > LONG


def anchor(index: int) -> str:
    """The id of a loop's card; names may hold what an id must not."""
    return f"loop-{index + 1}"


def link(report: StabilityReport, index: int) -> Markup:
    """A loop's name, leading to its card."""
    return Markup('<a href="#{}">{}</a>').format(anchor(index), report.loops[index].name)


Row = tuple[Cell, str, Requirement]


def verdict_rows(report: StabilityReport) -> list[Row]:
    """Loop, operating point and requirement of everything that is judged."""
    places = {id(loop): index for index, loop in enumerate(report.loops)}
    return [
        (
            link(report, places[id(subject)]) if isinstance(subject, LoopReport) else subject.name,
            subject.point,
            requirement,
        )
        for subject, requirement in report.judgements()
    ]


def verdict_table(rows: Sequence[Row]) -> Table:
    """Every requirement that is given: value, limit, verdict and, where there is none, why."""
    head = ("loop", "operating point", "scope", "quantity", "value", "limit", "verdict", "note")
    entries = []
    for loop, point, item in rows:
        numbers = crossing_text(item), limit(item), verdict(item.verdict)
        entries.append((loop, point, SCOPES[item.scope], item.title, *numbers, order_note(item)))
    return Table(head, "ssssnnsl", entries, "requirements")


def counts(rows: Sequence[Row]) -> dict[str, int]:
    """How many requirements hold, fail and are not applicable."""
    verdicts = [item.verdict for *_, item in rows]
    return {token: verdicts.count(token) for token in Verdict}


def summary_table(report: StabilityReport) -> Table:
    """Loops by operating points with their margins."""
    head = (
        "loop", "operating point", "gain margin, dB", "phase margin, deg", "delay margin, s", "delay margin, samples",
        "modulus margin", "disk margin", "closed loop", "verdict",
    )  # fmt: skip
    rows = [
        (
            link(report, index),
            loop.point,
            gain_margin(loop.margins),
            phase_margin(loop.margins),
            state(loop.margins) or numeral(loop.classical.delay_margin, infinite=NO_CROSSING),
            state(loop.margins) or samples(loop.classical.delay_margin, loop.sample_period),
            state(loop.margins) or numeral(loop.robust.modulus_margin, digits=3),
            state(loop.margins) or numeral(loop.robust.disk_margin, digits=3),
            text_of_closed_loop(loop.stable),
            verdict(loop.verdict),
        )
        for index, loop in enumerate(report.loops)
    ]
    return Table(head, "ssnnnnnnss", rows, "loops")


def joint_table(report: StabilityReport) -> Table:
    """Disk margins of several channels that vary at once and independently."""
    head = (
        "channels", "operating point", "disk margin", "gain, dB, upper and lower", "phase, deg", "at rad/s", "verdict",
    )  # fmt: skip
    rows: list[tuple[Cell, ...]] = []
    for joint in report.joint:
        name = Markup("<b>{}</b><br>{}").format(joint.name, ", ".join(joint.channels))
        margins = (
            numeral(joint.disk_margin, digits=3),
            in_decibels(joint.disk_gain, "without limit"),
            in_degrees(joint.disk_phase),
            numeral(joint.disk_frequency),
        )
        none = (size(UNSTABLE),) * 3 + (numeral(None),)
        rows.append((name, joint.point, *(margins if joint.stable else none), verdict(joint.verdict)))
    return Table(head, "ttnnnnt", rows, "joint margins")


def point_table(points: tuple[PointReport, ...]) -> Table:
    """Operating points: where, how far from a trim, and for how long the frozen-time linearisation is valid."""
    head = (
        "operating point", "phase", "time, s", "largest state drift per period", "drift of the response, %",
        "frozen-time linearisation valid for, s",
    )  # fmt: skip
    rows: list[tuple[Cell, ...]] = []
    for point in points:
        fastest = Markup("none")
        if point.trim:
            name, _, change, unit = point.trim[0]
            fastest = Markup("{} by {} {}").format(name, numeral(change, unit), display_unit(unit))
        holds = numeral(point.holds, infinite="does not change")
        rows.append((point.name, point.phase, numeral(point.time, digits=6), fastest, per_cent(point.drift), holds))
    return Table(head, "slnlnn", rows, "operating points")


def trim_table(points: tuple[PointReport, ...]) -> Table:
    """What changes most at each operating point while it is taken as frozen."""
    rows: list[tuple[Cell, ...]] = [
        (point.name, name, numeral(value, unit, 6), numeral(change, unit), display_unit(unit))
        for point in points
        for name, value, change, unit in point.trim
    ]
    return Table(("operating point", "state", "value", "change over a period", "unit"), "ttnnt", rows, "trim residuals")


def limit_table(report: StabilityReport) -> Table:
    """The limits that were used, each once."""
    rows: dict[tuple[str, ...], tuple[Cell, ...]] = {}
    for _, item in report.judgements():
        rows.setdefault((item.title, str(item.limit)), (SCOPES[item.scope], item.title, limit(item)))
    return Table(("scope", "quantity", "limit"), "ttn", list(rows.values()), "limits")


def hash_table(provenance: dict[str, Any]) -> Table:
    """Hashes of the system and its FMUs."""
    rows: list[tuple[Cell, ...]] = []
    if "system_sha256" in provenance:
        rows.append(("system", str(provenance.get("system", "")), str(provenance["system_sha256"])))
    for component, fmu in provenance.get("fmus", {}).items():
        name, digest = (fmu.get("fmu", ""), fmu["sha256"]) if isinstance(fmu, dict) else ("", fmu)
        rows.append((component, str(name), str(digest)))
    return Table(("part", "name", "SHA-256"), "ttc", rows, "hashes")


def facts(provenance: Mapping[str, object]) -> list[tuple[str, Cell]]:
    """Everything else that the study depends on: seed, step, versions and so on."""
    displayed = {"system", "system_sha256", "fmus", "parameters", "assumptions"}
    return [
        (key.replace("_", " "), fact(value) + Markup(" s") if key in TIMES else fact(value))
        for key, value in provenance.items()
        if key not in displayed
    ]


def fact(value: object) -> Cell:
    """One fact: a number, a text, or several of them."""
    if value is None or value in ([], {}, ()):
        return "none"
    if isinstance(value, dict):
        return Markup(", ").join(Markup("{} {}").format(key, fact(entry)) for key, entry in value.items())
    if isinstance(value, list | tuple):
        return Markup(", ").join(Markup("{}").format(fact(entry)) for entry in value)
    if isinstance(value, float) and not math.isfinite(value):
        return number(None)
    return numeral(value, digits=10)


def about(loop: LoopReport) -> list[tuple[str, str]]:
    """Where a loop is broken, which sign it has, and which other loops are closed."""
    return [
        ("loop broken at", loop.cut),
        ("return signal", "the same connector" if loop.returned == loop.cut else loop.returned),
        ("unit", display_unit(loop.unit) or "1"),
        ("sign", loop.sign),
        ("other loops closed", ", ".join(loop.closed) or "no other loop is declared"),
    ]
