"""Lines about a batch for a terminal: summary, worst trials of bounded metrics, meanings of statuses."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ....campaigns.definition.plan import BatchPlan
from ....campaigns.execute.evaluation import worst_statuses
from ....campaigns.execute.results import CampaignResult
from ....campaigns.judged import worst_trial
from ....campaigns.plain_text import short
from ....commands.campaigns import replay_of_folder
from ....runtime.flight.results import with_meaning


def printed_lines(batch: CampaignResult, metrics: Sequence[str]) -> list[str]:
    """Return the summary with ``metrics`` (default: those of success and requirements), followed by further lines."""
    return [*batch.text(metrics).splitlines(), *worst_lines(batch), *status_meanings(batch.plan, batch)]


def worst_lines(batch: CampaignResult) -> list[str]:
    """Return a line for each metric bounded by a requirement: its worst trial, and the command that replays it.

    Only a stored campaign has lines, because the command reads its folder. Of equal trials the first is named.
    """
    lines: dict[str, None] = {}
    if batch.folder is None:
        return []
    for variant, entry in batch.summary.items():
        for bound in (each.bound for each in entry.requirements.values() if each.bound is not None):
            trial, value = worst_trial(
                batch.rows[variant], bound.metric, np.negative if bound.side == "lower" else np.positive
            )
            unit = entry.metrics[bound.metric].unit
            text = "none" if math.isnan(value) else f"{short(value)} {'' if unit == '1' else unit}".strip()
            replay = replay_of_folder(batch.folder, batch.rows, variant, trial)
            lines[f"{variant}: worst {bound.metric}, {text}: {replay}"] = None
    return list(lines)


def status_meanings(plan: BatchPlan, result: CampaignResult) -> list[str]:
    """Return the meaning of each reported status once, as stated by its FMU."""
    meanings: dict[str, None] = {}
    for variant in plan.campaign.variants():
        texts = dict.fromkeys(text for text in result.summary[variant.name].statuses if worst_statuses(text))
        if texts:
            network = plan.prepare(variant).network
            seen = {item: None for text in texts for item in worst_statuses(text).items()}
            meanings |= {with_meaning(network, *item): None for item in seen}
    return list(meanings)
