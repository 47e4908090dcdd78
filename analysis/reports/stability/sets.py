"""Figures of margins over something: trials, amplitudes, parameters, frequency; and the step response."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, MaxNLocator

from ...stability.loops.margin_values import UNLIMITED, UNSTABLE, Quantity
from ...stability.loops.margins import disk_of_gain, disk_of_phase
from ...stability.loops.readings import decibels, factor_of
from ...stability.results.report import JointReport, LoopReport
from ...stability.results.responses import Nonlinearity
from ...stability.results.varied import SweepReport
from ..common.quantities import display_factor, label_with_unit, tick
from ..common.style import BLUE, FAILED, GREEN, INK, VERMILION, log_ticks_x, plain_ticks
from .frequency import LIMIT, PHASE_MARK, Limits, frequency_axis, in_db

BINS = 24
UNSTABLE_BAND: Any = {"facecolor": "white", "edgecolor": VERMILION, "hatch": "////", "zorder": 0.5}


def draw_step(loop: LoopReport, axes: Axes) -> None:
    """What comes back after a unit step at the cut: T's response, held between samples."""
    assert loop.step is not None
    time, response = loop.step
    axes.axhline(1.0, linewidth=0.9, **FAILED)
    axes.axhline(0.0, color=INK, linewidth=0.5)
    axes.step(time, response, where="post", color=BLUE)
    axes.set_xlim(float(time[0]), float(time[-1]))
    plain_ticks(axes, x=5, y=6)
    axes.set_title("response of T to a unit step", loc="left", fontsize=8.5)
    axes.set_xlabel("s")


def draw_histogram(sizes: np.ndarray, axes: Axes, what: str, limit: float | None, worst: int) -> None:
    """Trials by a margin's size; unstable ones as a hatched bar left of all, the limit dashed, the worst marked."""
    unstable, finite = sizes == UNSTABLE, np.isfinite(sizes)
    retained = sizes[finite]
    low, high = (float(retained.min()), float(retained.max())) if retained.size else (0.0, 1.0)
    if limit is not None:
        low, high = min(low, limit), max(high, limit)
    margin = 0.04 * (high - low) or 0.04 * abs(high) or 1.0
    edges = np.linspace(low - margin, high + margin, BINS + 1)
    width = edges[1] - edges[0]
    axes.hist(retained, bins=edges.tolist(), color=BLUE, alpha=0.75)
    left = edges[0]
    if np.any(unstable):
        left = edges[0] - 3.0 * width
        axes.bar(edges[0] - 2.0 * width, int(np.sum(unstable)), 2.0 * width, **UNSTABLE_BAND)
    if limit is not None:
        axes.axvline(limit, **(LIMIT | {"linewidth": 1.4}))
    if finite[worst] or unstable[worst]:
        at = edges[0] - 2.0 * width if unstable[worst] else sizes[worst]
        axes.plot(at, 0.0, **(PHASE_MARK | {"marker": "^", "markersize": 7, "clip_on": False}))
    axes.set_xlim(left, edges[-1])
    plain_ticks(axes, x=5, y=4, whole_y=True)
    counted = {"unstable": int(np.sum(unstable)), "without crossing": int(np.sum(sizes == UNLIMITED))}
    axes.set_title(
        ", ".join(["trials", *(f"{count} {words}" for words, count in counted.items() if count)]),
        loc="left", fontsize=8.5,
    )  # fmt: skip
    axes.set_xlabel(what)


def draw_amplitudes(loop: LoopReport, gain_axes: Axes, phase_axes: Axes) -> None:
    """Gain and phase of L at one frequency over the amplitude of the injected signal."""
    factor = display_factor(loop.unit)
    amplitude = factor * np.array([point.amplitude for point in loop.amplitudes])
    value = np.array([point.value for point in loop.amplitudes])
    order = np.argsort(amplitude)
    amplitude, value = amplitude[order], value[order]
    _over(gain_axes, amplitude, in_db(value), "gain, dB")
    _over(phase_axes, amplitude, np.degrees(np.unwrap(np.angle(value))), "phase, deg")
    phase_axes.set_xlabel(label_with_unit("amplitude at the cut", loop.unit))


def _over(axes: Axes, x: np.ndarray, y: np.ndarray, title: str) -> None:
    axes.plot(x, y, color=BLUE, marker="o", markersize=3.5)
    if np.ptp(y) < 1.0:  # dB or deg: what is nearly constant looks so
        middle = 0.5 * float(np.min(y) + np.max(y))
        axes.set_ylim(middle - 0.75, middle + 0.75)
    plain_ticks(axes, y=4)
    axes.set_title(title, loc="left", fontsize=8.5)
    if float(np.min(x)) > 0.0:
        frequency_axis(axes, 0.8 * float(np.min(x)), 1.25 * float(np.max(x)))
    else:
        plain_ticks(axes, x=5)


