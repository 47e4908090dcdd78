"""Charts of margins over trials, amplitudes, parameters and frequency, and of the step response."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .....stability.loops.margin_values import UNLIMITED, UNSTABLE, MarginQuantity
from .....stability.loops.margins import disk_of_gain, disk_of_phase
from .....stability.loops.readings import decibels, factor_of
from .....stability.results.report import JointReport, LoopReport
from .....stability.results.responses import Nonlinearity
from .....stability.results.varied import Dispersion, SweepReport
from ....chart.axes import fine_axis, linear_axis
from ....chart.lines import line
from ....chart.marks import SQUARE, hatch, horizontal_line, outline, rectangle, vertical_line
from ....chart.symbols import mark, marker
from ....chart.ticks import axis_ends
from ....common.colours import BLUE, GREEN, INK, VERMILION
from ....common.quantities import display_factor, label_with_unit
from ....interactive.charts import NO_BOX, Area, Axis, Chart, Curve
from .frequency import COMPLEMENTARY, DOTS, PEAK, REQUIRED, WHITE, LimitLines, frequency_axis, in_db

BINS = 24
DECADES = 20.0  # ratio of the ends of an abscissa from which it is logarithmic
FLAT = 1.5  # dB or deg, least range of an ordinate, so nearly constant values look constant
MARGINS = (1.0, 1.5, 2.0, 3.0, 5.0, 10.0)  # dB or deg, steps between ticks, times a power of ten
DIMMED = 0.75  # opacity of bars
WORST = marker("^", 7.0, VERMILION)


def step_chart(loop: LoopReport) -> Chart:
    """Return the chart of the response of T to a unit step at the cut, held between samples."""
    assert loop.step is not None
    time, response = loop.step
    abscissa = linear_axis((float(time[0]), float(time[-1])), 5, label="s")
    ends = axis_ends(np.concatenate([response, [0.0, 1.0]]))
    rules = [horizontal_line(1.0, INK, 0.9, REQUIRED), horizontal_line(0.0, INK, 0.5)]
    curves, title = [line(time, response, BLUE, steps=True)], "response of T to a unit step"
    return Chart(NO_BOX, abscissa, linear_axis(ends, 6), title=title, curves=curves, rules=rules)


def margin_chart(dispersion: Dispersion, quantity: MarginQuantity, limit: float | None) -> Chart:
    """Return the chart of a margin's histogram over trials: unstable trials hatched, limit dashed, worst marked."""
    sizes, worst = dispersion.sizes(quantity), dispersion.worst
    unstable, finite = sizes == UNSTABLE, np.isfinite(sizes)
    retained = sizes[finite]
    low, high = (float(retained.min()), float(retained.max())) if retained.size else (0.0, 1.0)
    if limit is not None:
        low, high = min(low, limit), max(high, limit)
    margin = 0.04 * (high - low) or 0.04 * abs(high) or 1.0
    edges = np.linspace(low - margin, high + margin, BINS + 1)
    width = float(edges[1] - edges[0])
    heights, _ = np.histogram(retained, edges)
    bars = [
        rectangle(float(left), float(right), 0.0, float(height), BLUE, DIMMED)
        for left, right, height in zip(edges[:-1], edges[1:], heights, strict=True)
        if height
    ]
    left, count = float(edges[0]), int(np.sum(unstable))
    if count:
        left -= 3.0 * width
        bars += _hatched(left, left + 2.0 * width, float(count))
    curves = []
    if finite[worst] or unstable[worst]:
        at = left + width if unstable[worst] else float(sizes[worst])
        curves.append(mark(at, 0.0, WORST, beyond=True))
    counted = {"unstable": count, "without crossing": int(np.sum(sizes == UNLIMITED))}
    title = ", ".join(["trials", *(f"{each} {words}" for words, each in counted.items() if each)])
    top = float(max(heights.max(initial=0), count, 1))
    unit = "" if quantity.unit == "1" else f", {quantity.unit}"
    return Chart(
        NO_BOX,
        linear_axis((left, float(edges[-1])), 5, label=f"{quantity}{unit}"),
        linear_axis((0.0, 1.05 * top), 4, integer=True),
        title=title,
        curves=curves,
        areas=bars,
        rules=[] if limit is None else [vertical_line(limit, VERMILION, 1.4, REQUIRED)],
    )


