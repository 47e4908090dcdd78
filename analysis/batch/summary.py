"""What came of a campaign: rates with their intervals, metrics over trials, as a dict and as text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import binomtest

from ..campaign.campaign import Metric

CONFIDENCE = 0.95


def success_interval(successes: int, trials: int, confidence: float = 0.95) -> tuple[float, float]:
    """Interval (low, high) of the probability of success after ``successes`` in ``trials`` independent trials.

    Clopper and Pearson's exact interval: it covers the true rate with at least ``confidence``
    whatever that rate is. Wilson's is shorter but covers less than it says near 0 and 1, and
    rates near 1 are what guidance is judged by. Raises ValueError unless 0 <= successes <= trials, trials >= 1.
    """
    interval = binomtest(successes, trials).proportion_ci(confidence, method="exact")
    return float(interval.low), float(interval.high)


@dataclass(frozen=True)
class TrialColumns:
    """The trials of one variant, one entry per trial: status, success and every metric by name."""

    statuses: Sequence[str]
    success: np.ndarray
    metrics: Mapping[str, np.ndarray]


def statistics(values: np.ndarray, unit: str) -> dict[str, Any]:
    """Count, mean, sample standard deviation, largest and smallest of the finite ``values`` (trials,).

    What cannot be had from so few values (the deviation from one, everything from none) is None.
    """
    finite = values[np.isfinite(values)]
    some = finite.size > 0
    return {
        "count": int(finite.size),
        "mean": float(np.mean(finite)) if some else None,
        "std": float(np.std(finite, ddof=1)) if finite.size > 1 else None,
        "max": float(np.max(finite)) if some else None,
        "min": float(np.min(finite)) if some else None,
        "unit": unit,
    }


def summarise_variant(trials: TrialColumns, metrics: Iterable[Metric]) -> dict[str, Any]:
    """The summary of one variant; ``metrics`` are over successful trials, ``metrics_all`` over all."""
    success = np.asarray(trials.success, dtype=bool)
    columns = {metric.name: (np.asarray(trials.metrics[metric.name], dtype=float), metric.unit) for metric in metrics}
    successes = int(success.sum())
    return {
        "trials": len(success),
        "success_rate": successes / len(success),
        "success_interval": list(success_interval(successes, len(success), CONFIDENCE)),
        "confidence": CONFIDENCE,
        "statuses": dict(sorted(Counter(trials.statuses).items())),
        "metrics_over": "successful trials",
        "metrics": {name: statistics(column[success], unit) for name, (column, unit) in columns.items()},
        "metrics_all": {name: statistics(column, unit) for name, (column, unit) in columns.items()},
    }


def summarise(variants: Mapping[str, TrialColumns], metrics: Sequence[Metric]) -> dict[str, Any]:
    """The summaries of all variants by name. Every variant has one trial or more."""
    return {name: summarise_variant(trials, metrics) for name, trials in variants.items()}


def requirement_values(summary: Mapping[str, Any]) -> dict[str, float]:
    """Every number of a summary under a dotted name, for requirements as expressions.

    ``variant.success_rate``, ``variant.success_interval[1]`` (low) and ``[2]`` (high),
    ``variant.metrics.NAME.mean`` and so on; numbers that could not be had are nan.
    """
    values: dict[str, float] = {}

    def walk(prefix: str, entry: Any) -> None:
        if isinstance(entry, Mapping):
            for key, inner in entry.items():
                walk(f"{prefix}.{key}" if prefix else key, inner)
        elif isinstance(entry, list):
            for index, inner in enumerate(entry):
                walk(f"{prefix}[{index + 1}]", inner)
        elif not isinstance(entry, str):
            values[prefix] = float("nan") if entry is None else float(entry)

    walk("", summary)
    return values


def aligned(rows: list[list[str]]) -> list[str]:
    """Rows of cells as lines, the first column to the left, the others to the right."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return [
        "  ".join(
            [row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True))]
        )
        for row in rows
    ]


def summary_text(summary: Mapping[str, Any]) -> str:
    """A summary as plain text for the terminal: success rates, then metrics of successful trials."""
    rates = [["variant", "trials", "success %", f"{100 * CONFIDENCE:g} % interval", "statuses"]]
    for name, variant in summary.items():
        low, high = variant["success_interval"]
        statuses = ", ".join(f"{count} {status}" for status, count in variant["statuses"].items())
        rate = f"{100 * variant['success_rate']:.2f}"
        rates.append([name, str(variant["trials"]), rate, f"{100 * low:.2f} to {100 * high:.2f}", statuses])
    lines = aligned(rates)
    columns = ("mean", "std", "min", "max")
    cells = [["metric, successful trials", "variant", *columns, "unit"]]
    for metric in dict.fromkeys(metric for variant in summary.values() for metric in variant["metrics"]):
        for name, variant in summary.items():
            found = variant["metrics"][metric]
            numbers = ["-" if found[column] is None else f"{found[column]:.4g}" for column in columns]
            cells.append([metric, name, *numbers, found["unit"]])
    if len(cells) > 1:
        lines += ["", *aligned(cells)]
    return "\n".join(lines)
