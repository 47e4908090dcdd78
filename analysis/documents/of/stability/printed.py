"""Text of a stability study: a line for each loop, and for each requirement that is not met."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from ....stability.loops.margin_values import MARGINS, UNLIMITED, MarginQuantity
from ....stability.results.report import FailedStudy, JointReport, LoopReport, StabilityStudy
from ....stability.results.requirement import MarginRequirement, MarginVerdict
from ....stability.results.varied import SweepCrossing, SweepReport
from ...render.words import rich_text
from .orders import order_loops, order_sentences, withheld_line
from .tightest import tightest_nodes


def stability_lines(report: StabilityStudy) -> list[str]:
    """Return a study as lines of text: loops, notes on feedthrough, sweeps, verdict."""
    lines, others = list[str](), {(loop.name, loop.point): loop for loop in order_loops(report)}
    for loop in report.loops:
        lines += _lines(loop)
        if (other := others.get((loop.name, loop.point))) is not None:
            lines.append(f"  as feedthrough: {_margins(other)}")
    lines += [_verdict_line(lost) for lost in report.unstudied if lost.verdict is not None]
    lines += [f"note: {sentence}" for sentence in order_sentences(report)]
    lines += [_crossing_line(sweep, crossing) for sweep in report.sweeps for crossing in sweep.crossings]
    lines += [rich_text(node.content) for node in tightest_nodes(report)]
    return [*lines, f"{report.system}: {report.verdict}, {report.seconds:.1f} s"]


def stability_problems(report: StabilityStudy) -> list[str]:
    """Return a line for each requirement not met or withheld, and for everything that could not be studied."""
    judged = list(report.judgements())
    failures = [item for item in judged if item.requirement.verdict is MarginVerdict.FAIL]
    lines = [
        _failure_line(subject, requirement)
        for subject, requirement in failures
        if not requirement.unstable or isinstance(subject, JointReport)  # else another line reports the instability
    ]
    withheld = [item for item in judged if item.requirement.verdict is MarginVerdict.WITHHELD]
    lines += [withheld_line(report, subject, requirement) for subject, requirement in withheld]
    for loop in report.loops:
        if loop.is_contradicted and loop.verdict is MarginVerdict.NOT_APPLICABLE:
            why = f"linearised and measured responses differ, {loop.not_applicable['agreement']}"
            lines.append(f"loop {loop.name} at {loop.point}: not passed: {why}")
    lines += [f"{lost.what} {lost.name} at {lost.point}: {lost.text}" for lost in report.unstudied]
    if not lines and report.verdict is not MarginVerdict.PASS:
        lines.append(f"{report.system}: {report.verdict}")
    return lines


def _verdict_line(lost: FailedStudy) -> str:
    """Return the line of a loop that has a verdict but no margins."""
    verdict = f": {lost.verdict}" if lost.verdict is MarginVerdict.FAIL else ""
    return f"{lost.name} at {lost.point}: {lost.text}{verdict}"


def _failure_line(subject: LoopReport | JointReport, item: MarginRequirement) -> str:
    where = f"{'loops' if isinstance(subject, JointReport) else 'loop'} {subject.name} at {subject.point}"
    text = "of an unstable loop" if item.unstable else f"{item.value:.4g} {_unit(item)}".strip()
    note = f": {item.note}" if item.note else ""
    return f"{where}: {item.title} {text} misses the limit {item.limit:g} {_unit(item)}".strip() + note


def _unit(item: MarginRequirement) -> str:
    return "" if item.unit == "1" else item.unit


def _words(sizes: Mapping[MarginQuantity, float], sides: Mapping[MarginQuantity, str] | None = None) -> str:
    """Return margins as text, such as ``gain margin 12.39 dB, phase margin 44.28 deg``; ``sides`` gives a remark to
    append to each, such as ``(lower)``.
    """
    words = []
    for quantity, size in sizes.items():
        if size == UNLIMITED:
            words.append(f"no {quantity.split()[0]} crossing")
        else:
            text = f"{quantity} {size:.3f}" if quantity.unit == "1" else f"{quantity} {size:.2f} {quantity.unit}"
            words.append(f"{text} {(sides or {}).get(quantity, '')}".strip())
    return ", ".join(words)


def _margins(loop: LoopReport) -> str:
    margins = loop.margins
    sizes = {quantity: margins.size(quantity) for quantity in MARGINS}
    sides = {
        MarginQuantity.GAIN: "(lower)" if margins.gain < 1.0 else "",
        MarginQuantity.PHASE: "(lead)" if margins.phase < 0.0 else "",
    }
    return f"unstable, spectral radius {margins.largest:.4g}" if margins.unstable else _words(sizes, sides)


def _lines(loop: LoopReport) -> Iterator[str]:
    """Yield the line of a loop, followed by a line for each missing quantity, and one for the campaign."""
    words = _margins(loop)
    if loop.agreement is not None:
        words += (
            ", linearised and measured responses agree"
            if loop.agreement.agrees
            else ", linearised and measured responses differ"
        )
    yield f"{loop.name} at {loop.point}: {words}: {loop.verdict}"
    for name, reason in loop.not_applicable.items():
        if name != "agreement":  # reported on a separate line
            yield f"  {name}: {reason}"
    if (spread := loop.dispersion) is not None:
        if spread.unstable:
            repeated = f"worst trial {spread.worst}: {spread.replay}"
            text = f"{spread.unstable} of {spread.trials} trials unstable; {repeated}"
        else:
            minimum = {quantity: spread.levels(quantity)["least"] for quantity in MARGINS}
            text = f"{spread.trials} trials stable, minimum {_words(minimum)}"
        yield f"  over {Path(spread.campaign).name}: {text}"


def _crossing_line(sweep: SweepReport, crossing: SweepCrossing) -> str:
    side = "below" if crossing.below else "above"
    what = "unstable" if crossing.quantity is MarginQuantity.STABILITY else f"{crossing.quantity} misses its limit"
    return f"{sweep.name}: {what} {side} {sweep.parameter} = {crossing.value:.4g}"
