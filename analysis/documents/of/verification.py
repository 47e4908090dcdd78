"""Document of verified files: experiments, notes, verdicts; and the problems found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

from ....common.visible import limit_lines, on_one_line
from ...evidence.reference_comparison import SignalCheck
from ...evidence.reproduction import Reproduction
from ...evidence.verification import Verification
from ..common.quantities import number
from ..model import Document, Node, Text

VERIFIED, COMPARED, DIFFERENT = "verified", "compared", "different"  # verdicts
NAMED = 6  # listed signals of an experiment that differ


def verification_document(files: Sequence[Verification]) -> Document:
    """Return the document of verified files: each experiment, notes, and which files are unaltered."""
    nodes: list[Node] = []
    for each in files:
        nodes += [Text(f"{each.file}: {_summary(reproduction)}") for reproduction in each.reproductions]
        nodes += [Text(f"{each.file}: {name}: report reproduced") for name in each.reproduced]
        nodes += [Text(f"{each.file}: note: {note}", is_wrapped=True) for note in each.notes]
        nodes += [Text(f"{each.file}: {_verdict(each)}")] if not _problems(each) else []
    json = [{**asdict(each), "verified": (verdict := _verdict(each)) == VERIFIED, "verdict": verdict} for each in files]
    return Document("Verified files", nodes, [], json)


def verification_problems(files: Sequence[Verification]) -> list[str]:
    """Return the problems of all files: altered, not reproduced, or insufficiently compared."""
    return [on_one_line(line) for each in files for line in (*_problems(each), *_weaknesses(each))]


def _summary(reproduction: Reproduction) -> str:
    subject = f"{reproduction.name}: {reproduction.references.rpartition('/')[2]}"
    compared = f"{subject}: {reproduction.samples} samples of {len(reproduction.signals)} signals"
    if not reproduction.signals:
        return f"{compared}: not compared"
    more = "; reference times lie between communication points: interpolated" if reproduction.interpolated else ""
    more += f"; not numbers, not compared: {', '.join(reproduction.not_compared)}" if reproduction.not_compared else ""
    widest = reproduction.widest
    more = (
        f"; tolerance up to {number(widest.tolerance, 2)} of the greatest magnitude, {widest.name}{more}"
        if widest.tolerance
        else f"; tolerance 0{more}"
    )
    if reproduction.exact:
        return f"{compared}: the same bits{more}"
    worst = reproduction.signals[0]
    if not worst.met:
        return f"{compared}: {sum(not each.met for each in reproduction.signals)} signals differ{more}"
    fraction = f"{number(worst.excess, 2)} of the tolerance"
    return f"{compared}: differ by at most {fraction}, {worst.name} at t = {number(worst.time)} s{more}"


def _verdict(verification: Verification) -> str:
    if _problems(verification):
        return DIFFERENT
    return COMPARED if _weaknesses(verification) else VERIFIED


def _weaknesses(verification: Verification) -> list[str]:
    return [
        f"{verification.file}: {reproduction.name}: compared, not verified: {weakness}"
        for reproduction in verification.reproductions
        for weakness in reproduction.weaknesses
    ]


def _problems(verification: Verification) -> list[str]:
    problems = [f"{verification.file}: {problem}" for problem in verification.problems]
    for reproduction in verification.reproductions:
        where = f"{verification.file}: {reproduction.name}"
        problems += [f"{where}: {problem}" for problem in reproduction.problems]
        wrong = [_difference(each) for each in reproduction.signals if not each.met]
        problems += [f"{where}: {line}" for line in limit_lines(wrong, NAMED, "signals")]
    return problems


def _difference(check: SignalCheck) -> str:
    permitted = f"{number(check.permitted, 3)} permitted" if check.permitted else "the same bits required"
    numbers = f"reference {check.reference!r}, simulated {check.actual!r}"
    return (
        f"{check.name} differs by {number(check.difference, 3)} at t = {number(check.time)} s: {numbers}; {permitted}"
    )
