"""Lines about a batch for a terminal: summary, worst trials of bounded metrics, meanings of statuses."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ....campaigns.definition.campaign import Metric
from ....campaigns.definition.expressions import Expression
from ....campaigns.definition.plan import BatchPlan
from ....campaigns.execute.campaign_result import CampaignResult
from ....campaigns.execute.evaluation import worst_statuses
from ....campaigns.execute.flyer import TrialResult
from ....campaigns.lost_trials import describe_lost_trials
from ....campaigns.metric_limits import worst_trial
from ....campaigns.plain_text import align_columns, short
from ....campaigns.summary import requirement_values
from ....campaigns.tables import unmet_lines
from ....campaigns.trials import TrialTable
from ....commands.campaigns import replay_of_folder
from ....runtime.flight.results import TIMED_OUT, with_meaning
from ..unmet import requirement_problems


def printed_lines(batch: CampaignResult, metrics: Sequence[str]) -> list[str]:
    """Return the summary with ``metrics``, by default the metrics of success and requirements, and further lines."""
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
            statuses = {item: None for text in texts for item in worst_statuses(text).items()}
            meanings |= {with_meaning(network, *item): None for item in statuses}
    return list(meanings)


def campaign_problems(result: CampaignResult, requirements: Sequence[Expression]) -> list[str]:
    """Return a line for each variant with failed or late simulations, and for each requirement that is not met."""
    lines = failure_lines(find_failed([result.rows]), result.plan, result.folder)
    limit = f"{result.plan.watch.timeout:g} s of `timeout`" if result.plan.watch.timeout is not None else ""
    for variant, entry in result.summary.items():
        count = sum(count for status, count in entry.statuses.items() if status.startswith(TIMED_OUT))
        lines += [f"{variant}: {count} simulations took longer than the {limit}; give a longer one"] if count else []
    lines += [f"{line}; `retry_crashed` simulates them again" for line in describe_lost_trials(result.summary)]
    values = requirement_values(result.summary)
    # a status that no trial has is missing from the summary and counts 0
    values |= {name: 0.0 for requirement in requirements for name in requirement.names - set(values)}
    return [*lines, *requirement_problems(requirements, values), *unmet_lines(result.summary)]


class Failures(NamedTuple):
    """Failed simulations of a variant: their number, and trial and message of the first."""

    flights: int
    trial: int
    message: str


def find_failed(parts: Iterable[Mapping[str, TrialTable]]) -> dict[str, Failures]:
    """Return the failures of each variant that has any; ``parts`` are tables by variant, in the order of trials."""
    failures: dict[str, Failures] = {}
    for rows in parts:
        for variant, own in rows.items():
            for columns in own.parts("trial", "message"):
                failed = np.flatnonzero(columns["message"] != "")
                if failed.size:
                    first = Failures(0, int(columns["trial"][failed[0]]), str(columns["message"][failed[0]]))
                    before = failures.get(variant, first)
                    failures[variant] = before._replace(flights=before.flights + failed.size)
    return failures


def failure_lines(failures: Mapping[str, Failures], plan: BatchPlan, folder: Path | None) -> list[str]:
    """Return a line for each variant with failed simulations, with the command that replays the first of them."""
    variants, lines = plan.campaign.variants(), []
    for variant, (flights, trial, message) in failures.items():
        replay = "" if folder is None else f"; see it: {replay_of_folder(folder, variants, variant, trial)}"
        lines.append(f"{variant}: {flights} simulations failed; trial {trial}: {message}{replay}")
    return lines


def outcome_lines(variant: str, trial: int, outcome: TrialResult, metrics: Iterable[Metric]) -> list[str]:
    """Return lines on the outcome of one trial of a variant: status, success, metrics."""
    success = "success" if outcome.success else "no success"
    cells = []
    for metric in metrics:
        value = outcome.metrics[metric.name]
        text = "none" if math.isnan(value) else f"{value:.6g}"
        cells.append([f"  {metric.name}", text, "" if metric.unit == "1" else metric.unit])
    lines = [line.rstrip() for line in align_columns(cells)] if cells else []
    return [f"{variant}: trial {trial}: {outcome.status}, {success}", *lines]
