"""Pulses of jets: a lane for each axis with a bar for each pulse, and the thruster on-time so far."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from ...runtime.flight.results import Result
from ..chart.marks import level
from ..chart.panel import chart_panel
from ..chart.quantity import quantity_curve
from ..chart.ticks import axis_ends
from ..common.colours import BLUE, FAINT, VERMILION
from ..common.page import exact
from ..common.panels import HALF_WIDTH
from ..common.quantities import label_with_unit, number
from ..interactive.charts import Area, Chart
from .declared import Pulses
from .section import Section, displayed, time_chart
from .words import sentence

HEIGHT = 1.6  # in
BAR = 1.1  # pt; the duration of a pulse would not be visible
THIN = 0.6  # pt, the line at 0 and that of the remainder


def pulse_lengths(pulses: Pulses, result: Result) -> np.ndarray:
    """Signed lengths (s) of the pulses that start at each sample, [axes, samples]; 0 where none starts.

    Pulses of the last sample are left out: a command acts over the step after its sample.
    """
    lengths = np.nan_to_num(pulses.lengths.values(result), nan=0.0, posinf=0.0, neginf=0.0)
    lengths[:, -1] = 0.0
    if pulses.count is not None:
        count = pulses.count.values(result)[0]
        lengths[:, 1:] *= count[1:] != count[:-1]
    return lengths


def pulse_section(pulses: Pulses, result: Result, name: str) -> Section:
    """The section of pulses; ``name`` must differ between the figures of a page."""
    lengths = pulse_lengths(pulses, result)
    if not np.any(lengths):
        return Section(title=pulses.title, findings=[Markup("No pulse was fired.")], notes=pulses.notes)
    description = f"{pulses.title}: a bar for each pulse of {', '.join(pulses.lengths.names)}"
    panels = [
        chart_panel(label, f"{name}-{index}", f"{description}; {label}", chart, HEIGHT, HALF_WIDTH)
        for index, (label, chart) in enumerate(pulse_charts(pulses, result, lengths))
    ]
    return Section(
        title=pulses.title,
        panels=panels,
        findings=[_findings(pulses, lengths)],
        notes=[_caption(pulses, result), *pulses.notes],
    )


def pulse_charts(pulses: Pulses, result: Result, lengths: np.ndarray) -> list[tuple[str, Chart]]:
    """Return a chart of each axis with its heading, and one of the thruster on-time so far, where that is declared.

    A bar stands for a pulse, from 0 to its length (s); all axes have the same ends. ``lengths`` as `pulse_lengths`
    returns them.
    """
    time = result.time
    remainders = np.zeros_like(lengths) if pulses.remainder is None else pulses.remainder.plot_values(result)
    reach = 1.1 * max(float(np.abs(lengths).max()), float(np.nanmax(np.abs(remainders), initial=0.0)))
    charts = []
    for label, row, remainder in zip(pulses.labels, lengths, remainders, strict=True):
        lines = [_line(time, remainder)] if np.any(remainder) else []
        lines += [_bars(time, row, 1.0, BLUE), _bars(time, row, -1.0, VERMILION)]
        areas = [each for each in lines if each.x.size]
        rules = [level(0.0, FAINT, THIN)]
        chart = time_chart(time, [], (-reach, reach), areas=areas, rules=rules, y_intervals=3)
        charts.append((f"{label or pulses.lengths.label}, s", chart))
    if pulses.total is not None:
        total = quantity_curve(time, pulses.total.values(result)[0], pulses.total.label, pulses.total.unit_name)
        chart = time_chart(time, [total], axis_ends(displayed([total])), y_intervals=3)
        charts.append((label_with_unit(pulses.total.label, pulses.total.unit_name), chart))
    return charts


def _line(time: np.ndarray, numbers: np.ndarray) -> Area:
    """Strokes from sample to sample, which bars may cover as they could not cover a curve; none where one is nan."""
    begins = np.flatnonzero(np.isfinite(numbers[:-1]) & np.isfinite(numbers[1:]))
    rows = np.stack([begins, begins + 1], axis=1).ravel()
    return Area(time[rows], numbers[rows], (False, False), FAINT, 1.0, THIN)


def _bars(time: np.ndarray, lengths: np.ndarray, sign: float, colour: str) -> Area:
    """Strokes from 0 to the lengths of one sign."""
    rows = np.flatnonzero(sign * lengths > 0.0)
    heads = np.stack([np.zeros(rows.size), lengths[rows]], axis=1)
    return Area(np.repeat(time[rows], 2), heads.ravel(), (False, False), colour.lower(), 1.0, BAR)


def _findings(pulses: Pulses, lengths: np.ndarray) -> Markup:
    text = _amount(lengths)
    if len(lengths) > 1:
        axes = (Markup("{} {}").format(label, _amount(row)) for label, row in zip(pulses.labels, lengths, strict=True))
        text = Markup("total {} ({})").format(text, Markup("; ").join(axes))
    return sentence(text)


def _amount(lengths: np.ndarray) -> Markup:
    """The number of pulses and their total duration."""
    count = int(np.count_nonzero(lengths))
    duration = exact(float(np.abs(lengths).sum()), digits=3)
    return Markup("{} {}, {} s").format(number(count), "pulse" if count == 1 else "pulses", duration)


def _caption(pulses: Pulses, result: Result) -> Markup:
    text = Markup("bars: {}, at the start of each pulse, height: its duration").format(pulses.lengths.label)
    if pulses.remainder is not None:
        is_zero = not np.any(pulses.remainder.values(result))
        line = Markup("{} is 0 throughout") if is_zero else Markup("thin line: {}")
        text = Markup("{}; {}").format(text, line.format(pulses.remainder.label))
    return sentence(text)
