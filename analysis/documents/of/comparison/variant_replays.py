"""Trials of a comparison to inspect: failures in which other variants succeed, and worst values of metrics."""

from __future__ import annotations

import numpy as np

from ....campaigns.compare.campaign_comparison import CampaignComparison
from ....campaigns.folder.campaign_manifest import FILE as MANIFEST
from ....commands.campaigns import replay_of_folder
from ...cell import Cell
from ..campaign.replays import FAILURES, Replay, with_anchors, worst_reasons
from ..campaign.verdict_table import VerdictTable


def trials_to_replay(comparison: CampaignComparison, table: VerdictTable) -> list[Replay]:
    """Return the first failures of each variant, with the number of others that succeed, and its worst trials."""
    worst = {row.variant: worst_reasons(row, table.metrics) for row in table.rows}
    replays: list[Replay] = []
    for label, contender in comparison.contenders.items():
        stored, trials = contender.stored, contender.trials
        if not (stored.folder / MANIFEST).is_file():
            continue
        by_trial: dict[int, list[Cell]] = {}
        others = [other.trials.success for name, other in comparison.contenders.items() if name != label]
        for row in np.flatnonzero(~trials.success)[:FAILURES]:
            reasons: list[Cell] = [str(trials.statuses[row])]
            if others:
                count = sum(bool(success[row]) for success in others)
                reasons.append(f"{count} of {len(others)} others succeed")
            by_trial[int(trials.trial[row])] = reasons
        for trial, reason in worst[label]:
            by_trial.setdefault(trial, []).append(reason)
        for trial, reasons in by_trial.items():
            command = replay_of_folder(stored.folder, stored.variants, contender.name, trial)
            replays.append(Replay(label, trial, reasons, command))
    return with_anchors(replays)
