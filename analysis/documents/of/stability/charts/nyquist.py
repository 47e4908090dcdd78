"""Frequency response in the complex plane and in the Nichols diagram: its distance from the critical point."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

import numpy as np

from .....stability.loops.readings import Classical, Crossing, decibel_size, decibels
from .....stability.results.report import LoopReport
from .....stability.results.responses import Nonlinearity
from ....chart.axes import linear_axis, ticked_axis
from ....chart.lines import line
from ....chart.marks import hatch, horizontal_line, outline, vertical_line
from ....chart.symbols import BARB, arrow, mark, marker, marks
from ....common.colours import BLUE, GREEN, INK, PURPLE, VERMILION
from ....common.quantities import MINUS, number
from ....interactive.charts import NO_BOX, Area, Chart, ChartNote, Curve
from .frequency import (
    BEHIND,
    COMPLEMENTARY,
    FORBIDDEN,
    MARGIN_WIDTH,
    MEASURED,
    REQUIRED,
    WHITE,
    LimitLines,
    faint_line,
    gain_mark,
    in_db,
    limits_of,
    margin_crossings,
    measured_curve,
    phase_mark,
)

INVERSE = f"{MINUS}1/N"
SHAPE = 1.2  # approximate aspect ratio of the axes
CRITICAL = marker("+", 9.0, INK, width=1.6)
ANGLES = np.linspace(0.0, 2.0 * np.pi, 361)
NEGATIVE = (1.2, 1.2)  # dashes of negative frequencies, in line widths
ARROW = 7.0  # pt, of the head of an arrow
ALONG = 0.35  # position of the arrow along the visible stretch of the curve, over its length


def nyquist_chart(loop: LoopReport) -> Chart:
    """Return the chart of L near -1 with the unit circle, and circles of the modulus margin and of its limit."""
    value, crossings, limits = loop.curve.value, margin_crossings(loop), limits_of(loop)
    furthest = max([1.0 / item.value for item in loop.classical.gain if item.value > 0.0], default=1.0)
    left, right = -min(max(2.6, 1.15 * furthest), 8.0), 1.4
    curves = [
        faint_line(np.cos(ANGLES), np.sin(ANGLES)),
        line(value.real, value.imag, BLUE),
        line(value.real, -value.imag, BLUE, width=0.8, dashes=NEGATIVE),
    ]
    if not loop.margins.unstable:
        curves.append(_circle(loop.robust.modulus_margin, GREEN, 1.2))
    if limits.modulus is not None:
        curves.append(_circle(limits.modulus, VERMILION, 1.0, REQUIRED))
    measured = measured_curve(loop)
    if measured is not None:
        curves.append(marks(measured.value.real, measured.value.imag, MEASURED))
    for crossing in crossings.gain:
        curves.append(mark(-1.0 / crossing.value, 0.0, gain_mark(is_decisive=crossing is crossings.gain_margin)))
    for crossing in crossings.phase:
        at = -math.cos(crossing.value), -math.sin(crossing.value)
        curves.append(mark(*at, phase_mark(is_decisive=crossing is crossings.phase_margin)))
    return _complex_plane([*curves, *_direction(value, left, right)], left, right)


def balance_chart(loop: LoopReport, element: Nonlinearity) -> Chart:
    """Return the chart of L and -1/N(a); a limit cycle is predicted where they intersect."""
    value = loop.curve.value
    inverse = -1.0 / element.gain[np.abs(element.gain) > 0.0]
    meets = [np.interp(2.0 * math.pi / cycle.period, loop.curve.frequency, value) for cycle in element.cycles]
    furthest = max([1.0, *(-each.real for each in meets), *([-float(np.max(inverse.real))] if inverse.size else [])])
    left = -2.2 * min(furthest, 1e6)
    curves = [
        line(value.real, value.imag, BLUE),
        line(inverse.real, inverse.imag, PURPLE, width=2.2, dashes=COMPLEMENTARY),
    ]
    for cycle, each in zip(element.cycles, meets, strict=True):
        symbol = marker("o", 6.0, INK, fill=INK if cycle.stable else WHITE)
        curves.append(mark(float(each.real), float(each.imag), symbol))
    return _complex_plane(curves, left, -0.45 * left)


def _circle(radius: float, colour: str, width: float, dashes: tuple[float, ...] = ()) -> Curve:
    """Return a circle about the critical point."""
    return line(-1.0 + radius * np.cos(ANGLES), radius * np.sin(ANGLES), colour, width=width, dashes=dashes)


def _complex_plane(curves: Sequence[Curve], left: float, right: float) -> Chart:
    """Return the plane between two real parts, symmetric about the real axis, with the critical point."""
    half = (right - left) / SHAPE / 2.0
    return Chart(
        NO_BOX,
        linear_axis((left, right), 5, label="real"),
        linear_axis((-half, half), 5),
        title="imaginary",
        curves=[*curves, mark(-1.0, 0.0, CRITICAL)],
        rules=[horizontal_line(0.0, INK, 0.5), vertical_line(0.0, INK, 0.5)],
    )


def _direction(value: np.ndarray, left: float, right: float) -> list[Curve]:
    """Return an arrow head along the curve towards higher frequencies, in the middle of its visible stretch."""
    half = (right - left) / SHAPE / 2.0
    visible = np.flatnonzero((value.real > left) & (value.real < right) & (np.abs(value.imag) < half))
    if visible.size < 4:
        return []
    way = np.cumsum(np.abs(np.diff(value[visible], prepend=value[visible[0]])))
    middle = int(visible[np.searchsorted(way, ALONG * way[-1])])
    step = complex(value[min(middle + 1, len(value) - 1)] - value[max(middle - 1, 0)])
    tail = complex(value[middle])
    return [arrow((tail.real, tail.imag), cmath.phase(step), ARROW, BLUE, ARROW / BARB)]


LOW, HIGH = 20.0, 90.0  # dB, least and largest range shown up and down
GAINS = (1.0, 2.0, 5.0, 10.0)  # dB, steps between ticks, times a power of ten
PHASES = (-360.0, -270.0, -180.0, -90.0, 0.0)  # deg


def nichols_chart(loop: LoopReport) -> Chart:
    """Return the chart of gain over phase (-360 to 0 deg), with exclusion zone and contour of the modulus limit."""
    limits, crossings = limits_of(loop), margin_crossings(loop)
    curves = []
    if limits.modulus is not None and limits.modulus < 1.0:
        oval = -1.0 + limits.modulus * np.exp(1j * ANGLES)
        curves.append(line(np.degrees(np.angle(-oval)) - 180.0, in_db(oval), VERMILION, width=1.0, dashes=REQUIRED))
    curves.append(line(*_wrap_phase(loop.curve.value), BLUE))
    measured = measured_curve(loop)
    if measured is not None:
        phase = np.degrees(np.angle(-measured.value)) - 180.0
        curves.append(marks(phase, in_db(measured.value), MEASURED))
    reach = decibel_size(crossings.gain_margin.value) if crossings.gain_margin is not None else 0.0
    height = min(max(LOW, 1.2 * reach), HIGH)
    areas, notes = _zone(limits)
    return Chart(
        NO_BOX,
        ticked_axis((-360.0, 0.0), PHASES, label="phase, deg"),
        linear_axis((-height, height), 6, multiples=GAINS),
        title=f"gain, dB: {_modulus_words(loop)}",
        curves=[*curves, *_margins(crossings), mark(-180.0, 0.0, CRITICAL)],
        areas=areas,
        notes=notes,
    )


def _zone(limits: LimitLines) -> tuple[list[Area], list[ChartNote]]:
    """Return a diamond with corners at the required margins (dB, deg), and their sizes; empty if one is missing."""
    gain, phase = limits.gain, limits.phase
    if gain is None or phase is None:
        return [], []
    x = -180.0 + phase * np.array([-1.0, 0.0, 1.0, 0.0, -1.0])
    y = gain * np.array([0.0, 1.0, 0.0, -1.0, 0.0])
    fill = Area(x, y, (False, False), FORBIDDEN, 1.0, 0.0)
    areas = [fill, hatch(x, y, VERMILION, 1.0), outline(x, y, VERMILION, 1.0)]
    top = ChartNote(
        f"{number(gain)} dB", (-186.0, gain), (False, False), (0.0, 0.0), ("right", "bottom"), VERMILION.lower(), 8.0,
        backing=BEHIND,
    )  # fmt: skip
    side = ChartNote(
        f"{number(phase)}°", (-184.0 - phase, 0.0), (False, False), (0.0, 0.0), ("right", "center"), VERMILION.lower(),
        8.0, backing=BEHIND,
    )  # fmt: skip
    return areas, [top, side]


def _margins(crossings: Classical) -> list[Curve]:
    """Return marks at all crossings, and bars from decisive crossings to the critical point."""
    gain, phase = crossings.gain_margin, crossings.phase_margin
    curves = []
    if gain is not None:
        bar = np.array([0.0, -float(decibels(gain.value))])
        curves.append(line(np.full(2, -180.0), bar, VERMILION, width=MARGIN_WIDTH))
    if phase is not None:
        curves.append(line(np.array([-180.0, _phase_at(phase)]), np.zeros(2), VERMILION, width=MARGIN_WIDTH))
    for crossing in crossings.gain:
        curves.append(mark(-180.0, -float(decibels(crossing.value)), gain_mark(is_decisive=crossing is gain)))
    for crossing in crossings.phase:
        curves.append(mark(_phase_at(crossing), 0.0, phase_mark(is_decisive=crossing is phase)))
    return curves


def _phase_at(crossing: Crossing) -> float:
    """Return the phase of a gain crossover (deg, -360 to 0)."""
    return math.degrees(math.remainder(crossing.value, 2.0 * math.pi)) - 180.0


def _modulus_words(loop: LoopReport) -> str:
    if loop.margins.unstable:
        return "unstable: no margins"
    modulus, limit = loop.robust.modulus_margin, limits_of(loop).modulus
    minimum = f", required {number(limit, 3)}" if limit is not None else ""
    return f"modulus margin {number(modulus, 3)}{minimum}"


def _wrap_phase(value: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return phase (deg, -360 to 0) and gain (dB), with gaps where the phase wraps."""
    phase, gain = np.degrees(np.angle(-value)) - 180.0, in_db(value)
    jumps = np.flatnonzero(np.abs(np.diff(phase)) > 180.0) + 1
    return np.insert(phase, jumps, np.nan), np.insert(gain, jumps, np.nan)
