"""Which draws go with which metrics, for the page of a batch."""

from __future__ import annotations

from typing import NamedTuple

from ...campaigns.draws.declared import drawn_names
from ...campaigns.fly.results import BatchResult
from ...studies.sensitivity.ranks import rank_correlations

TOLD = 3  # draws of a metric


class Driver(NamedTuple):
    """A metric of a variant, and the draws that it goes with most: their names and rank correlations."""

    variant: str
    metric: str
    draws: list[tuple[str, float]]


def drivers(result: BatchResult) -> list[Driver]:
    """A row for every metric of every variant that has any rank correlation, the largest first."""
    names = drawn_names(result.plan.campaign)
    rows = []
    for variant, seen in result.shown.items():
        trials = seen.first
        draws = {name: trials.draws[name] for name in names}
        for metric, found in rank_correlations(draws, trials.metrics).items():
            known = [(name, rho) for name, rho in found.items() if rho is not None]
            known.sort(key=lambda item: -abs(item[1]))
            if known:
                rows.append(Driver(variant, metric, known[:TOLD]))
    return rows
