"""Whether the trials of a variant meet the campaign's requirements, and after which trial all of it is decided."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .rows import TrialRows, blocks
from .spec.requirements import SUCCESS, Requirement
from .verdicts.acceptance import FURTHER, FixedSize, Verdict
from .verdicts.stopping import StoppingRule, stopping_rule
from .verdicts.tolerance import tolerance_bound

FIXED_SIZE, UNTIL_DECIDED = "fixed size", "until decided"


def kept(requirement: Requirement, trials: TrialRows) -> np.ndarray:
    """In which trials a requirement was kept, booleans; where a metric of it is not finite it was not."""
    names = {name: f"metric.{name}" for name in requirement.expression.names} | {SUCCESS: "success"}
    found = []
    for part in trials.parts(*names.values()):
        columns = {name: np.asarray(part[column], dtype=float) for name, column in names.items()}
        values = np.broadcast_to(requirement.expression.evaluate(columns), columns[SUCCESS].shape)
        finite = np.isfinite([values, *(columns[name] for name in requirement.expression.names)])
        found.append(np.all(finite, axis=0) & (values != 0.0))
    return np.concatenate(found)


def requirement_verdict(requirement: Requirement, trials: TrialRows, until_decided: bool = False) -> dict[str, Any]:
    """The verdict on one requirement by a variant's trials, in order of trial.

    ``text``, ``share``, ``confidence``, ``rule`` ("fixed size", "until decided"), ``flights``, ``failures``,
    ``consumer_risk``, ``verdict`` ("met", "not met", "undecided"), ``decided_after`` (flights; None where undecided),
    ``flights_to_decide`` (how many more would meet it with "0", "1", "2" failures in them; None once it is decided) and
    ``bound`` (`_bound`, or None).

    With ``until_decided``, as where the campaign may have ended because it was decided, all of it is by `StoppingRule`.
    """
    rule = stopping_rule(requirement.share, requirement.confidence) if until_decided else _fixed(requirement)
    passed = kept(requirement, trials)
    flights, failures = len(passed), int(np.count_nonzero(~passed))
    decision = rule.decision(passed)
    decided = decision.verdict is not Verdict.UNDECIDED
    missing = dict.fromkeys(FURTHER) if decided else rule.flights_to_meet(flights, failures)
    return {
        "text": str(requirement),
        "share": requirement.share,
        "confidence": requirement.confidence,
        "rule": UNTIL_DECIDED if until_decided else FIXED_SIZE,
        "flights": flights,
        "failures": failures,
        "consumer_risk": decision.consumer_risk,
        "verdict": str(decision.verdict),
        "decided_after": decision.flights if decided else None,
        "flights_to_decide": {str(more): number for more, number in missing.items()},
        "bound": None if requirement.metric is None else _bound(requirement, trials, flights, rule),
    }


def _fixed(requirement: Requirement) -> FixedSize:
    return FixedSize(requirement.share, requirement.confidence)


def _bound(requirement: Requirement, trials: TrialRows, total: int, rule: FixedSize | StoppingRule) -> dict[str, Any]:
    """The tolerance bound of a requirement's metric: ``metric``, ``side``, and ``value``, "inf" or "-inf" if infinite.

    ``rank`` says that it is the worst value, 1, or the second worst, 2, and so on, of the first ``flights``. Value and
    rank are None where the flights are too few, and ``flights_to_decide`` is how many more would have one.
    """
    assert requirement.metric is not None
    flights, permitted = rule.permitted(total)
    value = tolerance_bound(
        blocks(trials, f"metric.{requirement.metric}"), flights, permitted, requirement.bound == "upper"
    )
    return {
        "metric": requirement.metric,
        "side": requirement.bound,
        "value": value if value is None or np.isfinite(value) else str(value),
        "rank": None if value is None else permitted + 1,
        "flights": flights,
        "flights_to_decide": rule.flights_to_meet(total, 0)[0] if value is None else 0,
    }


def add_verdicts(
    summary: Mapping[str, dict[str, Any]],
    requirements: Sequence[Requirement],
    variants: Mapping[str, TrialRows],
    until_decided: bool = False,
) -> None:
    """Put ``requirements`` into the summary of each variant, the verdicts by name; nothing where there are none."""
    if requirements:
        for name, trials in variants.items():
            summary[name]["requirements"] = {
                requirement.name: requirement_verdict(requirement, trials, until_decided)
                for requirement in requirements
            }


def decided_after(requirements: Sequence[Requirement], flown: Mapping[str, Sequence[np.ndarray]]) -> int | None:
    """After how many trials every requirement of every variant is decided; None while one is not.

    ``flown`` says by variant in which of their first trials each requirement was `kept`, in order of trial and without
    a gap, of as many as have flown: the answer does not depend on how many more there are. Every one decided is the
    last look that any of them took.
    """
    found = [
        stopping_rule(requirement.share, requirement.confidence).decision(passed)
        for trials in flown.values()
        for requirement, passed in zip(requirements, trials, strict=True)
    ]
    if not found or any(decision.verdict is Verdict.UNDECIDED for decision in found):
        return None
    return max(decision.flights for decision in found)


def looks(requirements: Sequence[Requirement], most: int) -> list[int]:
    """All numbers of trials, up to ``most``, after which one of the requirements may be decided, ascending."""
    rules = [stopping_rule(requirement.share, requirement.confidence) for requirement in requirements]
    return sorted({flights for rule in rules for flights in rule.looks(most)})


def unmet_lines(summary: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """A line for each requirement of each variant that is not met or undecided: which, its figures, what is missing."""
    return [
        f"{variant}: requirement {name}: {found['text']}: {figures(found)}"
        for variant, entry in summary.items()
        for name, found in entry.get("requirements", {}).items()
        if found["verdict"] != Verdict.MET
    ]


def figures(found: Mapping[str, Any]) -> str:
    """The verdict of a requirement in words, with what it rests on and, where undecided, what would decide it."""
    words = f"{found['verdict']}: {found['failures']} of {found['flights']} flights fail it"
    if found["verdict"] != Verdict.UNDECIDED:
        return words
    more = found["flights_to_decide"]
    longer = f"a campaign longer by {more['0']}, {more['1']} or {more['2']} flights"
    return f"{words}; {longer} would meet it with 0, 1 or 2 more failures"
