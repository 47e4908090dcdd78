"""Pulses of jets: a lane per axis with a bar per pulse, and the thruster on-time so far."""

from __future__ import annotations

import numpy as np

from .....runtime.flight.results import FlightResult
from ....cell import Inline, Quantity
from ....chart.marks import horizontal_line
from ....chart.quantity import quantity_curve
from ....chart.ticks import axis_ends
from ....common.colours import BLUE, FAINT, VERMILION
from ....common.quantities import label_with_unit, number
from ....figures.declared import PulsesFigure
from ....interactive.charts import Area, Chart
from ....model import Group
from ....pictures import Figure
from .figure_texts import join, sentence
from .section import displayed, figure_group, time_chart

HEIGHT = 1.6  # in
BAR = 1.1  # pt, width of a bar, since the duration of a pulse would not be visible
THIN = 0.6  # pt, width of the line at 0 and of the remainder's line


def pulse_lengths(pulses: PulsesFigure, result: FlightResult) -> np.ndarray:
    """Return the signed lengths (s) of the pulses that start at each sample, [axes, samples]; 0 without a pulse.

    Pulses of the last sample are omitted, since a command acts during the step after its sample.
    """
    lengths = np.nan_to_num(pulses.lengths.values(result), nan=0.0, posinf=0.0, neginf=0.0)
    lengths[:, -1] = 0.0
    if pulses.count is not None:
        count = pulses.count.values(result)[0]
        lengths[:, 1:] *= count[1:] != count[:-1]
    return lengths


def pulse_section(pulses: PulsesFigure, result: FlightResult, name: str) -> Group:
    """Return the section of pulses; ``name`` must be unique among the figures of a page."""
    lengths = pulse_lengths(pulses, result)
    if not np.any(lengths):
        return figure_group(pulses.title, findings=["no pulse was fired"], notes=pulses.notes)
    description = f"{pulses.title}: a bar for each pulse of {', '.join(pulses.lengths.names)}"
    figures = [
        Figure(label, f"{name}-{index}", f"{description}; {label}", chart, HEIGHT)
        for index, (label, chart) in enumerate(pulse_charts(pulses, result, lengths))
    ]
    return figure_group(
        pulses.title,
        figures=figures,
        findings=[_findings(pulses, lengths)],
        notes=[_caption(pulses, result), *pulses.notes],
    )


def pulse_charts(pulses: PulsesFigure, result: FlightResult, lengths: np.ndarray) -> list[tuple[str, Chart]]:
    """Return a chart for each axis with its heading, and a chart of the thruster on-time, if declared.

    A bar from 0 to its length (s) represents a pulse; all ordinates have the same ends. ``lengths`` are as returned by
    `pulse_lengths`.
    """
    time = result.time
    remainders = np.zeros_like(lengths) if pulses.remainder is None else pulses.remainder.plot_values(result)
    reach = 1.1 * max(float(np.abs(lengths).max()), float(np.nanmax(np.abs(remainders), initial=0.0)))
    charts = []
    for label, row, remainder in zip(pulses.labels, lengths, remainders, strict=True):
        lines = [_line(time, remainder)] if np.any(remainder) else []
        lines += [_bars(time, row, 1.0, BLUE), _bars(time, row, -1.0, VERMILION)]
        areas = [each for each in lines if each.x.size]
        rules = [horizontal_line(0.0, FAINT, THIN)]
        chart = time_chart(time, [], (-reach, reach), areas=areas, rules=rules, y_intervals=3)
        charts.append((f"{label or pulses.lengths.label}, s", chart))
    if pulses.total is not None:
        total = quantity_curve(time, pulses.total.values(result)[0], pulses.total.label, pulses.total.unit_name)
        chart = time_chart(time, [total], axis_ends(displayed([total])), y_intervals=3)
        charts.append((label_with_unit(pulses.total.label, pulses.total.unit_name), chart))
    return charts


def _line(time: np.ndarray, numbers: np.ndarray) -> Area:
    """Return strokes between samples, which unlike a curve are drawn below bars; none at NaN."""
    begins = np.flatnonzero(np.isfinite(numbers[:-1]) & np.isfinite(numbers[1:]))
    rows = np.stack([begins, begins + 1], axis=1).ravel()
    return Area(time[rows], numbers[rows], (False, False), FAINT, 1.0, THIN)


def _bars(time: np.ndarray, lengths: np.ndarray, sign: float, colour: str) -> Area:
    """Return strokes from 0 to the lengths of one sign."""
    rows = np.flatnonzero(sign * lengths > 0.0)
    heads = np.stack([np.zeros(rows.size), lengths[rows]], axis=1)
    return Area(np.repeat(time[rows], 2), heads.ravel(), (False, False), colour.lower(), 1.0, BAR)


def _findings(pulses: PulsesFigure, lengths: np.ndarray) -> list[Inline]:
    text = _amount(lengths)
    if len(lengths) == 1:
        return text
    axes: list[list[Inline]] = [[f"{label} ", *_amount(row)] for label, row in zip(pulses.labels, lengths, strict=True)]
    return ["total ", *text, " (", *join(axes, "; "), ")"]


def _amount(lengths: np.ndarray) -> list[Inline]:
    """Return the number of pulses and their total duration."""
    count = int(np.count_nonzero(lengths))
    duration = Quantity(float(np.abs(lengths).sum()), "s", 3)
    return [f"{number(count)} {'pulse' if count == 1 else 'pulses'}, ", duration]


def _caption(pulses: PulsesFigure, result: FlightResult) -> list[Inline]:
    text = f"bars: {pulses.lengths.label}, at the start of each pulse, height: its duration"
    if pulses.remainder is not None:
        is_zero = not np.any(pulses.remainder.values(result))
        label = pulses.remainder.label
        text += f"; {label} is 0 throughout" if is_zero else f"; thin line: {label}"
    return sentence(text)
