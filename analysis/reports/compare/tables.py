"""Rows of the comparison's tables: pairs of variants on the same trials, dispersed parameters, replays of failures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np
from markupsafe import Markup

from ...campaigns.compare.comparison import Comparison, name_of
from ...campaigns.compare.paired import PairedRates, PairedValues
from ...campaigns.definition.campaign import Metric
from ...campaigns.folder.manifest import FILE as MANIFEST
from ...commands.campaigns import replay_of_folder
from ..campaign.tables import FAILURES, Replay, with_anchors, worst_reasons
from ..campaign.verdict_table import VerdictTable

T = TypeVar("T", PairedRates, PairedValues)


@dataclass(frozen=True)
class PairRow(Generic[T]):
    """Contenders A and B, and what their trials tell."""

    a: str
    b: str
    estimate: T

    @property
    def is_sure(self) -> bool:
        """Whether the interval of the difference does not contain 0."""
        interval = self.estimate.interval
        return interval is not None and not interval[0] <= 0.0 <= interval[1]


@dataclass(frozen=True)
class PairGroup(Generic[T]):
    """All pairs of one rate or metric: those against the reference, and the others."""

    name: str
    unit: str
    first: list[PairRow[T]]
    others: list[PairRow[T]]


def rate_pairs(comparison: Comparison) -> list[PairGroup[PairedRates]]:
    """A group per rate."""
    groups = []
    for rate in comparison.rates:
        rows = [PairRow(*pair, comparison.compare_rates(pair, rate)) for pair in comparison.pairs]
        groups.append(_group(comparison, name_of(rate), "1", rows))
    return groups


def metric_pairs(
    comparison: Comparison, metrics: Sequence[Metric], *, successful: bool
) -> list[PairGroup[PairedValues]]:
    """A group per metric, over the trials in which both succeed or over all."""
    groups = []
    for metric in metrics:
        pairs = [(pair, comparison.pair_values(pair, metric.name, successful=successful)) for pair in comparison.pairs]
        groups.append(_group(comparison, metric.name, metric.unit, [PairRow(*pair, values) for pair, values in pairs]))
    return groups


def _group(comparison: Comparison, name: str, unit: str, rows: list[PairRow[T]]) -> PairGroup[T]:
    first = [row for row in rows if comparison.against_reference((row.a, row.b))]
    return PairGroup(name, unit, first, [row for row in rows if row not in first])


def trials_to_replay(comparison: Comparison, table: VerdictTable) -> list[Replay]:
    """The first failures of each contender, with how many of the others succeed, and its worst trials of metrics."""
    worst = {row.variant: worst_reasons(row, table.metrics) for row in table.rows}
    replays: list[Replay] = []
    for label, contender in comparison.contenders.items():
        stored, trials = contender.stored, contender.trials
        if not (stored.folder / MANIFEST).is_file():
            continue
        by_trial: dict[int, list[Markup]] = {}
        others = [other.trials.success for name, other in comparison.contenders.items() if name != label]
        for row in np.flatnonzero(~trials.success)[:FAILURES]:
            trial = int(trials.trial[row])
            reasons = [Markup("{}").format(trials.statuses[row])]
            if others:
                count = sum(bool(success[row]) for success in others)
                reasons.append(Markup("{} of {} others succeed").format(count, len(others)))
            by_trial[trial] = reasons
        for trial, reason in worst[label]:
            by_trial.setdefault(trial, []).append(reason)
        for trial, reasons in by_trial.items():
            command = replay_of_folder(stored.folder, stored.variants, contender.name, trial)
            replays.append(Replay(label, trial, reasons, command))
    return with_anchors(replays)
