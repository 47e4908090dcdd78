"""Trials of a batch inside its page: the trial behind each dot, and the command that replays it."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import count
from typing import TypedDict

import numpy as np

from ....campaigns.draws.interfaces import input_names
from ....campaigns.execute.campaign_result import CampaignResult
from ....commands.campaigns import replay_command, replay_of_folder
from ...common.quantities import display_factor, display_unit, number
from ...interactive.columns import Coarse

NUMBER_LIMIT = 2_500_000  # largest number of draws and metrics of all trials
EXACT_LIMIT = 200  # failures of a variant with exact numbers


class TrialQuantity(TypedDict):
    """A metric or sampled input, by column name; its numbers are in SI, and ``factor`` converts them to ``unit``."""

    name: str
    unit: str
    factor: float


class VariantTrials(TypedDict):
    """The trials of a variant as columns.

    ``command`` is the text before and after a trial's number in its replay command. ``status`` are indices of
    ``statuses``. ``exact`` contains numbers by row; non-finite ones are texts.
    """

    name: str
    command: tuple[str, str]
    trial: np.ndarray
    success: np.ndarray
    statuses: list[str]
    status: np.ndarray
    columns: list[Coarse]
    exact: dict[str, list[float | str]]


class TrialsDocument(TypedDict):
    """The trials of a batch, and the quantities for which each variant has a column."""

    quantities: list[TrialQuantity]
    variants: list[VariantTrials]


def trials_document(batch: CampaignResult) -> TrialsDocument:
    """Return the data for the page's script: quantities with their units, and the trials of each variant.

    Inputs and metrics have 16 bits over the range of their column; they are exact for the first failures and for the
    trials with the extremes of a metric. Beyond `NUMBER_LIMIT` numbers the last trials are omitted.
    """
    units = {f"metric.{metric.name}": metric.unit for metric in batch.plan.campaign.metrics}
    names = _column_names(batch)
    limit = _row_limit(batch)
    return {
        "quantities": [
            {"name": name, "unit": display_unit(units.get(name)), "factor": display_factor(units.get(name))}
            for name in names
        ],
        "variants": [_variant(batch, variant, names, limit) for variant in batch.rows],
    }


def trials_notes(batch: CampaignResult) -> list[str]:
    """Return a page's notes on the numbers shown at its marks."""
    notes = [
        "A mark, or a point of a distribution, names its trial; a click pins it with its replay command, a drag "
        f"selects trials in all figures. Numbers of the first {EXACT_LIMIT} failures of each variant and of trials "
        'with an extreme metric are exact; others are rounded and marked "about".'
    ]
    for variant, plotted in batch.plotted.items():
        rows = min(_row_limit(batch), len(plotted.dots.trial))
        if rows < plotted.trials:
            notes.append(f"{variant}: {number(rows)} of {number(plotted.trials)} trials can be selected.")
    return notes


def _column_names(batch: CampaignResult) -> list[str]:
    campaign = batch.plan.campaign
    metrics = (f"metric.{metric.name}" for metric in campaign.metrics)
    return [*metrics, *(f"draw.{name}" for name in input_names(campaign))]


def _row_limit(batch: CampaignResult) -> int:
    """Return the maximum number of trials of a variant on a page."""
    return NUMBER_LIMIT // max(1, len(_column_names(batch)) * len(batch.rows))


def _variant(batch: CampaignResult, variant: str, names: list[str], limit: int) -> VariantTrials:
    plotted = batch.plotted[variant]
    dots = plotted.dots
    rows = slice(0, limit)
    columns = [dots.column(name)[rows] for name in names]
    statuses = sorted(set(dots.statuses[rows]))
    return {
        "name": variant,
        "command": _command_around(batch, variant),
        "trial": np.asarray(plotted.dots.trial[rows], dtype=float),
        "success": dots.success[rows].astype(float),
        "statuses": statuses,
        "status": np.array([statuses.index(each) for each in dots.statuses[rows]], dtype=float),
        "columns": [Coarse(column) for column in columns],
        "exact": {
            str(row): [float(column[row]) if np.isfinite(column[row]) else number(column[row]) for column in columns]
            for row in _exact_rows(dots.success, columns[: len(batch.plan.campaign.metrics)], limit)
        },
    }


def _exact_rows(success: np.ndarray, metrics: Iterable[np.ndarray], limit: int) -> list[int]:
    """Return the rows of the first failures and of the extremes of metrics."""
    rows = set(np.flatnonzero(~success[:limit])[:EXACT_LIMIT].tolist())
    for column in metrics:
        finite = np.flatnonzero(np.isfinite(column))
        if finite.size:
            rows |= {int(finite[np.argmin(column[finite])]), int(finite[np.argmax(column[finite])])}
    return sorted(rows)


def _command_around(batch: CampaignResult, variant: str) -> tuple[str, str]:
    """Return the text of a replay command before and after the number of the trial."""
    any_command = _command(batch, variant, 0)
    mark = next(number for number in count(10**9) if str(number) not in any_command)
    before, after = _command(batch, variant, mark).split(str(mark))
    return before, after


def _command(batch: CampaignResult, variant: str, trial: int) -> str:
    if batch.folder is not None:
        return replay_of_folder(batch.folder, batch.rows, variant, trial)
    (named,) = [each for each in batch.plan.campaign.variants() if each.name == variant]
    return replay_command(batch.plan, named, trial)
