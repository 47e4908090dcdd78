"""A signal with a tolerance band: the full time history, a zoom on the band, and the settling time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .....runtime.flight.results import FlightResult
from ....cell import Inline, Quantity
from ....chart.axes import linear_axis, logarithmic_axis
from ....chart.marks import horizontal_band, horizontal_line, vertical_band, vertical_line
from ....chart.quantity import quantity_curve
from ....chart.ticks import axis_ends
from ....common.colours import FAINT, GREEN, INK
from ....common.quantities import display_factor, display_unit
from ....figures.declared import BandFigure, Signal
from ....interactive.charts import NO_BOX, Chart
from ....model import Group
from .figure_texts import join, seconds, sentence, value_range
from .section import displayed, figure_group, history_figure, legend_of, time_chart

SETTLED = "settled"  # name of a band that a settling time does not repeat
ZOOM = 3.0  # range of the zoom over the width of the band
DECADES = 100.0  # ratio of an abscissa's ends from which it is logarithmic
MOST_DECADES = 6  # ticks of a logarithmic abscissa
WIDE = 4.0  # range of the signal over the width of the band from which a zoom is plotted


def inside(band: BandFigure, result: FlightResult) -> np.ndarray:
    """Return True for each sample of each element within the band, limits included; NaN is outside."""
    values = band.values(result)
    low, high = (-np.inf if band.low is None else band.low), (np.inf if band.high is None else band.high)
    return (values >= low) & (values <= high) & np.isfinite(values)


def settling_row(condition: np.ndarray) -> int | None:
    """Return the first sample from which a condition holds until the last; None if it does not hold at the last."""
    failing = np.flatnonzero(~condition)
    row = int(failing[-1]) + 1 if failing.size else 0
    return None if row == condition.size else row


def settling_text(name: str, time: np.ndarray, condition: np.ndarray) -> list[Inline]:
    """Return the settling time of a condition called ``name``, from which it holds until the end, as text."""
    row = settling_row(condition)
    if row is None:
        return [f"not {name} at the end"]
    if row == 0:
        return [f"{name} throughout"]
    text: list[Inline] = ["settling time ", seconds(time[row])]
    return text if name == SETTLED else [*text, f" ({name})"]


def band_section(band: BandFigure, result: FlightResult, name: str) -> Group:
    """Return the section of a band; ``name`` must be unique among the figures of a page."""
    within, values, time = inside(band, result), band.plot_values(result), result.time
    row = settling_row(np.logical_and.reduce(within))
    factor, unit = display_factor(band.signal.unit_name), display_unit(band.signal.unit_name)
    low, high = (None if limit is None else factor * limit for limit in (band.low, band.high))
    zoom = None if low is None or high is None else _zoom_limits(values, low, high)

    lines = [
        quantity_curve(time, line, element, band.signal.unit_name, index)
        for index, (element, line) in enumerate(zip(band.line_names, band.values(result), strict=True))
    ]
    limits = [limit for limit in (low, high) if limit is not None]
    whole = _find_ends(displayed(lines), limits)
    green = horizontal_band(whole[0] if low is None else low, whole[1] if high is None else high, GREEN, 0.16)
    grey = [vertical_band(begin, end, FAINT, 0.35) for begin, end in _spans(band, result)]
    rules = [horizontal_line(limit, FAINT, 0.8) for limit in limits]
    rules += [vertical_line(float(time[row]), INK, 0.9, (1.0, 2.0))] if row else []

    def chart(ends: tuple[float, float]) -> Chart:
        return time_chart(time, lines, ends, areas=[green, *grey], rules=rules)

    description = f"{band.title}: {', '.join(band.signal.names)} over time with the tolerance band"
    figures = [history_figure("Time history", f"{name}-whole", description, unit, chart(whole))]
    if zoom is not None:
        label = "Zoom on tolerance band"
        figures.append(history_figure(label, f"{name}-zoom", f"{description}, zoom", unit, chart(zoom)))
    for number, other in enumerate(band.against):
        label = f"Versus {other.label.rpartition('.')[2].replace('_', ' ')}"
        description = f"{band.title} versus {other.label}, with the tolerance band"
        chart_over = against_chart(band, result, other)
        figures.append(history_figure(label, f"{name}-against{number}", description, unit, chart_over))
    return figure_group(
        band.title,
        figures=figures,
        legend=legend_of(band.labels),
        findings=[_findings(band, time, within)],
        notes=[_caption(band, unit, row), *band.notes],
    )


def _find_ends(values: np.ndarray, limits: list[float]) -> tuple[float, float]:
    """Return the ends of the ordinate, which enclose the values and any limit beyond them."""
    ends = axis_ends(values)
    for count, limit in enumerate(limits, 1):
        if not ends[0] <= limit <= ends[1]:
            ends = axis_ends(np.concatenate([values, limits[:count]]))
    return ends


def _spans(band: BandFigure, result: FlightResult) -> list[tuple[float, float]]:
    """Return begin and end (s) of the shaded intervals."""
    if band.shade is None:
        return []
    below = np.append(band.shade.values(result)[0] < band.shade_below, False).astype(int)
    edges = np.diff(np.append(0, below))
    time = np.append(result.time, result.time[-1])
    begins, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return [(float(time[begin]), float(time[end])) for begin, end in zip(begins, ends, strict=True)]


def against_chart(band: BandFigure, result: FlightResult, other: Signal) -> Chart:
    """Return the chart of a band's signal over another signal, with a logarithmic abscissa if this spans decades."""
    abscissa, unit = other.plot_values(result)[0], display_unit(other.unit_name)
    label = f"{other.label}, {unit}" if unit else other.label
    placed = np.isfinite(abscissa)
    finite = abscissa[placed]
    if finite.size and finite.min() > 0.0 and finite.max() > DECADES * finite.min():
        low_end, high_end = axis_ends(np.log10(finite))
        x = logarithmic_axis((10.0**low_end, 10.0**high_end), MOST_DECADES, label=label)
    else:
        x = linear_axis(axis_ends(abscissa), 6, label=label)
    lines = [
        replace(
            quantity_curve(abscissa, np.where(placed, line, np.nan), element, band.signal.unit_name, index),
            time=result.time,
        )
        for index, (element, line) in enumerate(zip(band.line_names, band.values(result), strict=True))
    ]
    factor = display_factor(band.signal.unit_name)
    low, high = (None if limit is None else factor * limit for limit in (band.low, band.high))
    limits = [limit for limit in (low, high) if limit is not None]
    ends = _find_ends(displayed(lines), limits)
    green = horizontal_band(ends[0] if low is None else low, ends[1] if high is None else high, GREEN, 0.16)
    rules = [horizontal_line(limit, FAINT, 0.8) for limit in limits]
    return Chart(NO_BOX, x, linear_axis(ends, 5), curves=lines, areas=[green], rules=rules)