def _hatched(left: float, right: float, height: float | None = None) -> list[Area]:
    """Return a hatched bar, or a band of the full height of the axes, for unstable loops."""
    of_axes = (False, height is None)
    x, y = left + (right - left) * SQUARE[:, 0], (1.0 if height is None else height) * SQUARE[:, 1]
    strokes = (hatch(x, y, VERMILION, 1.0), outline(x, y, VERMILION, 1.0))
    return [Area(x, y, of_axes, WHITE, 1.0, 0.0), *(replace(each, of_axes=of_axes) for each in strokes)]


def amplitude_charts(loop: LoopReport) -> tuple[Chart, Chart]:
    """Return charts of gain and phase of L at one frequency over the amplitude of the injected signal."""
    amplitude = display_factor(loop.unit) * np.array([each.amplitude for each in loop.amplitudes])
    response = np.array([each.value for each in loop.amplitudes])
    order = np.argsort(amplitude)
    amplitude, response = amplitude[order], response[order]
    label = label_with_unit("amplitude at the cut", loop.unit)
    if float(amplitude[0]) > 0.0:
        abscissa = fine_axis((0.8 * float(amplitude[0]), 1.25 * float(amplitude[-1])), label=label)
    else:
        abscissa = linear_axis(axis_ends(amplitude), 5, label=label)
    gain, phase = (
        Chart(NO_BOX, abscissa, _ordinate(y), title=title, curves=[_marked(amplitude, y, 3.5)])
        for y, title in ((in_db(response), "gain, dB"), (np.degrees(np.unwrap(np.angle(response))), "phase, deg"))
    )
    return gain, phase


def _ordinate(y: np.ndarray) -> Axis:
    """Return an axis with a range of at least `FLAT`."""
    middle = 0.5 * float(np.min(y) + np.max(y))
    ends = (middle - FLAT / 2.0, middle + FLAT / 2.0) if np.ptp(y) < FLAT / 1.5 else axis_ends(y)
    return linear_axis(ends, 4)


def _marked(x: np.ndarray, y: np.ndarray, size: float) -> Curve:
    """Return a line with its samples as dots."""
    return replace(line(x, y, BLUE), marker=marker("o", size, BLUE))


def describing_chart(element: Nonlinearity) -> Chart:
    """Return the chart of the describing function's magnitude over the amplitude at the element, with limit cycles."""
    factor = display_factor(element.unit)
    amplitude, size = factor * element.amplitude, np.abs(element.gain)
    curves, plotted = [line(amplitude, size, BLUE)], [size]
    if np.any(np.abs(element.gain.imag) > 1e-9 * np.max(size, initial=1e-300)):
        curves.append(line(amplitude, element.gain.real, GREEN, width=0.9, dashes=COMPLEMENTARY))
        plotted.append(element.gain.real)
    for cycle in element.cycles:
        at = float(np.interp(cycle.amplitude, element.amplitude, size))
        symbol = marker("o", 6.0, INK, fill=INK if cycle.stable else WHITE)
        curves.append(mark(factor * cycle.amplitude, at, symbol))
    _, top = axis_ends(np.concatenate(plotted))
    abscissa = _abscissa(amplitude, label_with_unit("amplitude", element.unit))
    return Chart(NO_BOX, abscissa, linear_axis((0.0, top), 5), title="size of N", curves=curves)


def _abscissa(x: np.ndarray, label: str) -> Axis:
    """Return the axis of ascending numbers, logarithmic if they span more than `DECADES`."""
    ends = (float(np.min(x)), float(np.max(x))) if np.ptp(x) > 0.0 else axis_ends(x)
    is_logarithmic = ends[0] > 0.0 and ends[1] > DECADES * ends[0]
    return fine_axis(ends, label=label) if is_logarithmic else linear_axis(ends, 5, label=label)


