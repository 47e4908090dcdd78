"""Trials of a batch to inspect: first failures, worst trials of metrics with limits, maxima."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ....campaigns.execute.campaign_result import CampaignResult
from ....campaigns.trials import TrialTable
from ....commands.campaigns import replay_command, replay_of_folder
from ...cell import Cell
from ..campaign.replays import FAILURES, Replay, value_reason, with_anchors, worst_reasons
from ..campaign.verdict_table import VerdictTable

Reasons = list[tuple[int, Cell]]  # trials with a reason each


def trials_to_replay(result: CampaignResult, table: VerdictTable) -> list[Replay]:
    """Return, with anchors, the first failures of each variant and its worst trials of metrics with limits."""
    worst = {row.variant: worst_reasons(row, table.metrics) for row in table.rows}
    return with_anchors(_replays(result, lambda result, variant: _failures(result, variant) + worst[variant]))


def extremes_to_replay(result: CampaignResult) -> list[Replay]:
    """Return the trials in which a metric of a variant has its maximum, each trial once."""
    return _replays(result, _extremes)


def _replays(result: CampaignResult, choose: Callable[[CampaignResult, str], Reasons]) -> list[Replay]:
    replays: list[Replay] = []
    for variant in result.plan.campaign.variants():
        reasons: dict[int, list[Cell]] = {}
        for trial, reason in choose(result, variant.name):
            reasons.setdefault(trial, []).append(reason)
        for trial, texts in reasons.items():
            if result.folder is None:
                command = replay_command(result.plan, variant, trial)
            else:
                command = replay_of_folder(result.folder, result.rows, variant.name, trial)
            replays.append(Replay(variant.name, trial, texts, command))
    return replays


def _failures(result: CampaignResult, variant: str) -> Reasons:
    failures: Reasons = []
    for part in result.rows[variant].parts("trial", "success", "status"):
        for row in np.flatnonzero(~part["success"])[: FAILURES - len(failures)]:
            failures.append((int(part["trial"][row]), str(part["status"][row])))
        if len(failures) == FAILURES:
            break
    return failures


def _extremes(result: CampaignResult, variant: str) -> Reasons:
    """Return the trial with the maximum of each metric, unless several trials have it."""
    extremes: Reasons = []
    for metric in result.plan.campaign.metrics:
        maximum, trials = _maximum(result.rows[variant], f"metric.{metric.name}")
        if len(trials) == 1:
            extremes.append((trials[0], value_reason(metric, maximum)))
    return extremes


def _maximum(rows: TrialTable, column: str) -> tuple[float, list[int]]:
    """Return the maximum of a column (NaN counts as minus infinity), and at most two trials that have it."""
    maximum, trials = -np.inf, list[int]()
    for part in rows.parts("trial", column):
        values = np.where(np.isnan(part[column]), -np.inf, part[column])
        if values.max() > maximum:
            maximum, trials = float(values.max()), []
        trials += part["trial"][np.flatnonzero(values == maximum)[: 2 - len(trials)]].tolist()
    return maximum, trials
