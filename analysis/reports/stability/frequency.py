"""Responses over frequency in dB over rad/s: what diagrams of a loop share, the limits they show, and sensitivities.

The axes are ours and not python-control's `bode_plot`, `nyquist_plot` and the like: those draw through pyplot's
current figure, which is global, bring titles, legends and mathematical type of their own, cannot show a measured
response beside a computed one, and know no exclusion zone. What is drawn are the study's own numbers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator

from ...stability.loops.margin_values import Quantity
from ...stability.loops.readings import Classical, Curve, decibel_size, decibels, degree_size
from ...stability.results.report import LoopReport
from ..common.quantities import log_tick, number, tick
from ..common.style import BLUE, FAINT, GREEN, INK, VERMILION, LineStyle, log_ticks_x

MEASURED: LineStyle = {
    "linestyle": "", "marker": "o", "markersize": 3.0, "markerfacecolor": "none", "markeredgecolor": INK,
    "markeredgewidth": 0.7, "zorder": 3,
}  # fmt: skip
MARGIN: LineStyle = {"color": VERMILION, "linewidth": 1.8, "zorder": 4, "solid_capstyle": "butt"}
DECISIVE: LineStyle = {"markersize": 6.0}  # the nearest crossing; others are hollow
OTHER: LineStyle = {"markerfacecolor": "white"}
GAIN_MARK: LineStyle = {"linestyle": "", "marker": "D", "markersize": 4.5, "color": VERMILION, "zorder": 5}
PHASE_MARK: LineStyle = {"linestyle": "", "marker": "s", "markersize": 4.5, "color": VERMILION, "zorder": 5}
FLOOR = 1e-12  # of a gain, for its logarithm


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
    degrees = np.degrees(np.angle(measured.value))
    return degrees + 360.0 * np.round((expected - degrees) / 360.0)


def frequency_axis(axes: Axes, low: float, high: float) -> None:
    """Angular frequencies over a logarithmic abscissa, marked also where it has no whole decade."""
    log_ticks_x(axes)
    axes.set_xlim(low, high)
    if high < 150.0 * low:
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=8))
        axes.xaxis.set_major_formatter(FuncFormatter(log_tick))


def has_measurement(loop: LoopReport) -> Curve | None:
    """The response of the frequency-response test where the curve is the linearisation's."""
    if loop.linearised is None or loop.measured_response is None:
        return None
    return loop.measured_response.curve


def margin_crossings(loop: LoopReport) -> Classical:
    """The crossings that are margins: none where the closed loop is unstable."""
    return replace(loop.classical, gain=(), phase=()) if loop.margins.unstable else loop.classical


def draw_sensitivity(loop: LoopReport, axes: Axes, modulus_limit: float | None) -> None:
    """Sensitivity and complementary sensitivity with their peaks, and the limit on the former's."""
    curve, peaks = loop.curve, loop.robust
    sensitivity = 1.0 / (1.0 + curve.value)
    s, t = in_db(sensitivity), in_db(curve.value * sensitivity)
    axes.plot(curve.frequency, s, color=BLUE, label="S")
    axes.plot(curve.frequency, t, color=GREEN, linestyle=(0, (5, 1.6)), label="T")
    for frequency, peak in (
        (peaks.sensitivity_frequency, peaks.sensitivity_peak),
        (peaks.complementary_frequency, peaks.complementary_peak),
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


def gain_words(loop: LoopReport) -> str:
    """The gain margin and its frequency, as it stands over a diagram."""
    gain = margin_crossings(loop).gain_margin
    if gain is None:
        return "unstable: no margins" if loop.margins.unstable else "no phase crossover"
    side = "upper" if gain.value >= 1.0 else "lower"
    return f"{side} gain margin {number(decibel_size(gain.value), 3)} dB at {number(gain.frequency, 3)} rad/s"


def phase_words(loop: LoopReport) -> str:
    """The phase margin and the gain crossover, as they stand over a diagram."""
    phase = margin_crossings(loop).phase_margin
    if phase is None:
        return "" if loop.margins.unstable else "no gain crossover"
    lead = " (lead)" if phase.value < 0.0 else ""
    return f"phase margin {number(degree_size(phase.value), 3)}°{lead} at {number(phase.frequency, 3)} rad/s"


def faint_line(axes: Axes, x: np.ndarray, y: np.ndarray) -> None:
    """A line in the background: circles, lines of damping."""
    axes.plot(x, y, color=FAINT, linewidth=0.7, linestyle=(0, (1.2, 1.6)), zorder=1.5)


LIMIT: LineStyle = {"color": VERMILION, "linewidth": 1.0, "linestyle": (0, (4, 2))}
FORBIDDEN = "#f6d5c0"  # fill of where a response or a margin must not be
BEHIND: Any = {"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.8}  # of words over a line


@dataclass(frozen=True)
class Limits:
    """The limits that figures show, as they are required of the loop; None: not required."""

    gain: float | None  # dB
    phase: float | None  # deg
    modulus: float | None


def limits_of(loop: LoopReport) -> Limits:
    """The limits among a loop's requirements."""
    limits = {item.quantity: item.limit for item in loop.requirements}
    return Limits(limits.get(Quantity.GAIN), limits.get(Quantity.PHASE), limits.get(Quantity.MODULUS))