def draw_describing(element: Nonlinearity, axes: Axes) -> None:
    """Size of the describing function over the amplitude at the element's input, cycles marked."""
    factor = display_factor(element.unit)
    amplitude = factor * element.amplitude
    axes.plot(amplitude, np.abs(element.gain), color=BLUE)
    if np.any(np.abs(element.gain.imag) > 1e-9 * np.max(np.abs(element.gain), initial=1e-300)):
        axes.plot(amplitude, element.gain.real, color=GREEN, linestyle=(0, (5, 1.6)), linewidth=0.9)
    for cycle in element.cycles:
        at = float(np.interp(cycle.amplitude, element.amplitude, np.abs(element.gain)))
        fill = INK if cycle.stable else "white"
        axes.plot(factor * cycle.amplitude, at, "o", markersize=6, markerfacecolor=fill, markeredgecolor=INK, zorder=5)
    if amplitude.size and float(amplitude[0]) > 0.0 and amplitude[-1] > 20.0 * amplitude[0]:
        log_ticks_x(axes)
        axes.set_xlim(float(amplitude[0]), float(amplitude[-1]))
    else:
        plain_ticks(axes, x=5)
    plain_ticks(axes, y=5)
    axes.set_ylim(bottom=0.0)
    axes.set_title("size of N", loc="left", fontsize=8.5)
    axes.set_xlabel(label_with_unit("amplitude", element.unit))


def draw_sweep(sweep: SweepReport, limits: Limits, gain_axes: Axes, phase_axes: Axes) -> None:
    """Gain and phase margin over a parameter, the limits, where they are crossed; hatched: unstable."""
    factor = display_factor(sweep.unit)
    x = factor * sweep.values
    unstable = np.array([item.unstable for item in sweep.margins])
    gain = np.array([math.nan if item.unstable else decibels(item.gain) for item in sweep.margins])
    phase = np.array([math.nan if item.unstable else math.degrees(item.phase) for item in sweep.margins])
    displayed: list[tuple[Axes, np.ndarray, float | None, str]] = [
        (gain_axes, gain, limits.gain, "gain margin, dB"),
        (phase_axes, phase, limits.phase, "phase margin, deg"),
    ]
    edges = [crossing.value for crossing in sweep.crossings if crossing.quantity is Quantity.STABILITY]
    for axes, y, limit, title in displayed:
        axes.plot(x, np.where(np.isfinite(y), y, np.nan), color=BLUE, marker="o", markersize=2.5)
        if limit is not None:
            axes.axhline(limit, **LIMIT)
            if float(np.nanmin(y, initial=0.0)) < 0.0:
                axes.axhline(-limit, **LIMIT)
        for crossing in sweep.crossings:
            axes.axvline(factor * crossing.value, color=INK, linewidth=0.9, linestyle=(0, (1.2, 1.6)))
        for left, right in _runs(unstable, sweep.values, edges):
            axes.axvspan(factor * left, factor * right, **UNSTABLE_BAND)
        axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 1.5, 2, 3, 5, 10]))
        axes.yaxis.set_major_formatter(FuncFormatter(tick))
        axes.set_title(title, loc="left", fontsize=8.5)
        if np.min(x) > 0.0 and np.max(x) > 20.0 * np.min(x):
            frequency_axis(axes, float(np.min(x)), float(np.max(x)))
        else:
            plain_ticks(axes, x=5)
            axes.set_xlim(float(np.min(x)), float(np.max(x)))
    phase_axes.set_xlabel(label_with_unit(sweep.parameter, sweep.unit))


def _runs(unstable: np.ndarray, values: np.ndarray, edges: list[float]) -> list[tuple[float, float]]:
    """From where to where the loop is unstable: between the edges found, or the ends of the sweep."""
    bounds = [float(values[0]), *edges, float(values[-1])]
    middles = [(low, high) for low, high in itertools.pairwise(bounds) if high > low]
    return [(low, high) for low, high in middles if np.any(unstable & (values >= low) & (values <= high))]


def draw_joint(joint: JointReport, axes: Axes) -> None:
    """The disk margin of all channels at once over frequency, its least value and the limit that both sizes set."""
    axes.plot(joint.frequency, joint.disk_margins, color=BLUE)
    if joint.stable and math.isfinite(joint.disk_frequency):
        axes.plot(joint.disk_frequency, joint.disk_margin, **PHASE_MARK)
    limits = {item.quantity: item.limit for item in joint.requirements}
    alphas = [disk_of_gain(factor_of(limits[Quantity.DISK_GAIN]))] if Quantity.DISK_GAIN in limits else []
    alphas += [disk_of_phase(math.radians(limits[Quantity.DISK_PHASE]))] if Quantity.DISK_PHASE in limits else []
    if alphas:
        axes.axhline(max(alphas), **LIMIT)
    finite = joint.disk_margins[np.isfinite(joint.disk_margins)]
    axes.set_ylim(0.0, min(2.1, 1.1 * float(np.max(finite, initial=0.1))))
    plain_ticks(axes, y=5)
    frequency_axis(axes, float(joint.frequency[0]), float(joint.frequency[-1]))
    title = "disk margin" if joint.stable else "distance; the closed loop is unstable"
    axes.set_title(title, loc="left", fontsize=8.5)
    axes.set_xlabel("rad/s")
