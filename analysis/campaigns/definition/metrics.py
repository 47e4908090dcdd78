"""Evaluation of metrics from the records of trials, and of success from metrics."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from .campaign import Metric
from .expressions import Expression
from .reductions import EVER, REDUCTIONS, ReductionRule, reduce_rows

TIME = "time"  # name of the record's times (s) in expressions


def names_needed(metrics: Iterable[Metric], drawn: Iterable[str]) -> set[str]:
    """Return the signals and parameters to which the metrics refer: all of their names except times and draws."""
    return {name for metric in metrics for name in metric.names} - set(drawn) - {TIME}


def evaluate_metric(
    metric: Metric, times: np.ndarray, values: Mapping[str, np.ndarray | float], ends: np.ndarray
) -> np.ndarray:
    """Return the values (simulations,) of a metric in consecutive simulations.

    The rows of a simulation end before its entry in ``ends``. ``times`` are in s, one for each row; ``values`` are
    arrays over rows, or floats. The metric is NaN if a simulation has no row in the window because it ended earlier.
    Raises InputError for a name that ``values`` lacks.
    """

    def rows_of(formula: Expression) -> np.ndarray:
        rows = formula.evaluate(values)
        return rows if isinstance(rows, np.ndarray) else np.full(times.shape, rows)

    signal = rows_of(metric.expression)
    condition = signal if metric.condition is None else rows_of(metric.condition)
    window, band = metric.window or EVER, metric.band or EVER
    rule = ReductionRule(
        REDUCTIONS.index(metric.reduction),
        (float(window[0]), float(window[1])),
        (float(band[0]), float(band[1])),
        float(metric.delay),
    )
    return reduce_rows(rule, times, signal, condition, ends)


def is_of_the_end(metric: Metric) -> bool:
    """Return True if a metric only needs the last row of a simulation."""
    return metric.reduction == "final" and metric.window is None


def successes(success: Expression, metrics: Mapping[str, np.ndarray], trials: int) -> np.ndarray:
    """Return, for each trial, True if it succeeds, from its metrics (trials,).

    A trial with a non-finite metric in the expression does not succeed.
    """
    value = np.broadcast_to(success.evaluate(metrics), (trials,))
    return np.all(np.isfinite([value, *(metrics[name] for name in success.names)]), axis=0) & (value != 0.0)
