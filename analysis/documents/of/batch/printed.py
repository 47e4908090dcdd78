"""Lines that a terminal shows of a batch: its summary, worst trials of bounded metrics, meanings of statuses."""

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
    """Return the summary with ``metrics``, by default those of success and requirements, and the lines below it."""
    return [*batch.text(metrics).splitlines(), *worst_lines(batch), *status_meanings(batch.plan, batch)]


def worst_lines(batch: CampaignResult) -> list[str]:
    """Return a line for each metric that a requirement bounds: its worst trial, and the command that replays it.

    Lines are those of a stored campaign, whose folder the command reads. The first of several equal trials is named.
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
    """Return the meaning of each status that a trial reported, once, as its FMU states it."""
    meanings: dict[str, None] = {}
    for variant in plan.campaign.variants():
        texts = dict.fromkeys(text for text in result.summary[variant.name].statuses if worst_statuses(text))
        if texts:
            network = plan.prepare(variant).network
            seen = {item: None for text in texts for item in worst_statuses(text).items()}
            meanings |= {with_meaning(network, *item): None for item in seen}
    return list(meanings)
