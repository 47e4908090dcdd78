"""The Bode diagram of a loop: gain and phase with margins, crossover frequencies and the margins that are required."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, MaxNLocator

from ...stability.loops.readings import Classical, decibels
from ...stability.results.report import LoopReport
from ..common.quantities import number, tick
from ..common.style import BLUE, FAINT, INK, VERMILION, LineStyle
from .frequency import (
    BEHIND,
    DECISIVE,
    GAIN_MARK,
    LIMIT,
    MARGIN,
    MEASURED,
    OTHER,
    PHASE_MARK,
    beside,
    frequency_axis,
    gain_words,
    has_measurement,
    in_db,
    limits_of,
    margin_crossings,
    phase_of,
    phase_words,
)

FAR, NEAR = 60.0, 80.0  # dB below and above 1, from where on a gain says nothing about margins
REACH = 0.07  # of the frequency axis, to either side of a crossover, over which a limit is drawn
ROOM = 0.085  # of the frequency axis, which words take


def draw_bode(loop: LoopReport, gain_axes: Axes, phase_axes: Axes) -> None:
    """Gain and phase with the decisive margins as bars, their limits dashed; circles are the measured response.

    A dotted line through both axes marks the frequency at which each decisive margin is read.
    """
    curve, crossings = loop.curve, margin_crossings(loop)
    gain, phase = crossings.gain_margin, crossings.phase_margin
    centre = phase.frequency if phase is not None else gain.frequency if gain is not None else None
    degrees = phase_of(curve, centre)
    gain_axes.plot(curve.frequency, in_db(curve.value), color=BLUE)
    phase_axes.plot(curve.frequency, degrees, color=BLUE)
    measured = has_measurement(loop)
    if measured is not None:
        gain_axes.plot(measured.frequency, in_db(measured.value), **MEASURED)
        phase_axes.plot(measured.frequency, beside(curve, degrees, measured), **MEASURED)
    gain_axes.axhline(0.0, color=INK, linewidth=0.8)
    low, high = float(np.min(degrees)), float(np.max(degrees))
    for line in range(math.floor(low / 360.0) * 360 - 180, math.ceil(high / 360.0) * 360 + 180, 360):
        if low - 30.0 <= line <= high + 30.0:
            phase_axes.axhline(line, color=INK, linewidth=0.8)
    for axes in (gain_axes, phase_axes):
        frequency_axis(axes, float(curve.frequency[0]), float(curve.frequency[-1]))
        for crossing in (gain, phase):
            if crossing is not None:
                axes.axvline(crossing.frequency, color=FAINT, linewidth=0.7, linestyle=(0, (1.2, 1.6)), zorder=1.5)
    _draw_gain_margins(loop, crossings, gain_axes)
    _draw_phase_margins(loop, crossings, degrees, phase_axes)
    gain_axes.set_ylim(*_gain_limits(in_db(curve.value), -decibels(gain.value) if gain is not None else 0.0))
    gain_axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 4, 5, 10]))
    gain_axes.yaxis.set_major_formatter(FuncFormatter(tick))
    phase_axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 1.5, 3, 4.5, 9, 10]))
    phase_axes.yaxis.set_major_formatter(FuncFormatter(tick))
    for axes, title, margin in (
        (gain_axes, "gain, dB", gain_words(loop)),
        (phase_axes, "phase, deg", phase_words(loop)),
    ):
        axes.set_title(title, loc="left", fontsize=8.5)
        axes.set_title(margin, loc="right", fontsize=8.5)
    phase_axes.set_xlabel("rad/s")


def _draw_gain_margins(loop: LoopReport, crossings: Classical, axes: Axes) -> None:
    """Every crossing of -180 deg, a bar to the nearest, and the gain at which its margin would be the one required."""
    gain, limit = crossings.gain_margin, limits_of(loop).gain
    for crossing in crossings.gain:
        kind: LineStyle = DECISIVE | {"clip_on": False} if crossing is gain else OTHER
        axes.plot(_within(axes, crossing.frequency), -decibels(crossing.value), **(GAIN_MARK | kind))
    if gain is None:
        return
    axes.plot([gain.frequency] * 2, [0.0, -decibels(gain.value)], **MARGIN)
    if limit is not None:
        _draw_limit(
            axes, gain.frequency, -limit if gain.value >= 1.0 else limit, f"{number(limit)} dB", right=gain.value >= 1.0
        )


def _draw_phase_margins(loop: LoopReport, crossings: Classical, degrees: np.ndarray, axes: Axes) -> None:
    """Every crossing of 0 dB, a bar to the nearest, and the phase at which its margin would be the one required."""
    phase, limit = crossings.phase_margin, limits_of(loop).phase
    for crossing in crossings.phase:
        at = float(np.interp(crossing.frequency, loop.curve.frequency, degrees))
        axes.plot(crossing.frequency, at, **(PHASE_MARK | (DECISIVE if crossing is phase else OTHER)))
    if phase is None:
        return
    at = float(np.interp(phase.frequency, loop.curve.frequency, degrees))
    critical = at - math.degrees(phase.value)
    axes.plot([phase.frequency] * 2, [at, critical], **MARGIN)
    if limit is not None:
        _draw_limit(
            axes, phase.frequency, critical + math.copysign(limit, phase.value), f"{number(limit)}°", right=False
        )


def _within(axes: Axes, frequency: float) -> float:
    """A frequency that the axis has: a crossing lies at 0 where L is real at its start."""
    low, high = axes.get_xlim()
    return min(max(frequency, low), high)


def _draw_limit(axes: Axes, frequency: float, height: float, words: str, *, right: bool) -> None:
    """A margin that is required, as a short dashed line at its crossover, with its size on the ``right`` or the left.

    A response falls: where it lies below the line it has passed it on the left, where above it does so on the right.
    """
    low, high = (math.log10(end) for end in axes.get_xlim())
    frequency = _within(axes, frequency)
    reach = 10.0 ** (REACH * (high - low))
    ends = max(frequency / reach, 10.0**low), min(frequency * reach, 10.0**high)
    axes.plot(ends, [height] * 2, **(LIMIT | {"linewidth": 1.4}))
    right = (
        math.log10(ends[1]) < high - ROOM * (high - low) if right else math.log10(ends[0]) < low + ROOM * (high - low)
    )
    axes.annotate(
        words, (ends[1] if right else ends[0], height), (3 if right else -3, 0), textcoords="offset points",
        ha="left" if right else "right", va="center", fontsize=8.0, color=VERMILION, bbox=BEHIND, zorder=3.5,
    )  # fmt: skip


def _gain_limits(gain: np.ndarray, marked: float) -> tuple[float, float]:
    """Limits of the gain's axis (dB): all of it, but a zero or a pole of the response does not squeeze the rest."""
    low, high = float(np.min(gain)), max(min(float(np.max(gain)), NEAR), marked, 0.0)
    low = max(min(low, marked, 0.0), min(-FAR, marked - 0.5 * FAR))
    return low - 0.05 * (high - low) - 1.0, high + 0.05 * (high - low) + 1.0
