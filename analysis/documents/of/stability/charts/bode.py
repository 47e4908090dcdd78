"""Bode diagram of a loop: gain and phase, with actual and required margins at their crossover frequencies."""

from __future__ import annotations

import math

import numpy as np

from .....stability.loops.readings import Classical, decibels
from .....stability.results.report import LoopReport
from ....chart.axes import linear_axis
from ....chart.lines import line
from ....chart.marks import horizontal_line, vertical_line
from ....chart.symbols import mark, marks
from ....chart.ticks import axis_ends
from ....common.colours import BLUE, FAINT, INK, VERMILION
from ....common.quantities import number
from ....interactive.charts import NO_BOX, Axis, Chart, ChartNote, Curve, Rule
from .frequency import (
    BEHIND,
    DOTS,
    MARGIN_WIDTH,
    MEASURED,
    REQUIRED,
    frequency_axis,
    gain_mark,
    gain_words,
    in_db,
    limits_of,
    margin_crossings,
    measured_curve,
    nearest_phase,
    phase_mark,
    phase_of,
    phase_words,
)

LOWEST_GAIN, HIGHEST_GAIN = 60.0, 80.0  # dB below and above 1 beyond which a gain is irrelevant to margins
REACH = 0.07  # half-length of a limit's line, over the length of the frequency axis
ROOM = 0.085  # width of a label over the length of the frequency axis
GAINS = (1.0, 2.0, 4.0, 5.0, 10.0)  # dB, steps between ticks, times a power of ten
PHASES = (1.0, 1.5, 3.0, 4.5, 9.0, 10.0)  # deg, steps between ticks, times a power of ten


def bode_charts(loop: LoopReport) -> tuple[Chart, Chart]:
    """Return charts of gain and phase: decisive margins are bars, limits are dashed, measured points are circles.

    A dotted line through both charts marks the frequency of each decisive margin.
    """
    crossings = margin_crossings(loop)
    return _gain_chart(loop, crossings), _phase_chart(loop, crossings)


def _gain_chart(loop: LoopReport, crossings: Classical) -> Chart:
    """Return the gain chart: all crossings of -180 deg, a bar to the nearest, and the gain at the required margin."""
    curve, gain, limit = loop.curve, crossings.gain_margin, limits_of(loop).gain
    abscissa = frequency_axis(float(curve.frequency[0]), float(curve.frequency[-1]))
    curves = [line(curve.frequency, in_db(curve.value), BLUE)]
    notes: list[ChartNote] = []
    if gain is not None and limit is not None:
        height = -limit if gain.value >= 1.0 else limit
        words = f"{number(limit)} dB"
        dashed, note = _requirement(abscissa, gain.frequency, height, words, to_right=gain.value >= 1.0)
        curves.append(dashed)
        notes.append(note)
    measured = measured_curve(loop)
    if measured is not None:
        curves.append(marks(measured.frequency, in_db(measured.value), MEASURED))
    if gain is not None:
        bar = np.array([0.0, -decibels(gain.value)])
        curves.append(line(np.full(2, gain.frequency), bar, VERMILION, width=MARGIN_WIDTH))
    for crossing in crossings.gain:
        is_decisive = crossing is gain
        at, height = _within(abscissa, crossing.frequency), -float(decibels(crossing.value))
        curves.append(mark(at, height, gain_mark(is_decisive=is_decisive), beyond=is_decisive))
    ends = _gain_ends(in_db(curve.value), -float(decibels(gain.value)) if gain is not None else 0.0)
    rules, title = [horizontal_line(0.0, INK, 0.8), *_crossovers(crossings)], f"gain, dB: {gain_words(loop)}"
    ordinate = linear_axis(ends, 5, multiples=GAINS)
    return Chart(NO_BOX, abscissa, ordinate, title=title, curves=curves, rules=rules, notes=notes)


