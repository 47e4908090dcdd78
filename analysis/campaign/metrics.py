"""A trial's metrics from its record, and whether they make it a success."""

from __future__ import annotations

import math
from collections import ChainMap
from collections.abc import Callable, Iterable, Mapping

import numpy as np

from .campaign import Metric
from .expressions import Expression

SIMPLE: dict[str, Callable[[np.ndarray], float]] = {
    "final": lambda values: values[-1],
    "min": np.min,
    "max": np.max,
    "mean": np.mean,
    "rms": lambda values: np.sqrt(np.mean(np.square(values))),
}
TIME = "time"  # the name under which expressions see the record's times, s


def names_needed(metrics: Iterable[Metric], drawn: Iterable[str]) -> set[str]:
    """Recorded signals and parameters that the metrics refer to: all their names but times and draws."""
    return {name for metric in metrics for name in metric.expression.names} - set(drawn) - {TIME}


def rows_in(window: tuple[float, float], times: np.ndarray) -> np.ndarray:
    """Which rows lie in the window (s), both ends included: booleans, one per row.

    Times are start + n h with rounding, so an end may be missed by a millionth of a step.
    """
    margin = 1e-6 * (times[1] - times[0]) if len(times) > 1 else 0.0
    return (times >= window[0] - margin) & (times <= window[1] + margin)


def last_outside(times: np.ndarray, values: np.ndarray, band: tuple[float, float]) -> float:
    """The last time (s) at which the values are outside the band, nan counting as outside.

    The first time when they never are, as then nothing is left to wait for; inf when they still
    are in the last row, as then they never settled.
    """
    outside = np.flatnonzero(~((values >= band[0]) & (values <= band[1])))
    if not outside.size:
        return float(times[0])
    return math.inf if outside[-1] == len(times) - 1 else float(times[outside[-1]])


def evaluate_metric(metric: Metric, times: np.ndarray, values: Mapping[str, np.ndarray | float]) -> float:
    """One metric over a record: ``times`` (s, one per row), ``values`` (arrays over rows, or floats).

    Mean and rms weigh all rows alike. Nan when no row lies in the window, as in a flight that
    ended before it. Raises InputError for a name that ``values`` lacks.
    """
    signal = np.broadcast_to(metric.expression.evaluate(values), times.shape)
    if metric.window is not None:
        inside = rows_in(metric.window, times)
        times, signal = times[inside], signal[inside]
    if not times.size:
        return math.nan
    if metric.reduction == "last_outside":
        assert metric.band is not None  # as the campaign was read
        return last_outside(times, signal, metric.band)
    return float(SIMPLE[metric.reduction](signal))


def evaluate_metrics(
    metrics: Iterable[Metric],
    times: np.ndarray,
    record: Mapping[str, np.ndarray],
    constants: Mapping[str, float],
) -> dict[str, float]:
    """All metrics of one trial by name.

    ``record`` maps signals to arrays over the rows of ``times`` (s); ``constants`` maps draws and
    parameters (``component.variable``) to their values. Names are looked up in the record first.
    """
    values: ChainMap = ChainMap({TIME: times}, dict(record), dict(constants))
    last: ChainMap = ChainMap({TIME: times[-1:]}, {name: rows[-1:] for name, rows in record.items()}, dict(constants))
    found = {}
    for metric in metrics:
        ends = metric.reduction == "final" and metric.window is None  # needs no other row
        found[metric.name] = evaluate_metric(metric, times[-1:] if ends else times, last if ends else values)
    return found


def succeeded(success: Expression, metrics: Mapping[str, float]) -> bool:
    """Whether the metrics make a success. A metric of the expression that is not finite makes a failure."""
    if not all(math.isfinite(metrics[name]) for name in success.names):
        return False
    value = float(success.evaluate(metrics))
    return math.isfinite(value) and value != 0.0
