"""Responses over frequency (dB over rad/s): common elements of a loop's diagrams, limits, sensitivities.

The charts do not use python-control's `bode_plot`, `nyquist_plot` and so on. These functions draw through pyplot's
global current figure, add titles, legends and mathematical fonts, cannot combine a measured and a computed response,
and do not support exclusion zones. All drawn numbers are from the study.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .....stability.loops.margin_values import MarginQuantity
from .....stability.loops.readings import Classical, FrequencyResponse, decibel_size, decibels, degree_size
from .....stability.results.report import LoopReport
from ....chart.axes import fine_axis, linear_axis
from ....chart.lines import line
from ....chart.marks import horizontal_line
from ....chart.symbols import mark, marker
from ....common.colours import BLUE, FAINT, GREEN, INK, VERMILION
from ....common.quantities import number
from ....interactive import charts
from ....interactive.charts import NO_BOX, Axis, Backing, Chart, Marker

MEASURED = marker("o", 3.0, INK, fill="", width=0.7)
MARGIN_WIDTH = 1.8  # pt, of the bar of a margin
MARK, DECISIVE = 4.5, 6.0  # pt, marks of a crossing and of the nearest one, which is filled
DOTS = (1.2, 1.6)  # line widths
REQUIRED = (4.0, 2.0)
COMPLEMENTARY = (5.0, 1.6)  # T
FLOOR = 1e-12  # least gain, for its logarithm
WHITE = "#ffffff"
PEAK = marker("s", MARK, VERMILION)
FORBIDDEN = "#f6d5c0"  # fill of forbidden regions
BEHIND = Backing(WHITE, 0.8, 0.8)  # backing of words over a line


def in_db(values: np.ndarray) -> np.ndarray:
    """Convert magnitudes to dB, with a floor for zero."""
    return decibels(np.maximum(np.abs(values), FLOOR))


def phase_of(curve: FrequencyResponse, at: float | None) -> np.ndarray:
    """Return the unwrapped phase (deg) of a response, on the branch that is in (-360, 0] at the frequency ``at``."""
    phase = np.degrees(np.unwrap(np.angle(curve.value)))
    reference = phase[len(phase) // 2] if at is None else float(np.interp(at, curve.frequency, phase))
    return phase - 360.0 * math.ceil(reference / 360.0)


def nearest_phase(curve: FrequencyResponse, phase: np.ndarray, measured: FrequencyResponse) -> np.ndarray:
    """Return the phase (deg) of measured points, each on the branch nearest to the curve."""
    expected = np.interp(measured.frequency, curve.frequency, phase)
    degrees = np.degrees(np.angle(measured.value))
    return degrees + 360.0 * np.round((expected - degrees) / 360.0)


def frequency_axis(low: float, high: float) -> Axis:
    """Return the axis of angular frequency (rad/s)."""
    return fine_axis((low, high), label="rad/s")


def gain_mark(*, is_decisive: bool) -> Marker:
    """Return the mark of a phase crossover, where the gain margin is read."""
    return marker("D", DECISIVE, VERMILION) if is_decisive else marker("D", MARK, VERMILION, fill=WHITE)


def phase_mark(*, is_decisive: bool) -> Marker:
    """Return the mark of a gain crossover, where the phase margin is read, and of a peak."""
    return marker("s", DECISIVE, VERMILION) if is_decisive else marker("s", MARK, VERMILION, fill=WHITE)


def measured_curve(loop: LoopReport) -> FrequencyResponse | None:
    """Return the measured response if the loop's curve is from a linearisation; else None."""
    if loop.linearised is None or loop.measured_response is None:
        return None
    return loop.measured_response.curve


def margin_crossings(loop: LoopReport) -> Classical:
    """Return the crossings that are margins; none for an unstable closed loop."""
    return replace(loop.classical, gain=(), phase=()) if loop.margins.unstable else loop.classical


def sensitivity_chart(loop: LoopReport) -> Chart:
    """Return the chart of sensitivity and complementary sensitivity (dashed), with peaks and the limit."""
    curve, peaks, limit = loop.curve, loop.robust, limits_of(loop).modulus
    sensitivity = 1.0 / (1.0 + curve.value)
    s, t = in_db(sensitivity), in_db(curve.value * sensitivity)
    curves = [line(curve.frequency, s, BLUE), line(curve.frequency, t, GREEN, dashes=COMPLEMENTARY)]
    for frequency, peak in (
        (peaks.sensitivity_frequency, peaks.sensitivity_peak),
        (peaks.complementary_frequency, peaks.complementary_peak),
    ):
        if not loop.margins.unstable and math.isfinite(frequency) and math.isfinite(peak) and peak > 0.0:
            curves.append(mark(frequency, float(decibels(peak)), PEAK))
    top = max(float(np.max(s)), float(np.max(t)))
    rules = [horizontal_line(0.0, INK, 0.8)]
    if limit:
        required = -float(decibels(limit))
        rules.append(horizontal_line(required, VERMILION, 1.0, REQUIRED))
        top = max(top, required)
    abscissa = frequency_axis(float(curve.frequency[0]), float(curve.frequency[-1]))
    ordinate = linear_axis((-40.0, 1.15 * top + 2.0), 6)
    return Chart(NO_BOX, abscissa, ordinate, title="S and, dashed, T, dB", curves=curves, rules=rules)


def margin_words(loop: LoopReport) -> str:
    """Return the classical margins in words, for screen readers."""
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
    """Return the gain margin and its frequency as the heading of a diagram."""
    gain = margin_crossings(loop).gain_margin
    if gain is None:
        return "unstable: no margins" if loop.margins.unstable else "no phase crossover"
    side = "upper" if gain.value >= 1.0 else "lower"
    return f"{side} margin {number(decibel_size(gain.value), 3)} dB at {number(gain.frequency, 3)} rad/s"


def phase_words(loop: LoopReport) -> str:
    """Return the phase margin and the gain crossover as the heading of a diagram."""
    phase = margin_crossings(loop).phase_margin
    if phase is None:
        return "" if loop.margins.unstable else "no gain crossover"
    lead = " (lead)" if phase.value < 0.0 else ""
    return f"margin {number(degree_size(phase.value), 3)}°{lead} at {number(phase.frequency, 3)} rad/s"


def faint_line(x: np.ndarray, y: np.ndarray) -> charts.Curve:
    """Return a line in the background, such as a circle or a line of constant damping."""
    return line(x, y, FAINT, width=0.7, dashes=DOTS)


@dataclass(frozen=True)
class LimitLines:
    """The limits that figures of a loop show; None for a margin that is not required."""

    gain: float | None  # dB
    phase: float | None  # deg
    modulus: float | None


def limits_of(loop: LoopReport) -> LimitLines:
    """Return the limits among a loop's requirements."""
    limits = {item.quantity: item.limit for item in loop.requirements}
    return LimitLines(
        limits.get(MarginQuantity.GAIN), limits.get(MarginQuantity.PHASE), limits.get(MarginQuantity.MODULUS)
    )
