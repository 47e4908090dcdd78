"""Sentences on a study in both orders of FMUs with undeclared dependencies, for page and terminal."""

from __future__ import annotations

from ....stability.loops.margin_values import UNLIMITED, UNSTABLE
from ....stability.results.report import JointReport, LoopReport, StabilityStudy
from ....stability.results.requirement import MarginRequirement, MarginVerdict


def order_loops(report: StabilityStudy) -> tuple[LoopReport, ...]:
    """Return the loops in the other order; none if there is only one order."""
    return () if report.orders is None or report.orders.report is None else report.orders.report.loops


def order_sentences(report: StabilityStudy) -> list[str]:
    """Return the assumption and the other order in words; none if all FMUs on loops declare their dependencies."""
    orders = report.orders
    if orders is None:
        return []
    sentences = [
        f"direct dependencies of outputs on inputs are not declared by {orders.fmus}: none are assumed, and "
        "steps use inputs from the start of the step"
    ]
    if orders.without:
        cannot = f"{', '.join(orders.without)} cannot have feedthrough{' as well' if orders.direct else ''}"
        sentences.append(f"{cannot}, which would close an algebraic loop at {'; '.join(orders.cuts)}")
    if orders.report is not None:
        sentences.append(
            f"with feedthrough: steps of {', '.join(orders.direct)} use inputs from the end of the step; the "
            "true behaviour of an FMU within a step lies between the two orders"
        )
        sentences += [
            f"with feedthrough {item.what} {item.name} at {item.point} is not studied: {item.reason}"
            for item in orders.report.unstudied
        ]
        if report.sweeps:
            sentences.append("margins over parameters are without feedthrough")
    return sentences


def withheld_line(report: StabilityStudy, subject: LoopReport | JointReport, item: MarginRequirement) -> str:
    """Return why a requirement is withheld, and what would decide it."""
    assert report.orders is not None
    assert item.as_feedthrough is not None
    names = report.orders.direct
    options = " or ".join(f"{option} {name}" for name in names for option in ("`feedthrough`", "`no_feedthrough`"))
    return (
        f"loop {subject.name} at {subject.point}: {item.title} withheld: {_value(item)} without feedthrough of "
        f"{report.orders.fmus}, {_value(item.as_feedthrough)} with it, limit {item.limit:g}{_unit(item)}; "
        f"give {options}, or use a smaller step"
    )


def order_note(item: MarginRequirement) -> str:
    """Return the note on a requirement for a table: the requirement's note, or the reason why it is withheld."""
    if item.verdict is not MarginVerdict.WITHHELD or item.as_feedthrough is None:
        return item.note
    return f"{_value(item.as_feedthrough)} as feedthrough"


def _unit(item: MarginRequirement) -> str:
    return "" if item.unit == "1" else f" {item.unit}"


def _value(item: MarginRequirement) -> str:
    if item.value is None or item.passed is None:
        return item.note or "not known"
    return {UNSTABLE: "unstable", UNLIMITED: "no crossing"}.get(item.value, f"{item.value:.4g}{_unit(item)}")
