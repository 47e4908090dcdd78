"""Bode diagram and sensitivities of a loop, in dB and degrees over rad/s.

The axes are ours and not python-control's `bode_plot`, `nyquist_plot` and the like: those draw through pyplot's
current figure, which is global, bring titles, legends and mathematical type of their own, cannot show a measured
response beside a computed one, and know no exclusion zone. What is drawn are the study's own numbers.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator

from ....loops.decibels import decibel_size, decibels
from ....loops.readings import Classical, Curve
from ....stability.results.loop import LoopReport
from ...kit.quantities import log_tick, number, tick
from ...kit.style import BLUE, FAINT, GREEN, INK, VERMILION, log_ticks_x

MEASURED: Any = {
    "linestyle": "", "marker": "o", "markersize": 3.0, "markerfacecolor": "none", "markeredgecolor": INK,
    "markeredgewidth": 0.7, "zorder": 3,
}  # fmt: skip
MARGIN: Any = {"color": VERMILION, "linewidth": 1.8, "zorder": 4, "solid_capstyle": "butt"}
GAIN_MARK: Any = {"linestyle": "", "marker": "D", "markersize": 4.5, "color": VERMILION, "zorder": 5}
PHASE_MARK: Any = {"linestyle": "", "marker": "s", "markersize": 4.5, "color": VERMILION, "zorder": 5}
FLOOR = 1e-12  # of a gain, for its logarithm
FAR = 60.0  # dB below 1, from where on a gain says nothing about margins


def in_db(values: np.ndarray) -> np.ndarray:
    """Sizes in dB; what is zero is far down."""
    return decibels(np.maximum(np.abs(values), FLOOR))


def phase_of(curve: Curve, at: float | None) -> np.ndarray:
    """The unwrapped phase (deg) of a curve, on the branch that at the frequency ``at`` is in (-360, 0]."""
    phase = np.degrees(np.unwrap(np.angle(curve.value)))
    reference = phase[len(phase) // 2] if at is None else float(np.interp(at, curve.frequency, phase))
    return phase - 360.0 * math.ceil(reference / 360.0)


def beside(curve: Curve, phase: np.ndarray, measured: Curve) -> np.ndarray:
    """The phase (deg) of measured points, each on the branch nearest to the curve's."""
    expected = np.interp(measured.frequency, curve.frequency, phase)
    found = np.degrees(np.angle(measured.value))
    return found + 360.0 * np.round((expected - found) / 360.0)


def frequency_axis(axes: Axes, low: float, high: float) -> None:
    """Angular frequencies over a logarithmic abscissa, marked also where it has no whole decade."""
    log_ticks_x(axes)
    axes.set_xlim(low, high)
    if high < 150.0 * low:
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=8))
        axes.xaxis.set_major_formatter(FuncFormatter(log_tick))


def measured_too(loop: LoopReport) -> Curve | None:
    """The response of route B where the curve is route A's."""
    if loop.route_a is None or loop.route_b is None:
        return None
    return loop.route_b.curve


def margin_crossings(loop: LoopReport) -> Classical:
    """The crossings that are margins: none where the closed loop is unstable."""
    return replace(loop.classical, gain=(), phase=()) if loop.margins.unstable else loop.classical


