"""The page of a stability study, in the order in which a board reads it: verdict, margins, loops, how it was made."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from markupsafe import Markup

from ...stability.loops.margin_values import Quantity
from ...stability.results.report import LoopReport, StabilityReport
from ...stability.results.requirement import Verdict
from ...stability.results.varied import SweepReport
from ..common.page import write_page
from ..common.panels import Panel
from ..common.quantities import label_with_unit
from .figures import SIGHT, joint_panel, loop_figures, sweep_panel
from .orders import order_loops, order_sentences
from .over_time import over_time
from .parts import Part, parts, without
from .shared import TOLERANCE, Paper, Shared, paper_of, share
from .tables import (
    Table,
    about,
    anchor,
    counts,
    facts,
    hash_table,
    joint_table,
    limit_table,
    link,
    point_table,
    summary_table,
    trim_table,
    verdict_rows,
    verdict_table,
)
from .words import NO_CROSSING, UNSTABLE_WORD, gain_margin, left_out, numeral, phase_margin, size, state, verdict

SEEN = ("Bode", "Nichols")  # labels of the figures that are seen at first sight


@dataclass(frozen=True)
class Card:
    """A loop on the page: what is seen at first sight, and what is folded away below it."""

    loop: LoopReport
    id: str
    verdict: Markup
    period: Markup
    about: list[tuple[str, str]]
    left_out: list[Markup]
    summary: Table
    sight: list[Panel]
    seen_elsewhere: list[tuple[Markup, list[str]]]
    figures: list[Panel]
    elsewhere: list[tuple[Markup, list[str]]]
    blocks: list[list[Part]]
    without: list[str]
    screen: list[str]  # labels of figures that are not printed
    screen_parts: list[str]  # and keys of parts


@dataclass(frozen=True)
class Sweep:
    """Margins over one parameter on the page."""

    report: SweepReport
    panel: Panel
    table: Table
    crossings: Table


def write_stability_page(report: StabilityReport, path: Path) -> None:
    """Write one self-contained HTML page about a stability study; the same report gives the same bytes.

    How long the study took is not on the page, so that the same study gives the same page.
    """
    rows = verdict_rows(report)
    summary = summary_table(report)
    shared = share(report.loops, [loop_figures(loop, anchor(index)) for index, loop in enumerate(report.loops)])
    paper = paper_of(shared)
    write_page(
        path,
        Path(__file__).with_name("stability.html"),
        title=f"{report.system}: stability",
        report=report,
        verdict=verdict(report.verdict),
        counts=counts(rows),
        over_time=over_time(report),
        failing=verdict_table([row for row in rows if row[-1].verdict in (Verdict.FAIL, Verdict.WITHHELD)]),
        requirements=verdict_table(rows),
        summary=summary,
        joint=joint_table(report),
        unstudied=report.unstudied,
        orders=order_section(report),
        joint_panels=[joint_panel(joint, f"joint-{index + 1}") for index, joint in enumerate(report.joint)],
        points=point_table(report.points),
        trims=trim_table(report.points),
        settings={
            point.name: [(name, numeral(value, digits=10)) for name, value in point.settings.items()]
            for point in report.points
            if point.settings
        },
        cards=[_card(report, summary, index, shared[index], paper) for index in range(len(report.loops))],
        paper=paper.words,
        tolerance=TOLERANCE,
        sweeps=[_sweep(report, sweep, f"sweep-{index + 1}") for index, sweep in enumerate(report.sweeps)],
        limits=limit_table(report),
        raw_limits=[(name, numeral(value)) for name, value in report.limits.items()],
        hashes=hash_table(report.provenance),
        parameters=[
            (name, numeral(value, digits=10)) for name, value in report.provenance.get("parameters", {}).items()
        ],
        facts=facts(report.provenance),
        provenance=report.provenance,
    )


def _card(report: StabilityReport, summary: Table, index: int, shared: Shared, paper: Paper) -> Card:
    loop = report.loops[index]
    displayed = [replace(part, figures=shared.panels.get(part.key, [])) for part in parts(loop)]
    return Card(
        loop=loop,
        id=anchor(index),
        verdict=verdict(loop.verdict),
        period=numeral(loop.sample_period),
        about=about(loop),
        left_out=[left_out(part, reason, loop) for part, reason in loop.not_applicable.items()],
        summary=Table(summary.head[2:-1], summary.kinds[2:-1], [summary.rows[index][2:-1]]),
        sight=shared.panels[SIGHT],
        seen_elsewhere=_elsewhere(report, shared, seen=True),
        figures=shared.panels[""],
        elsewhere=_elsewhere(report, shared, seen=False),
        blocks=_blocks(displayed),
        without=without(loop),
        screen=paper.screen_only([panel for panels in shared.panels.values() for panel in panels]),
        screen_parts=[part.key for part in displayed if not paper.prints(part.key, shared)],
    )


def _elsewhere(report: StabilityReport, shared: Shared, *, seen: bool) -> list[tuple[Markup, list[str]]]:
    """Where the figures are that are drawn for another loop: those ``seen`` at first sight, or the others."""
    linked = {
        other: [label for label in labels if (label in SEEN) == seen] for other, labels in shared.elsewhere.items()
    }
    return [(link(report, other), labels) for other, labels in linked.items() if labels]


def _blocks(shown: list[Part]) -> list[list[Part]]:
    """Parts that are laid out as one; the short ones beside the long table of the method go below each other."""
    blocks: list[list[Part]] = []
    for part in shown:
        if part.key != "robust":
            blocks.append([])
        blocks[-1].append(part)
    return blocks


def _sweep(report: StabilityReport, sweep: SweepReport, name: str) -> Sweep:
    rows = [
        (
            numeral(float(value), sweep.unit),
            gain_margin(margins),
            phase_margin(margins),
            size(margins.size(Quantity.MODULUS)),
        )
        for value, margins in zip(sweep.values, sweep.margins, strict=True)
    ]
    crossings = [
        (
            UNSTABLE_WORD if crossing.quantity is Quantity.STABILITY else f"{crossing.quantity} misses its limit",
            "below" if crossing.below else "above",
            numeral(crossing.value, sweep.unit),
        )
        for crossing in sweep.crossings
    ]
    return Sweep(
        sweep,
        sweep_panel(sweep, report, name),
        Table((sweep.parameter, "gain margin, dB", "phase margin, deg", "modulus margin"), "nnnn", rows),
        Table(("what fails", "where", label_with_unit(sweep.parameter, sweep.unit)), "ttn", crossings),
    )


@dataclass(frozen=True)
class OrderSection:
    """Sentences, and a table with two rows for each loop; ``rows`` are none where there is one order only."""

    sentences: list[str]
    table: Table


def order_section(report: StabilityReport) -> OrderSection:
    """What a study says of both orders; no sentence where every FMU on a loop declares its dependencies."""
    others = {(loop.name, loop.point): loop for loop in order_loops(report)}
    rows = []
    for index, loop in enumerate(report.loops):
        other = others.get((loop.name, loop.point))
        for name, each in (("none", loop), ("all", other)) if others else ():
            if each is None:
                continue
            delay = state(each.margins) or numeral(each.classical.delay_margin, infinite=NO_CROSSING)
            margins = [size(each.margins.size(quantity)) for quantity in (Quantity.MODULUS, Quantity.DISK)]
            ends = link(report, index), loop.point, name, gain_margin(each.margins), phase_margin(each.margins)
            rows.append((*ends, delay, *margins, verdict(loop.verdict)))
    sentences = [f"{sentence[0].upper()}{sentence[1:]}." for sentence in order_sentences(report)]
    if report.orders is None:  # of FMUs that no loop passes
        sentences = [f"Assumed: {note}." for note in report.provenance.get("assumptions", ())]
    head = (
        "loop", "operating point", "feedthrough", "gain margin, dB", "phase margin, deg", "delay margin, s",
        "modulus margin", "disk margin", "verdict",
    )  # fmt: skip
    return OrderSection(sentences, Table(head, "sssnnnnns", rows, "margins in both orders"))
