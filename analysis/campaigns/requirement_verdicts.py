"""Verdicts on the campaign's requirements from a variant's trials, and the trial after which all are decided."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...common.to_json import optional
from .definition.requirements import SUCCESS, Requirement
from .trials import TrialTable
from .verdicts.acceptance import FURTHER, AcceptanceVerdict, FixedSize
from .verdicts.order_statistics import tolerance_bound
from .verdicts.stopping import StoppingRule, stopping_rule

FIXED_SIZE, UNTIL_DECIDED = "fixed size", "until decided"


@dataclass(frozen=True)
class ToleranceBound:
    """Tolerance bound ``value`` of a requirement's metric, on its ``side`` ("upper" or "lower"); may be infinite.

    It is the ``rank``-th worst value of the first ``flights`` trials. With too few trials, value and rank are None, and
    ``flights_to_decide`` is the number of further trials that are needed.
    """

    metric: str
    side: str
    value: float | None
    rank: int | None
    flights: int
    flights_to_decide: int


@dataclass(frozen=True)
class RequirementVerdict:
    """Verdict on one requirement from the trials of one variant.

    ``text`` is the requirement as declared: a ``share`` of all simulations satisfies it, shown with ``confidence``.
    ``rule`` is `FIXED_SIZE` or `UNTIL_DECIDED`. ``decided_after`` is a number of trials, None if undecided.
    ``flights_to_decide`` maps the numbers 0, 1 and 2 of failures in further trials to the number of further trials that
    would meet the requirement; its values are None if the requirement is decided. ``bound`` is None unless the
    requirement is on one metric. ``unevaluated`` lists the metrics of the requirement that are nan in every trial; None
    if there are no such metrics.
    """

    text: str
    share: float
    confidence: float
    rule: str
    flights: int
    failures: int
    consumer_risk: float
    verdict: AcceptanceVerdict
    decided_after: int | None
    flights_to_decide: Mapping[int, int | None]
    bound: ToleranceBound | None
    unevaluated: tuple[str, ...] | None = optional()


def satisfies(requirement: Requirement, trials: TrialTable) -> np.ndarray:
    """Return True for each trial that satisfies a requirement; a trial with a non-finite metric does not."""
    names = {name: f"metric.{name}" for name in requirement.expression.names} | {SUCCESS: "success"}
    satisfied = []
    for part in trials.parts(*names.values()):
        columns = {name: np.asarray(part[column], dtype=float) for name, column in names.items()}
        values = np.broadcast_to(requirement.expression.evaluate(columns), columns[SUCCESS].shape)
        finite = np.isfinite([values, *(columns[name] for name in requirement.expression.names)])
        satisfied.append(np.all(finite, axis=0) & (values != 0.0))
    return np.concatenate(satisfied)


def requirement_verdict(
    requirement: Requirement, trials: TrialTable, until_decided: bool = False
) -> RequirementVerdict:
    """Return the verdict on one requirement from a variant's trials, in order.

    Set ``until_decided`` if the campaign may have stopped as soon as its requirements were decided: verdict, risk and
    bound then follow `StoppingRule`, otherwise `FixedSize`.
    """
    rule_of = stopping_rule if until_decided else FixedSize
    rule = rule_of(requirement.share, requirement.confidence)
    satisfied = satisfies(requirement, trials)
    flights, failures = len(satisfied), int(np.count_nonzero(~satisfied))
    decision = rule.decision(satisfied)
    is_decided = decision.verdict is not AcceptanceVerdict.UNDECIDED
    return RequirementVerdict(
        text=str(requirement),
        share=requirement.share,
        confidence=requirement.confidence,
        rule=UNTIL_DECIDED if until_decided else FIXED_SIZE,
        flights=flights,
        failures=failures,
        consumer_risk=decision.consumer_risk,
        verdict=decision.verdict,
        decided_after=decision.flights if is_decided else None,
        flights_to_decide=dict.fromkeys(FURTHER) if is_decided else rule.flights_to_meet(flights, failures),
        bound=None if requirement.metric is None else _bound(requirement, requirement.metric, trials, flights, rule),
        unevaluated=_find_unevaluated(requirement, trials) if failures == flights > 0 else None,
    )


def _find_unevaluated(requirement: Requirement, trials: TrialTable) -> tuple[str, ...] | None:
    """Return the metrics of a requirement that are nan in every trial; None if there are no such metrics."""
    names = sorted(requirement.expression.names - {SUCCESS})
    read = list(trials.parts(*(f"metric.{name}" for name in names)))
    missing = [name for name in names if all(np.isnan(columns[f"metric.{name}"]).all() for columns in read)]
    return tuple(missing) or None


def _bound(
    requirement: Requirement, metric: str, trials: TrialTable, total: int, rule: FixedSize | StoppingRule
) -> ToleranceBound:
    flights, permitted = rule.count_permitted(total)
    value = tolerance_bound(trials.blocks(f"metric.{metric}"), flights, permitted, requirement.bound == "upper")
    return ToleranceBound(
        metric=metric,
        side=requirement.bound,
        value=value,
        rank=None if value is None else permitted + 1,
        flights=flights,
        flights_to_decide=rule.flights_to_meet(total, 0)[0] if value is None else 0,
    )


def trials_to_decision(requirements: Sequence[Requirement], trials: Mapping[str, Sequence[np.ndarray]]) -> int | None:
    """Return the number of trials after which every requirement is decided for every variant, or None.

    ``trials`` contains, by variant and for each requirement, whether the first trials satisfy it, in order and without
    gaps. The result does not depend on later trials: it is the last interim analysis that any requirement needed. None
    is returned if a requirement is undecided.
    """
    decisions = [
        stopping_rule(requirement.share, requirement.confidence).decision(satisfied)
        for columns in trials.values()
        for requirement, satisfied in zip(requirements, columns, strict=True)
    ]
    if not decisions or any(decision.verdict is AcceptanceVerdict.UNDECIDED for decision in decisions):
        return None
    return max(decision.flights for decision in decisions)
