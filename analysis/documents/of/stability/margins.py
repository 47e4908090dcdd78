"""Tables of all loops: requirements with verdicts, margins, simultaneous margins, margins in both orders."""

from __future__ import annotations

from collections.abc import Sequence

from ....stability.loops.margin_values import UNSTABLE, MarginQuantity
from ....stability.results.report import JudgedRequirement, LoopReport, StabilityStudy
from ....stability.results.requirement import MarginRequirement, Scope
from ...cell import Cell, Lines, Phrase, Strong
from ...model import Table
from ..reserve import TIGHTEST
from .orders import order_loops, order_note
from .study_cells import (
    NO_CROSSING,
    crossing_text,
    gain_margin,
    in_decibels,
    in_degrees,
    limit,
    link,
    names,
    numbers,
    numeral,
    phase_margin,
    samples,
    sentences,
    size,
    state,
    text_of_closed_loop,
    verdict,
)
from .tightest import is_tightest, tightest, with_mark

SCOPES = {Scope.NOMINAL: "nominal", Scope.DISPERSED: "dispersed", Scope.JOINT: "simultaneous"}


def verdict_table(report: StabilityStudy, judgements: Sequence[JudgedRequirement]) -> Table:
    """Return a row for each requirement: value, limit, and verdict or why there is none; the tightest is marked."""
    nearest = tightest(report) if len(judgements) > 1 else None
    rows = [
        (
            link(report, subject),
            subject.point,
            SCOPES[item.scope],
            item.title,
            crossing_text(item),
            limit(item),
            verdict(item.verdict),
            _note(item, is_tightest=nearest is not None and item is nearest.requirement),
        )
        for subject, item in judgements
    ]
    heads = names("loop", "operating point", "scope", "quantity"), numbers("value", "limit"), names("verdict")
    return Table([*(head for group in heads for head in group), *sentences("note")], rows)


def _note(requirement: MarginRequirement, *, is_tightest: bool) -> Cell:
    words = order_note(requirement)
    return Phrase([Strong(TIGHTEST), *([f", {words}"] if words else [])], is_unbroken=False) if is_tightest else words


SIZES = (
    "gain margin, dB", "phase margin, deg", "delay margin, s", "delay margin, samples", "modulus margin", "disk margin",
)  # fmt: skip


def summary_table(report: StabilityStudy) -> Table:
    """Return the table of the margins of all loops at all operating points."""
    rows = [
        (with_mark(report, loop, link(report, loop)), loop.point, *margin_cells(loop), verdict(loop.verdict))
        for loop in report.loops
    ]
    heads = [*names("loop", "operating point"), *numbers(*SIZES), *names("closed loop", "verdict")]
    return Table(heads, rows)


def loop_table(loop: LoopReport) -> Table:
    """Return the table of one loop's margins, for screens."""
    return Table([*numbers(*SIZES), *names("closed loop")], [margin_cells(loop)], is_printed=False)


def margin_cells(loop: LoopReport) -> Sequence[Cell]:
    """Return the nearest margins of a loop, and its stability."""
    unstable = state(loop.margins)
    return (
        gain_margin(loop.margins),
        phase_margin(loop.margins),
        unstable or numeral(loop.classical.delay_margin, infinite=NO_CROSSING),
        unstable or samples(loop.classical.delay_margin, loop.sample_period),
        unstable or numeral(loop.robust.modulus_margin, digits=3),
        unstable or numeral(loop.robust.disk_margin, digits=3),
        text_of_closed_loop(loop.stable),
    )


def joint_table(report: StabilityStudy) -> Table:
    """Return the table of disk margins of several channels that vary simultaneously and independently."""
    rows: list[tuple[Cell, ...]] = []
    for joint in report.joint:
        margins: tuple[Cell, ...] = (
            numeral(joint.disk_margin, digits=3),
            in_decibels(joint.disk_gain, "without limit"),
            in_degrees(joint.disk_phase),
            numeral(joint.disk_frequency),
        )
        unstable = (*[size(UNSTABLE)] * 3, numeral(None))
        mark = [TIGHTEST] if is_tightest(report, joint) else []
        name = Lines([Strong(joint.name), ", ".join(joint.channels), *map(Strong, mark)])
        rows.append((name, joint.point, *(margins if joint.stable else unstable), verdict(joint.verdict)))
    sizes = numbers("disk margin", "gain, dB, upper and lower", "phase, deg", "at rad/s")
    return Table(["channels", "operating point", *sizes, "verdict"], rows)


def order_table(report: StabilityStudy) -> Table:
    """Return two rows for each loop, without and with feedthrough; none if there is only one order."""
    others = {(loop.name, loop.point): loop for loop in order_loops(report)}
    rows: list[tuple[Cell, ...]] = []
    for loop in report.loops:
        other = others.get((loop.name, loop.point))
        for feedthrough, each in (("none", loop), ("all", other)) if others else ():
            if each is None:
                continue
            delay = state(each.margins) or numeral(each.classical.delay_margin, infinite=NO_CROSSING)
            margins = [size(each.margins.size(quantity)) for quantity in (MarginQuantity.MODULUS, MarginQuantity.DISK)]
            crossings = gain_margin(each.margins), phase_margin(each.margins), delay
            rows.append((link(report, loop), loop.point, feedthrough, *crossings, *margins, verdict(loop.verdict)))
    sizes = numbers("gain margin, dB", "phase margin, deg", "delay margin, s", "modulus margin", "disk margin")
    return Table([*names("loop", "operating point", "feedthrough"), *sizes, *names("verdict")], rows)
