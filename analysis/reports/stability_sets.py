"""Figures of margins over something: trials, amplitudes, parameters, frequency; and the step response."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, MaxNLocator

from analysis.stability.results import JointReport, LoopReport, Nonlinearity, SweepReport

from .quantities import labelled, shown_factor, tick
from .stability_frequency import PHASE_MARK, frequency_axis, in_db
from .stability_nyquist import LIMIT, Limits
from .style import BLUE, FAILED, GREEN, INK, VERMILION, log_ticks_x, plain_ticks

BINS = 24


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


def draw_histogram(
    values: np.ndarray, stable: np.ndarray, axes: Axes, what: str, limit: float | None, worst: int
) -> None:
    """Trials by a margin, unstable ones hatched; the limit dashed, the worst trial marked."""
    finite = np.isfinite(values)
    kept = values[finite]
    low, high = (float(kept.min()), float(kept.max())) if kept.size else (0.0, 1.0)
    if limit is not None:
        low, high = min(low, limit), max(high, limit)
    margin = 0.04 * (high - low) or 0.04 * abs(high) or 1.0
    edges = np.linspace(low - margin, high + margin, BINS + 1)
    axes.hist(values[finite & stable], bins=edges.tolist(), color=BLUE, alpha=0.75)
    if np.any(finite & ~stable):
        axes.hist(values[finite & ~stable], bins=edges.tolist(), facecolor="white", edgecolor=VERMILION, hatch="////")
    if limit is not None:
        axes.axvline(limit, **{**LIMIT, "linewidth": 1.4})
    if math.isfinite(values[worst]):
        axes.plot(values[worst], 0.0, **{**PHASE_MARK, "marker": "^", "markersize": 7, "clip_on": False})
    axes.set_xlim(edges[0], edges[-1])
    plain_ticks(axes, x=5, y=4, whole_y=True)
    missing = values.size - kept.size
    without = f", {missing} without" if missing else ""
    axes.set_title(f"trials{without}", loc="left", fontsize=8.5)
    axes.set_xlabel(what)


def draw_amplitudes(loop: LoopReport, gain_axes: Axes, phase_axes: Axes) -> None:
    """Gain and phase of L at one frequency over the amplitude of the injected signal."""
    factor = shown_factor(loop.unit)
    amplitude = factor * np.array([point.amplitude for point in loop.amplitudes])
    value = np.array([point.value for point in loop.amplitudes])
    order = np.argsort(amplitude)
    amplitude, value = amplitude[order], value[order]
    _over(gain_axes, amplitude, in_db(value), "gain, dB")
    _over(phase_axes, amplitude, np.degrees(np.unwrap(np.angle(value))), "phase, deg")
    phase_axes.set_xlabel(labelled("amplitude at the cut", loop.unit))


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
    factor = shown_factor(element.unit)
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
    axes.set_xlabel(labelled("amplitude", element.unit))


def draw_sweep(sweep: SweepReport, limits: Limits, gain_axes: Axes, phase_axes: Axes) -> None:
    """Gain and phase margin over a parameter, with the limits and where they are crossed."""
    factor = shown_factor(sweep.unit)
    x = factor * sweep.values
    gain = 20.0 * np.log10(np.where(sweep.gain_margin > 0.0, sweep.gain_margin, np.nan))
    shown: list[tuple[Axes, np.ndarray, float | None, str]] = [
        (gain_axes, gain, limits.gain, "gain margin, dB"),
        (phase_axes, np.degrees(sweep.phase_margin), limits.phase, "phase margin, deg"),
    ]
    for axes, y, limit, title in shown:
        axes.plot(x, np.where(np.isfinite(y), y, np.nan), color=BLUE, marker="o", markersize=2.5)
        if limit is not None:
            axes.axhline(limit, **LIMIT)
            if float(np.nanmin(y, initial=0.0)) < 0.0:
                axes.axhline(-limit, **LIMIT)
        for value in sweep.crossings.values():
            if value is not None and math.isfinite(value):
                axes.axvline(factor * value, color=INK, linewidth=0.9, linestyle=(0, (1.2, 1.6)))
        axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 1.5, 2, 3, 5, 10]))
        axes.yaxis.set_major_formatter(FuncFormatter(tick))
        axes.set_title(title, loc="left", fontsize=8.5)
        if np.min(x) > 0.0 and np.max(x) > 20.0 * np.min(x):
            frequency_axis(axes, float(np.min(x)), float(np.max(x)))
        else:
            plain_ticks(axes, x=5)
            axes.set_xlim(float(np.min(x)), float(np.max(x)))
    phase_axes.set_xlabel(labelled(sweep.parameter, sweep.unit))


def draw_joint(joint: JointReport, axes: Axes) -> None:
    """The disk margin of all channels at once over frequency, its least value and the limit."""
    axes.plot(joint.frequency, joint.disk_margins, color=BLUE)
    if math.isfinite(joint.disk_frequency):
        axes.plot(joint.disk_frequency, joint.disk_margin, **PHASE_MARK)
    for item in joint.requirements:
        if item.quantity == "disk margin":
            axes.axhline(item.limit, **LIMIT)
    finite = joint.disk_margins[np.isfinite(joint.disk_margins)]
    axes.set_ylim(0.0, min(2.1, 1.1 * float(np.max(finite, initial=0.1))))
    plain_ticks(axes, y=5)
    frequency_axis(axes, float(joint.frequency[0]), float(joint.frequency[-1]))
    axes.set_title("disk margin", loc="left", fontsize=8.5)
    axes.set_xlabel("rad/s")
