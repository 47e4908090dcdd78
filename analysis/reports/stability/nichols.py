"""The Nichols diagram: gain over phase, with margins, limits and the exclusion zone that the limits make."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator

from ...stability.loops.readings import Crossing, decibel_size, decibels
from ...stability.results.report import LoopReport
from ..common.quantities import number, tick
from ..common.style import BLUE, VERMILION
from .frequency import (
    DECISIVE,
    GAIN_MARK,
    MARGIN,
    MEASURED,
    OTHER,
    PHASE_MARK,
    has_measurement,
    in_db,
    margin_crossings,
)
from .limits import BEHIND, FORBIDDEN, LIMIT, limits_of
from .nyquist import ANGLES, CRITICAL

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
        axes.plot(-180.0, -decibels(crossing.value), **{**GAIN_MARK, **(DECISIVE if crossing is gain else OTHER)})
    for crossing in crossings.phase:
        axes.plot(_phase_at(crossing), 0.0, **{**PHASE_MARK, **(DECISIVE if crossing is phase else OTHER)})
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
