"""The frequency response in the complex plane and in the Nichols diagram: how near it comes to the critical point."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator

from ...stability.loops.readings import Crossing, decibel_size, decibels
from ...stability.results.report import LoopReport
from ...stability.results.responses import Nonlinearity
from ..common.quantities import MINUS, number, tick
from ..common.style import BLUE, GREEN, INK, PURPLE, VERMILION, LineStyle, plain_ticks
from .frequency import (
    BEHIND,
    DECISIVE,
    FORBIDDEN,
    GAIN_MARK,
    LIMIT,
    MARGIN,
    MEASURED,
    OTHER,
    PHASE_MARK,
    faint_line,
    has_measurement,
    in_db,
    limits_of,
    margin_crossings,
)

INVERSE = f"{MINUS}1/N"
SHAPE = 1.2  # width over height of a panel's axes
CRITICAL: LineStyle = {
    "linestyle": "", "marker": "+", "markersize": 9, "markeredgewidth": 1.6, "color": INK, "zorder": 6,
}  # fmt: skip
ARROW: Any = {
    "arrowstyle": "-|>", "color": BLUE, "linewidth": 0.1, "mutation_scale": 12, "shrinkA": 0, "shrinkB": 0,
}  # fmt: skip
ANGLES = np.linspace(0.0, 2.0 * np.pi, 361)


def _complex_plane(axes: Axes, left: float, right: float) -> None:
    half = (right - left) / SHAPE / 2.0
    axes.set_aspect("equal")
    axes.set_xlim(left, right)
    axes.set_ylim(-half, half)
    plain_ticks(axes, x=5, y=5)
    axes.axhline(0.0, color=INK, linewidth=0.5)
    axes.axvline(0.0, color=INK, linewidth=0.5)
    axes.plot(-1.0, 0.0, **CRITICAL)
    axes.set_title("imaginary", loc="left", fontsize=8.5)
    axes.set_xlabel("real")


def _direction(axes: Axes, value: np.ndarray, left: float, right: float) -> None:
    """An arrow along the curve towards higher frequencies, in the middle of what is seen of it."""
    half = (right - left) / SHAPE / 2.0
    inside = (value.real > left) & (value.real < right) & (np.abs(value.imag) < half)
    seen = np.flatnonzero(inside)
    if seen.size < 4:
        return
    way = np.cumsum(np.abs(np.diff(value[seen], prepend=value[seen[0]])))
    middle = int(seen[np.searchsorted(way, 0.35 * way[-1])])
    tail, head = value[max(middle - 1, 0)], value[min(middle + 1, len(value) - 1)]
    axes.annotate("", (head.real, head.imag), (tail.real, tail.imag), arrowprops=ARROW)


def draw_nyquist(loop: LoopReport, axes: Axes) -> None:
    """L near -1 with the unit circle, the circle of the modulus margin and that of its limit."""
    value, crossings, limits = loop.curve.value, margin_crossings(loop), limits_of(loop)
    furthest = max([1.0 / item.value for item in loop.classical.gain if item.value > 0.0], default=1.0)
    left, right = -min(max(2.6, 1.15 * furthest), 8.0), 1.4
    axes.plot(value.real, value.imag, color=BLUE)
    axes.plot(value.real, -value.imag, color=BLUE, linewidth=0.8, linestyle=(0, (1.2, 1.2)))
    measured = has_measurement(loop)
    if measured is not None:
        axes.plot(measured.value.real, measured.value.imag, **MEASURED)
    faint_line(axes, np.cos(ANGLES), np.sin(ANGLES))
    if not loop.margins.unstable:
        around = loop.robust.modulus_margin
        axes.plot(-1.0 + around * np.cos(ANGLES), around * np.sin(ANGLES), color=GREEN, linewidth=1.2)
    if limits.modulus is not None:
        axes.plot(-1.0 + limits.modulus * np.cos(ANGLES), limits.modulus * np.sin(ANGLES), **LIMIT)
    for crossing in crossings.gain:
        axes.plot(-1.0 / crossing.value, 0.0, **GAIN_MARK)
    for crossing in crossings.phase:
        axes.plot(-math.cos(crossing.value), -math.sin(crossing.value), **PHASE_MARK)
    _complex_plane(axes, left, right)
    _direction(axes, value, left, right)


def draw_harmonic_balance(loop: LoopReport, element: Nonlinearity, axes: Axes) -> None:
    """L and -1/N(a): a limit cycle is predicted where they meet."""
    value = loop.curve.value
    retained = np.abs(element.gain) > 0.0
    inverse = -1.0 / element.gain[retained]
    meets = [np.interp(2.0 * math.pi / cycle.period, loop.curve.frequency, value) for cycle in element.cycles]
    furthest = max([1.0, *(-point.real for point in meets), *([-float(np.max(inverse.real))] if inverse.size else [])])
    left = -2.2 * min(furthest, 1e6)
    right = -0.45 * left
    axes.plot(value.real, value.imag, color=BLUE, label="L")
    axes.plot(inverse.real, inverse.imag, color=PURPLE, linewidth=2.2, linestyle=(0, (5, 1.6)), label=INVERSE)
    for cycle, point in zip(element.cycles, meets, strict=True):
        fill = INK if cycle.stable else "white"
        axes.plot(point.real, point.imag, "o", markersize=6, markerfacecolor=fill, markeredgecolor=INK, zorder=6)
    _complex_plane(axes, left, right)
    axes.legend(loc="lower right", handlelength=2.6)


LOW, HIGH = 20.0, 90.0  # dB up and down that are shown at least and at most


def draw_nichols(loop: LoopReport, axes: Axes) -> None:
    """L in gain over phase (-360 to 0 deg) with the exclusion zone of the limits and the oval of the modulus limit."""
    value, limits = loop.curve.value, limits_of(loop)
    if limits.gain is not None and limits.phase is not None:
        corners = [
            (-180.0 - limits.phase, 0.0),
            (-180.0, limits.gain),
            (-180.0 + limits.phase, 0.0),
            (-180.0, -limits.gain),
        ]
        zone: Any = {"facecolor": FORBIDDEN, "edgecolor": VERMILION, "linewidth": 1.0, "hatch": "////", "zorder": 1.6}
        axes.add_patch(Polygon(corners, **zone))
        label: Any = {"fontsize": 8.0, "color": VERMILION, "bbox": BEHIND, "zorder": 3.5}
        axes.text(-186.0, limits.gain, f"{number(limits.gain)} dB", ha="right", va="bottom", **label)
        axes.text(-184.0 - limits.phase, 0.0, f"{number(limits.phase)}°", ha="right", va="center", **label)
    if limits.modulus is not None and limits.modulus < 1.0:
        oval = -1.0 + limits.modulus * np.exp(1j * ANGLES)
        axes.plot(np.degrees(np.angle(-oval)) - 180.0, in_db(oval), **LIMIT)
    axes.plot(*_wrap_phase(value), color=BLUE)
    measured = has_measurement(loop)
    if measured is not None:
        axes.plot(np.degrees(np.angle(-measured.value)) - 180.0, in_db(measured.value), **MEASURED)
    height = _draw_margins(loop, axes)
    axes.plot(-180.0, 0.0, **CRITICAL)
    axes.set_xlim(-360.0, 0.0)
    axes.set_ylim(-height, height)
    axes.xaxis.set_major_locator(FixedLocator([-360, -270, -180, -90, 0]))
    axes.xaxis.set_major_formatter(FuncFormatter(tick))
    axes.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
    axes.yaxis.set_major_formatter(FuncFormatter(tick))
    axes.set_title("gain, dB", loc="left", fontsize=8.5)
    axes.set_title(_modulus_words(loop), loc="right", fontsize=8.5)
    axes.set_xlabel("phase, deg")


def _draw_margins(loop: LoopReport, axes: Axes) -> float:
    """All crossings, those that decide with a bar to the critical point; returns the height that shows them (dB)."""
    crossings = margin_crossings(loop)
    gain, phase = crossings.gain_margin, crossings.phase_margin
    if gain is not None:
        axes.plot([-180.0] * 2, [0.0, -decibels(gain.value)], **MARGIN)
    if phase is not None:
        axes.plot([-180.0, _phase_at(phase)], [0.0] * 2, **MARGIN)
    for crossing in crossings.gain:
        axes.plot(-180.0, -decibels(crossing.value), **(GAIN_MARK | (DECISIVE if crossing is gain else OTHER)))
    for crossing in crossings.phase:
        axes.plot(_phase_at(crossing), 0.0, **(PHASE_MARK | (DECISIVE if crossing is phase else OTHER)))
    reach = decibel_size(gain.value) if gain is not None else 0.0
    return min(max(LOW, 1.2 * reach), HIGH)


def _phase_at(crossing: Crossing) -> float:
    """Where a gain crossover lies (deg, -360 to 0)."""
    return math.degrees(math.remainder(crossing.value, 2.0 * math.pi)) - 180.0


def _modulus_words(loop: LoopReport) -> str:
    if loop.margins.unstable:
        return "unstable: no margins"
    modulus, limit = loop.robust.modulus_margin, limits_of(loop).modulus
    minimum = f", required {number(limit, 3)}" if limit is not None else ""
    return f"modulus margin {number(modulus, 3)}{minimum}"


def _wrap_phase(value: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Phase (deg, -360 to 0) and gain (dB) with gaps where the phase wraps."""
    phase, gain = np.degrees(np.angle(-value)) - 180.0, in_db(value)
    jumps = np.flatnonzero(np.abs(np.diff(phase)) > 180.0) + 1
    return np.insert(phase, jumps, np.nan), np.insert(gain, jumps, np.nan)
