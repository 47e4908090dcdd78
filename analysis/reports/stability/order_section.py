"""The page's section on FMUs with undeclared dependencies: what was assumed, and the margins in both orders."""

from __future__ import annotations

from dataclasses import dataclass

from ...stability.loops.margin_values import Quantity
from ...stability.results.report import StabilityReport
from .orders import order_loops, order_sentences
from .tables import Table, link
from .words import NO_CROSSING, gain_margin, numeral, phase_margin, size, state, verdict

HEAD = (
    "loop", "operating point", "feedthrough", "gain margin, dB", "phase margin, deg", "delay margin, s",
    "modulus margin", "disk margin", "verdict",
)  # fmt: skip


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
    return OrderSection(sentences, Table(HEAD, "sssnnnnns", rows, "margins in both orders"))
