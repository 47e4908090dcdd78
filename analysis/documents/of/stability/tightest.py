"""The margin nearest to its limit, and the dispersion of its loop, a line each."""

from __future__ import annotations

from pathlib import PurePath

from ....campaigns.summary import CONFIDENCE, success_interval
from ....stability.loops.margin_values import UNSTABLE, MarginQuantity
from ....stability.results.report import JointReport, JudgedRequirement, LoopReport, StabilityStudy
from ....stability.results.requirement import MarginRequirement, Scope
from ....stability.results.varied import Dispersion
from ...cell import Cell, Code, Inline, Percentage, Phrase, Strong
from ...common.quantities import display_unit
from ...model import Text
from ..reserve import TIGHTEST, relative_reserve
from .study_cells import crossing_text, limit, link, size


def tightest(report: StabilityStudy, scopes: tuple[Scope, ...] = tuple(Scope)) -> JudgedRequirement | None:
    """Return the margin requirement with the least relative reserve; None if no margin has a limit.

    Of equal requirements the first is returned. Instability counts as less reserve than any margin, and instability of
    the loop as less reserve than instability of its trials.
    """
    known = [each for each in report.judgements() if _is_margin(each.requirement) and each.requirement.scope in scopes]
    return min(known, key=lambda each: (_reserve(each.requirement), scopes.index(each.requirement.scope)), default=None)


def is_tightest(report: StabilityStudy, subject: LoopReport | JointReport) -> bool:
    """Return True if there are several loops, and this loop has the tightest margin."""
    nearest = tightest(report)
    return nearest is not None and nearest.subject is subject and len(report.loops) + len(report.joint) > 1


def with_mark(report: StabilityStudy, loop: LoopReport, name: Inline) -> Cell:
    """Return the name of a loop for a table, marked if it has the tightest margin."""
    return Phrase([name, " ", Strong(TIGHTEST)]) if is_tightest(report, loop) else name


def tightest_nodes(report: StabilityStudy) -> list[Text]:
    """Return a statement of the tightest margin with its limit, or that no margin has a limit; none without loops."""
    if not report.loops:
        return []
    nearest = tightest(report)
    if nearest is None:
        return [Text("no margin has a limit: only stability is judged")]
    return [Text(["tightest margin: ", *_who(report, nearest.subject), ", ", *_value(nearest)])]


def dispersion_nodes(report: StabilityStudy) -> list[Text]:
    """Return a statement on the dispersion of the tightest loop's margins, or on the way to disperse them."""
    nearest = tightest(report, (Scope.DISPERSED,))
    dispersed = [loop for loop in report.loops if loop.dispersion is not None]
    if not dispersed:
        return [Text(["not dispersed: ", Code("--campaign NAME"), " adds the trials of a campaign"])]
    loop, quantity = min(dispersed, key=_least_disk), MarginQuantity.DISK
    if nearest is not None and isinstance(nearest.subject, LoopReport):
        loop = nearest.subject
        quantity = nearest.requirement.quantity
    spread = loop.dispersion
    assert spread is not None
    stable = spread.trials - spread.unstable
    low, high = success_interval(stable, spread.trials, CONFIDENCE)
    margins = [] if quantity is MarginQuantity.STABILITY else _levels(spread, quantity)
    return [
        Text([
            f"over trials of {PurePath(spread.campaign).name}: ", *_who(report, loop),
            f" stable in {stable} of {spread.trials} ({100 * CONFIDENCE:g} % interval ",
            Percentage(low), " to ", Percentage(high), " %)", *margins,
        ])
    ]  # fmt: skip


def _is_margin(requirement: MarginRequirement) -> bool:
    return (
        requirement.value is not None
        if requirement.quantity is not MarginQuantity.STABILITY
        else requirement.passed is False
    )


def _reserve(requirement: MarginRequirement) -> float:
    if requirement.quantity is MarginQuantity.STABILITY or requirement.value is None:
        return UNSTABLE
    other = requirement.as_feedthrough
    known = requirement.value if other is None or other.value is None else min(requirement.value, other.value)
    return relative_reserve(known, requirement.limit, None)


def _who(report: StabilityStudy, subject: LoopReport | JointReport) -> list[Inline]:
    return [link(report, subject), f" at {subject.point}"]


def _value(nearest: JudgedRequirement) -> list[Inline]:
    subject, requirement = nearest
    if _reserve(requirement) != UNSTABLE:
        return [f"{requirement.title} ", *_inline(crossing_text(requirement)), ", limit ", *_inline(limit(requirement))]
    spread = subject.dispersion if isinstance(subject, LoopReport) and requirement.scope is Scope.DISPERSED else None
    return ["unstable" if spread is None else f"unstable in {spread.unstable} of {spread.trials} trials"]


def _levels(spread: Dispersion, quantity: MarginQuantity) -> list[Inline]:
    levels = spread.levels(quantity)
    unit = display_unit(quantity.unit)
    return [f", {quantity} at least ", size(levels["least"]), ", median ", size(levels["50 %"]), f" {unit}".rstrip()]


def _inline(cell: Phrase | Inline) -> list[Inline]:
    return list(cell.content) if isinstance(cell, Phrase) else [cell]


def _least_disk(loop: LoopReport) -> float:
    assert loop.dispersion is not None
    return float(min(loop.dispersion.sizes(MarginQuantity.DISK)))