def _zoom_limits(values: np.ndarray, low: float, high: float) -> tuple[float, float] | None:
    """Return the limits of the zoomed ordinate; None if the full range shows the band well, or no value is near it."""
    finite = values[np.isfinite(values)]
    width = high - low
    margin = 0.5 * (ZOOM - 1.0) * width
    near = (finite >= low - margin) & (finite <= high + margin)
    if not np.any(near) or np.ptp(finite) <= WIDE * width:
        return None
    return low - margin, high + margin


def _findings(band: BandFigure, time: np.ndarray, within: np.ndarray) -> list[Inline]:
    text = settling_text(band.name, time, np.logical_and.reduce(within))
    if len(within) == 1:
        return text
    elements: list[list[Inline]] = []
    for label, condition in zip(band.labels, within, strict=True):
        row = settling_row(condition)
        when = "not at the end" if row is None else "throughout" if row == 0 else seconds(time[row])
        elements.append([f"{label} ", when])
    return [*text, ": ", *join(elements, ", ")]


def _caption(band: BandFigure, unit: str, row: int | None) -> list[Inline]:
    """Return the caption: band, subtracted values, marks."""
    name = band.signal.unit_name
    text: list[Inline] = ["green: ", value_range(band.low, band.high, name), f" {unit} for {band.signal.label}"]
    if band.less is not None:
        text.append(f" minus {band.less.label}")
    if band.shade is not None:
        text += [f"; grey: {band.shade.label} below ", Quantity(band.shade_below)]
    if band.about:
        about: list[list[Inline]] = [[Quantity(value, name, is_bare=True)] for value in band.about]
        text += [" minus (", *join(about, ", "), f") {unit}"]
    if row:
        text.append("; dotted line: settling time")
    return sentence(text)