def _phase_chart(loop: LoopReport, crossings: Classical) -> Chart:
    """Return the phase chart: all crossings of 0 dB, a bar to the nearest, and the phase at the required margin."""
    curve, phase, limit = loop.curve, crossings.phase_margin, limits_of(loop).phase
    centre = phase or crossings.gain_margin
    degrees = phase_of(curve, None if centre is None else centre.frequency)
    abscissa = frequency_axis(float(curve.frequency[0]), float(curve.frequency[-1]))
    curves = [line(curve.frequency, degrees, BLUE)]
    notes: list[ChartNote] = []
    plotted = [degrees]
    if phase is not None:
        at = float(np.interp(phase.frequency, curve.frequency, degrees))
        critical = at - math.degrees(phase.value)
        plotted.append(np.array([critical]))
        if limit is not None:
            height = critical + math.copysign(limit, phase.value)
            dashed, note = _requirement(abscissa, phase.frequency, height, f"{number(limit)}°", to_right=False)
            curves.append(dashed)
            notes.append(note)
            plotted.append(np.array([height]))
    measured = measured_curve(loop)
    if measured is not None:
        around = nearest_phase(curve, degrees, measured)
        curves.append(marks(measured.frequency, around, MEASURED))
        plotted.append(around)
    if phase is not None:
        curves.append(line(np.full(2, phase.frequency), np.array([at, critical]), VERMILION, width=MARGIN_WIDTH))
    for crossing in crossings.phase:
        at = float(np.interp(crossing.frequency, curve.frequency, degrees))
        curves.append(mark(crossing.frequency, at, phase_mark(is_decisive=crossing is phase)))
    low, high = float(np.min(degrees)), float(np.max(degrees))
    critical_phases = range(math.floor(low / 360.0) * 360 - 180, math.ceil(high / 360.0) * 360 + 180, 360)
    levels = [float(each) for each in critical_phases if low - 30.0 <= each <= high + 30.0]
    plotted.append(np.array(levels))
    ordinate = linear_axis(axis_ends(np.concatenate(plotted)), 5, multiples=PHASES)
    title = f"phase, deg: {phase_words(loop)}".rstrip(": ")
    rules = [*(horizontal_line(each, INK, 0.8) for each in levels), *_crossovers(crossings)]
    return Chart(NO_BOX, abscissa, ordinate, title=title, curves=curves, rules=rules, notes=notes)


def _crossovers(crossings: Classical) -> list[Rule]:
    """Return the frequencies of the decisive margins."""
    decisive = [each for each in (crossings.gain_margin, crossings.phase_margin) if each is not None]
    return [vertical_line(each.frequency, FAINT, 0.7, DOTS) for each in decisive]


def _within(axis: Axis, frequency: float) -> float:
    """Return a frequency limited to the range of the axis, since a crossing is at 0 if L is real at low frequency."""
    return min(max(frequency, axis.ends[0]), axis.ends[1])


def _requirement(axis: Axis, frequency: float, height: float, words: str, *, to_right: bool) -> tuple[Curve, ChartNote]:
    """Return a required margin as a short dashed line at its crossover, labelled on the right or the left.

    Responses usually fall with frequency: a response below the line crosses it on the left, a response above it crosses
    it on the right.
    """
    low, high = (math.log10(end) for end in axis.ends)
    frequency = _within(axis, frequency)
    reach = 10.0 ** (REACH * (high - low))
    ends = max(frequency / reach, axis.ends[0]), min(frequency * reach, axis.ends[1])
    dashed = line(np.array(ends), np.full(2, height), VERMILION, width=1.4, dashes=REQUIRED)
    is_right = (
        math.log10(ends[1]) < high - ROOM * (high - low)
        if to_right
        else math.log10(ends[0]) < low + ROOM * (high - low)
    )
    at, offset, side = (ends[1], 3.0, "left") if is_right else (ends[0], -3.0, "right")
    return dashed, ChartNote(
        words, (at, height), (False, False), (offset, 0.0), (side, "center"), VERMILION.lower(), 8.0, backing=BEHIND
    )


def _gain_ends(gain: np.ndarray, marked: float) -> tuple[float, float]:
    """Return the ends of the gain axis (dB): the full range, unless a zero or a pole would compress other gains."""
    low, high = float(np.min(gain)), max(min(float(np.max(gain)), HIGHEST_GAIN), marked, 0.0)
    low = max(min(low, marked, 0.0), min(-LOWEST_GAIN, marked - 0.5 * LOWEST_GAIN))
    return low - 0.05 * (high - low) - 1.0, high + 0.05 * (high - low) + 1.0
