"""A trial's metrics from its record, and whether they make it a success."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping

import numpy as np

from .campaign import Metric
from .expressions import Expression

SIMPLE: dict[str, Callable[[np.ndarray], float]] = {
    "final": lambda values: values[-1],
    "min": np.minimum.reduce,
    "max": np.maximum.reduce,
    "mean": lambda values: np.add.reduce(values) / values.size,
    "rms": lambda values: np.sqrt(np.add.reduce(np.square(values)) / values.size),
}
TIME = "time"  # the name under which expressions see the record's times, s


def names_needed(metrics: Iterable[Metric], drawn: Iterable[str]) -> set[str]:
    """Recorded signals and parameters that the metrics refer to: all their names but times and draws."""
    return {name for metric in metrics for name in metric.names} - set(drawn) - {TIME}


def rows_in(window: tuple[float, float], times: np.ndarray) -> np.ndarray:
    """Which rows lie in the window (s), both ends included: booleans, one per row.

    Times are start + n h with rounding, so an end may be missed by a millionth of a step.
    """
    margin = _rounding(times)
    return (times >= window[0] - margin) & (times <= window[1] + margin)


def _rounding(times: np.ndarray) -> float:
    return 1e-6 * (times[1] - times[0]) if len(times) > 1 else 0.0


def last_outside(times: np.ndarray, values: np.ndarray, band: tuple[float, float]) -> float:
    """The last time (s) at which the values are outside the band, nan counting as outside.

    The first time when they never are, as then nothing is left to wait for; inf when they still
    are in the last row, as then they never settled.
    """
    outside = np.flatnonzero(~((values >= band[0]) & (values <= band[1])))
    if not outside.size:
        return float(times[0])
    return math.inf if outside[-1] == len(times) - 1 else float(times[outside[-1]])


def _holds(condition: np.ndarray) -> np.ndarray:
    """Where a condition is true: anything but 0 and nan."""
    return (condition != 0.0) & ~np.isnan(condition)


def settling_time(times: np.ndarray, condition: np.ndarray, start: float) -> float:
    """The time (s) from ``start`` to the first row from which on the condition holds to the last row.

    0 when it holds in every row, inf when it does not in the last one.
    """
    failing = np.flatnonzero(~_holds(condition))
    if not failing.size:
        return 0.0
    row = failing[-1] + 1
    return math.inf if row == len(times) else float(times[row]) - start


def first(times: np.ndarray, values: np.ndarray, condition: np.ndarray, delay: float) -> float:
    """The value in the first row where the condition holds, or in the first row ``delay`` (s) later or after that.

    Nan when the condition never holds or the rows end before the delay is over. A millionth of a step may be
    missing to the delay, since times are rounded.
    """
    holding = np.flatnonzero(_holds(condition))
    if not holding.size:
        return math.nan
    row = np.searchsorted(times, times[holding[0]] + delay - _rounding(times))
    return math.nan if row == len(times) else float(values[row])


def evaluate_metric(metric: Metric, times: np.ndarray, values: Mapping[str, np.ndarray | float]) -> float:
    """One metric over a record: ``times`` (s, one per row), ``values`` (arrays over rows, or floats).

    Mean and rms weigh all rows alike. What settles is counted from the window's start, or from the flight's
    if that is later. Nan when no row lies in the window, as in a flight that ended before it. Raises InputError
    for a name that ``values`` lacks.
    """
    inside: slice | np.ndarray = slice(None) if metric.window is None else rows_in(metric.window, times)

    def rows_of(formula: Expression) -> np.ndarray:
        row_values = formula.evaluate(values)
        return (row_values if isinstance(row_values, np.ndarray) else np.full(times.shape, row_values))[inside]

    rows, signal = times[inside], rows_of(metric.expression)
    if not rows.size:
        return math.nan
    if metric.reduction == "last_outside":
        assert metric.band is not None  # as the campaign was read
        return last_outside(rows, signal, metric.band)
    if metric.reduction == "settled":
        flight = float(times[0])
        return settling_time(rows, signal, flight if metric.window is None else max(metric.window[0], flight))
    if metric.reduction == "first":
        assert metric.condition is not None  # as the campaign was read
        return first(rows, signal, rows_of(metric.condition), metric.delay)
    return float(SIMPLE[metric.reduction](signal))


def is_of_the_end(metric: Metric) -> bool:
    """Whether a metric needs no other row of a flight than the last one."""
    return metric.reduction == "final" and metric.window is None


def successes(success: Expression, metrics: Mapping[str, np.ndarray], trials: int) -> np.ndarray:
    """Which trials the metrics (trials,) make successes. One of the expression that is not finite makes a failure."""
    value = np.broadcast_to(success.evaluate(metrics), (trials,))
    return np.all(np.isfinite([value, *(metrics[name] for name in success.names)]), axis=0) & (value != 0.0)
