"""Signals over time: scalars with limits, and estimation errors with the estimator's standard deviation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.special import ndtr

from ......common.percent import short_percent
from .....runtime.flight.results import FlightResult
from ....cell import DisplayedNumber, Inline, Quantity, Rich
from ....chart.marks import band_areas, horizontal_line
from ....chart.quantity import quantity_curve
from ....chart.ticks import axis_ends
from ....common.colours import FAINT, ORANGE
from ....common.quantities import display_factor, display_unit
from ....figures.declared import CurveFigure, ErrorFigure
from ....interactive.charts import Chart
from ....model import Group
from ....pictures import Figure
from .figure_texts import capital, condition_text, join, seconds, sentence
from .section import displayed, figure_group, history_figure, legend_of, select_rows, time_chart

SIGMAS = (3.0, 1.0)
MOST_ROWS = 500  # rows of shaded areas, which matplotlib does not simplify
ROUNDING = 1e-12  # rounding of times, which are start + n h
WIDE = 4.0  # range of the errors over that of the last quarter from which a zoom is plotted


def error_section(error: ErrorFigure, result: FlightResult, name: str) -> Group:
    """Return the section of an error; ``name`` must be unique among the figures of a page."""
    chosen, rows = select_rows(error.rows, result)
    time = result.time[rows]
    estimate = error.estimate.values(result)
    values = np.where(chosen, estimate - error.truth.values(result), np.nan)[:, rows]
    changed = np.append(True, np.any(estimate[:, 1:] != estimate[:, :-1], axis=0))[rows]
    stated = np.zeros_like(values) if error.sigma is None else error.sigma.values(result)[:, rows]
    sigma = np.where(stated > 0.0, stated, np.nan)
    figures: list[Figure] = []
    findings: list[Rich] = []
    for index, label in enumerate(error.labels):
        figures += _figures(error, label, time, values[index], sigma[index], f"{name}-{index}")
        findings += _findings(error, label, time, values[index], sigma[index], changed)
    return figure_group(
        error.title,
        figures=figures,
        findings=findings,
        notes=[_caption(error, sigma), *error.notes],
    )


def _figures(
    error: ErrorFigure, label: str, time: np.ndarray, values: np.ndarray, sigma: np.ndarray, name: str
) -> list[Figure]:
    unit_name = error.estimate.unit_name
    unit, factor = display_unit(unit_name), display_factor(unit_name)
    description = f"{error.title}: {label or error.estimate.label} over time"
    head = f"{label}, " if label else ""

    line = quantity_curve(time, values, label or error.title, unit_name)
    rows = np.linspace(0, time.size - 1, min(time.size, MOST_ROWS)).round().astype(int)
    halves = [factor * times * sigma[rows] for times in SIGMAS]
    areas = [
        area
        for half, shade in zip(halves, (0.20, 0.40), strict=True)
        for area in band_areas(time[rows], -half, half, ORANGE, shade)
    ]

    def chart(ends: tuple[float, float]) -> Chart:
        return time_chart(time, [line], ends, areas=areas, rules=[horizontal_line(0.0, FAINT, 0.8)])

    everything = np.concatenate([displayed([line]), [0.0], *halves, *(-half for half in halves)])
    whole = chart(axis_ends(everything))
    figures = [history_figure(capital(f"{head}time history"), f"{name}-whole", description, unit, whole)]
    reach = _final_range(values, sigma)
    if reach is not None:
        label, description = capital(f"{head}scaled to the last quarter"), f"{description}, scaled to the last quarter"
        figures.append(
            history_figure(label, f"{name}-end", description, unit, chart((-factor * reach, factor * reach)))
        )
    return figures


def _final_range(values: np.ndarray, sigma: np.ndarray) -> float | None:
    """Return the largest magnitude of error and sigma in the last quarter; None if the full range shows it well."""
    sizes = np.fmax(np.abs(values), np.fmax(SIGMAS[0] * sigma, 0.0))
    later = sizes[3 * values.size // 4 :]
    if not np.any(later > 0.0) or np.nanmax(sizes) <= WIDE * np.nanmax(later):
        return None
    return 1.1 * float(np.nanmax(later))


def _findings(
    error: ErrorFigure, label: str, time: np.ndarray, values: np.ndarray, sigma: np.ndarray, changed: np.ndarray
) -> list[Rich]:
    """Return the fractions of samples with a ``changed`` estimate within 1 and 3 sigma; none if there is no sigma."""
    start = time[0] if error.after is None else error.after
    counted = np.isfinite(sigma) & np.isfinite(values) & (time >= start - ROUNDING * abs(start))
    repeats = bool(np.any(counted & ~changed))
    counted &= changed
    if not np.any(counted):
        return []
    fractions = [float(np.mean(np.abs(values[counted]) <= times * sigma[counted])) for times in SIGMAS]
    number = int(np.count_nonzero(counted))
    noun = "sample" if number == 1 else "samples"
    samples: list[Inline] = [Quantity(number), f" {noun} at which the estimate changed"] if repeats else [noun]
    return [
        [
            f"{label}: from " if label else "from ",
            seconds(start),
            ", ",
            _percent(fractions[1]),
            " % of the ",
            *samples,
            " within 1 sigma (normal distribution: ",
            _percent(_normal(1.0)),
            " %), ",
            _percent(fractions[0]),
            " % within 3 sigma",
        ]
    ]


def _percent(fraction: float) -> DisplayedNumber:
    return DisplayedNumber(short_percent(fraction, 1), fraction)


def _normal(times: float) -> float:
    return float(2.0 * ndtr(times) - 1.0)


def _caption(error: ErrorFigure, sigma: np.ndarray) -> list[Inline]:
    text: list[Inline] = [f"line: {error.estimate.label} minus {error.truth.label}"]
    if error.sigma is not None and not np.any(np.isfinite(sigma)):
        text.append(f"; {error.sigma.label} is 0 throughout, no standard deviation")
    elif error.sigma is not None:
        gaps = " where it is not 0" if not np.all(np.isfinite(sigma)) else ""
        text.append(f"; shaded: ±1 and ±3 {error.sigma.label}{gaps}")
    if error.rows is not None:
        text += ["; samples where ", *condition_text(error.rows)]
    return sentence(text)


def curve_section(curve: CurveFigure, result: FlightResult, name: str) -> Group:
    """Return the section of curves; ``name`` must be unique among the figures of a page."""
    chosen, rows = select_rows(curve.rows, result)
    time = result.time[rows]
    values = [np.where(chosen, signal.values(result)[0], np.nan)[rows] for signal in curve.signals]
    unit_name = curve.signals[0].unit_name
    unit = display_unit(unit_name)

    def chart(which: Sequence[int], intervals: int = 6) -> Chart:
        lines = [
            quantity_curve(time, values[index], curve.labels[index], unit_name, index if curve.together else 0)
            for index in which
        ]
        limits = [display_factor(unit_name) * limit for limit in (curve.low, curve.high) if limit is not None]
        ends = axis_ends(np.concatenate([displayed(lines), limits]))
        rules = [horizontal_line(limit, FAINT, 0.9, (5.0, 3.0)) for limit in limits]
        return time_chart(time, lines, ends, rules=rules, intervals=intervals)

    notes = [_curve_caption(curve, unit), *curve.notes]
    if len(values) == 1 or curve.together:
        names = ", ".join(signal.label for signal in curve.signals)
        whole = chart(range(len(values)), 12)
        figure = history_figure("", name, f"{curve.title}: {names} over time", unit, whole, is_wide=True)
        return figure_group(curve.title, figures=[figure], legend=legend_of(curve.labels), notes=notes)
    figures = []
    for index, (label, signal) in enumerate(zip(curve.labels, curve.signals, strict=True)):
        description = f"{curve.title}: {signal.label} over time"
        figures.append(history_figure(label, f"{name}-{index}", description, unit, chart([index])))
    return figure_group(curve.title, figures=figures, notes=notes)


def _curve_caption(curve: CurveFigure, unit: str) -> list[Inline]:
    text: list[Inline] = [f"line: {', '.join(signal.label for signal in curve.signals)}"]
    limits = [limit for limit in (curve.low, curve.high) if limit is not None]
    if limits:
        name = curve.signals[0].unit_name
        numbers: list[list[Inline]] = [[Quantity(limit, name, is_bare=True)] for limit in limits]
        text += ["; dashed: limits ", *join(numbers, " and "), f" {unit}"]
    if curve.rows is not None:
        text += ["; samples where ", *condition_text(curve.rows)]
    return sentence(text)
