"""Metrics of trials from their records, and whether they make them successes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from .campaign import Metric
from .expressions import Expression
from .reductions import EVER, REDUCTIONS, ReductionRule, reduce_rows

TIME = "time"  # the name under which expressions see the record's times, s


def names_needed(metrics: Iterable[Metric], drawn: Iterable[str]) -> set[str]:
    """Return recorded signals and parameters that the metrics refer to: all their names but times and draws."""
    return {name for metric in metrics for name in metric.names} - set(drawn) - {TIME}


def evaluate_metric(
    metric: Metric, times: np.ndarray, values: Mapping[str, np.ndarray | float], ends: np.ndarray
) -> np.ndarray:
    """Evaluate one metric of consecutive flights (flights,), whose rows end before ``ends``.

    ``times`` are in s, one per row; ``values`` arrays over rows, or floats. NaN for a flight without a row in the
    window, as when it ended before it. Raises InputError for a name that ``values`` lacks.
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
    """Return True if a metric needs no other row of a flight than the last one."""
    return metric.reduction == "final" and metric.window is None


def successes(success: Expression, metrics: Mapping[str, np.ndarray], trials: int) -> np.ndarray:
    """Return the trials that the metrics (trials,) make successes. A metric of the expression
    that is not finite makes a failure."""
    value = np.broadcast_to(success.evaluate(metrics), (trials,))
    return np.all(np.isfinite([value, *(metrics[name] for name in success.names)]), axis=0) & (value != 0.0)