def sweep_charts(sweep: SweepReport, limits: LimitLines) -> tuple[Chart, Chart]:
    """Return charts of gain and phase margin over a parameter, with limits, crossings and hatched unstable ranges."""
    unstable = np.array([each.unstable for each in sweep.margins])
    gain = np.array([math.nan if each.unstable else decibels(each.gain) for each in sweep.margins])
    phase = np.array([math.nan if each.unstable else math.degrees(each.phase) for each in sweep.margins])
    edges = [crossing.value for crossing in sweep.crossings if crossing.quantity is MarginQuantity.STABILITY]
    bands = _runs(unstable, sweep.values, edges)
    return (
        _sweep_chart(sweep, gain, limits.gain, "gain margin, dB", bands),
        _sweep_chart(sweep, phase, limits.phase, "phase margin, deg", bands),
    )


def _sweep_chart(
    sweep: SweepReport, y: np.ndarray, limit: float | None, title: str, bands: Sequence[tuple[float, float]]
) -> Chart:
    factor = display_factor(sweep.unit)
    finite = np.where(np.isfinite(y), y, np.nan)
    limits = [] if limit is None else [limit, -limit] if float(np.nanmin(y, initial=0.0)) < 0.0 else [limit]
    rules = [horizontal_line(each, VERMILION, 1.0, REQUIRED) for each in limits]
    rules += [vertical_line(factor * crossing.value, INK, 0.9, DOTS) for crossing in sweep.crossings]
    return Chart(
        NO_BOX,
        _abscissa(factor * sweep.values, label_with_unit(sweep.parameter, sweep.unit)),
        linear_axis(axis_ends(np.concatenate([finite, limits])), 4, multiples=MARGINS),
        title=title,
        curves=[_marked(factor * sweep.values, finite, 2.5)],
        areas=[area for left, right in bands for area in _hatched(factor * left, factor * right)],
        rules=rules,
    )


def _runs(unstable: np.ndarray, values: np.ndarray, edges: list[float]) -> list[tuple[float, float]]:
    """Return the unstable ranges of a parameter, bounded by computed edges or by the ends of the sweep."""
    bounds = [float(values[0]), *edges, float(values[-1])]
    middles = [(low, high) for low, high in itertools.pairwise(bounds) if high > low]
    return [(low, high) for low, high in middles if np.any(unstable & (values >= low) & (values <= high))]


def joint_chart(joint: JointReport) -> Chart:
    """Return the chart of the disk margin of all channels at once over frequency, with its minimum and limit."""
    curves = [line(joint.frequency, joint.disk_margins, BLUE)]
    if joint.stable and math.isfinite(joint.disk_frequency):
        curves.append(mark(joint.disk_frequency, joint.disk_margin, PEAK))
    limits = {item.quantity: item.limit for item in joint.requirements}
    alphas = [disk_of_gain(factor_of(limits[MarginQuantity.DISK_GAIN]))] if MarginQuantity.DISK_GAIN in limits else []
    alphas += (
        [disk_of_phase(math.radians(limits[MarginQuantity.DISK_PHASE]))] if MarginQuantity.DISK_PHASE in limits else []
    )
    finite = joint.disk_margins[np.isfinite(joint.disk_margins)]
    ends = (0.0, min(2.1, 1.1 * float(np.max(finite, initial=0.1))))
    title = "disk margin" if joint.stable else "distance; the closed loop is unstable"
    return Chart(
        NO_BOX,
        frequency_axis(float(joint.frequency[0]), float(joint.frequency[-1])),
        linear_axis(ends, 5),
        title=title,
        curves=curves,
        rules=[horizontal_line(max(alphas), VERMILION, 1.0, REQUIRED)] if alphas else [],
    )
