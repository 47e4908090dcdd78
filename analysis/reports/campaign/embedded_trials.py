"""The trials of a batch inside its page: what a dot stands for, and the command that simulates it again."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ...campaigns.draws.declared import input_names
from ...campaigns.fly.results import BatchResult
from ...campaigns.replay_command import replay_command, replay_of_folder
from ..common.quantities import display_factor, display_unit
from ..interactive.columns import Coarse

NUMBER_LIMIT = 2_500_000  # in all, of draws and metrics
EXACT_LIMIT = 200  # failures of a variant whose numbers are exact
MARK = 987_654_321  # a trial's number that no other text of a command has


def trials_document(result: BatchResult) -> dict[str, Any]:
    """All that the page's script needs: quantities with their units, and the trials of each variant.

    Draws and metrics are in 16 bits over the range of their column; of the first failures, and of the trials with the
    least and the greatest value of a metric, they are exact. Beyond `NUMBER_LIMIT` the last trials are left out.
    """
    campaign = result.plan.campaign
    units = {f"metric.{metric.name}": metric.unit for metric in campaign.metrics}
    names = [*units, *(f"draw.{name}" for name in input_names(campaign))]
    limit = NUMBER_LIMIT // max(1, len(names) * len(result.rows))
    return {
        "quantities": [
            {"name": name, "unit": display_unit(units.get(name)), "factor": display_factor(units.get(name))}
            for name in names
        ],
        "variants": [_variant(result, variant, names, limit) for variant in result.rows],
        "exact": EXACT_LIMIT,
    }


def _variant(result: BatchResult, variant: str, names: list[str], limit: int) -> dict[str, Any]:
    plotted = result.shown[variant]
    dots = plotted.dots
    rows = slice(0, limit)
    columns = [dots.column(name)[rows] for name in names]
    statuses = sorted(set(dots.statuses[rows]))
    before, after = _command(result, variant).split(str(MARK))
    return {
        "name": variant,
        "command": [before, after],
        "trial": np.asarray(plotted.numbers[rows], dtype=float),
        "success": dots.success[rows].astype(float),
        "statuses": statuses,
        "status": np.array([statuses.index(each) for each in dots.statuses[rows]], dtype=float),
        "columns": [Coarse(column) for column in columns],
        "exact": {
            str(row): [float(column[row]) if np.isfinite(column[row]) else str(column[row]) for column in columns]
            for row in _exact_rows(dots.success, columns[: len(result.plan.campaign.metrics)], limit)
        },
        "omitted": plotted.trials - len(columns[0]) if columns else 0,
    }


def _exact_rows(success: np.ndarray, metrics: Iterable[np.ndarray], limit: int) -> list[int]:
    """The rows of the first failures, and of the extremes of metrics."""
    rows = set(np.flatnonzero(~success[:limit])[:EXACT_LIMIT].tolist())
    for column in metrics:
        finite = np.flatnonzero(np.isfinite(column))
        if finite.size:
            rows |= {int(finite[np.argmin(column[finite])]), int(finite[np.argmax(column[finite])])}
    return sorted(rows)


def _command(result: BatchResult, variant: str) -> str:
    if result.folder is not None:
        return replay_of_folder(result.folder, result.rows, variant, MARK)
    (named,) = [each for each in result.plan.campaign.variants() if each.name == variant]
    return replay_command(result.plan, named, MARK)