def draw_bode(loop: LoopReport, gain_axes: Axes, phase_axes: Axes) -> None:
    """Gain and phase with the decisive margins as bars; circles are the measured response."""
    curve, found = loop.curve, margin_crossings(loop)
    gain, phase = found.gain_margin, found.phase_margin
    centre = phase.frequency if phase is not None else gain.frequency if gain is not None else None
    degrees = phase_of(curve, centre)
    gain_axes.plot(curve.frequency, in_db(curve.value), color=BLUE)
    phase_axes.plot(curve.frequency, degrees, color=BLUE)
    measured = measured_too(loop)
    if measured is not None:
        gain_axes.plot(measured.frequency, in_db(measured.value), **MEASURED)
        phase_axes.plot(measured.frequency, beside(curve, degrees, measured), **MEASURED)
    gain_axes.axhline(0.0, color=INK, linewidth=0.8)
    low, high = float(np.min(degrees)), float(np.max(degrees))
    for line in range(math.floor(low / 360.0) * 360 - 180, math.ceil(high / 360.0) * 360 + 180, 360):
        if low - 30.0 <= line <= high + 30.0:
            phase_axes.axhline(line, color=INK, linewidth=0.8)
    if gain is not None:
        gain_axes.plot([gain.frequency] * 2, [0.0, -decibels(gain.value)], **MARGIN)
        gain_axes.plot(gain.frequency, -decibels(gain.value), **GAIN_MARK)
    if phase is not None:
        at = float(np.interp(phase.frequency, curve.frequency, degrees))
        phase_axes.plot([phase.frequency] * 2, [at, at - math.degrees(phase.value)], **MARGIN)
        phase_axes.plot(phase.frequency, at, **PHASE_MARK)
    for axes in (gain_axes, phase_axes):
        frequency_axis(axes, float(curve.frequency[0]), float(curve.frequency[-1]))
    gain_axes.set_ylim(*_gain_limits(in_db(curve.value), -decibels(gain.value) if gain is not None else 0.0))
    gain_axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 4, 5, 10]))
    gain_axes.yaxis.set_major_formatter(FuncFormatter(tick))
    phase_axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 1.5, 3, 4.5, 9, 10]))
    phase_axes.yaxis.set_major_formatter(FuncFormatter(tick))
    gain_axes.set_title("gain, dB", loc="left", fontsize=8.5)
    phase_axes.set_title("phase, deg", loc="left", fontsize=8.5)
    phase_axes.set_xlabel("rad/s")


def _gain_limits(gain: np.ndarray, marked: float) -> tuple[float, float]:
    """Limits of the gain's axis (dB): all of it, but a zero of the response does not squeeze the rest."""
    low, high = float(np.min(gain)), max(float(np.max(gain)), marked, 0.0)
    low = max(min(low, marked, 0.0), min(-FAR, marked - 0.5 * FAR))
    return low - 0.05 * (high - low) - 1.0, high + 0.05 * (high - low) + 1.0


def draw_sensitivity(loop: LoopReport, axes: Axes, modulus_limit: float | None) -> None:
    """Sensitivity and complementary sensitivity with their peaks, and the limit on the former's."""
    curve, found = loop.curve, loop.robust
    sensitivity = 1.0 / (1.0 + curve.value)
    s, t = in_db(sensitivity), in_db(curve.value * sensitivity)
    axes.plot(curve.frequency, s, color=BLUE, label="S")
    axes.plot(curve.frequency, t, color=GREEN, linestyle=(0, (5, 1.6)), label="T")
    for frequency, peak in (
        (found.sensitivity_frequency, found.sensitivity_peak),
        (found.complementary_frequency, found.complementary_peak),
    ):
        if not loop.margins.unstable and math.isfinite(frequency) and math.isfinite(peak) and peak > 0.0:
            axes.plot(frequency, decibels(peak), **PHASE_MARK)
    top = max(float(np.max(s)), float(np.max(t)))
    if modulus_limit:
        axes.axhline(-decibels(modulus_limit), color=VERMILION, linewidth=1.0, linestyle=(0, (4, 2)))
        top = max(top, -decibels(modulus_limit))
    axes.axhline(0.0, color=INK, linewidth=0.8)
    axes.set_ylim(-40.0, 1.15 * top + 2.0)
    frequency_axis(axes, float(curve.frequency[0]), float(curve.frequency[-1]))
    axes.yaxis.set_major_formatter(FuncFormatter(tick))
    axes.set_title("gain, dB", loc="left", fontsize=8.5)
    axes.set_xlabel("rad/s")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, handlelength=2.6, borderaxespad=0.0)


def margin_words(loop: LoopReport) -> str:
    """The classical margins in words, for those who cannot see the figure."""
    if loop.margins.unstable:
        return "the closed loop is unstable, hence no margins"
    gain, phase = loop.classical.gain_margin, loop.classical.phase_margin
    words = []
    if gain is not None:
        words.append(f"gain margin {number(decibel_size(gain.value))} dB at {number(gain.frequency)} rad/s")
    if phase is not None:
        words.append(f"phase margin {number(math.degrees(phase.value))} deg at {number(phase.frequency)} rad/s")
    return ", ".join(words) or "no crossing, hence no gain or phase margin"


def faint_line(axes: Axes, x: np.ndarray, y: np.ndarray) -> None:
    """A line in the background: circles, lines of damping."""
    axes.plot(x, y, color=FAINT, linewidth=0.7, linestyle=(0, (1.2, 1.6)), zorder=1.5)
