"""Axis of a chart: its limits, and the labels that matplotlib wrote at its ticks."""

from __future__ import annotations

import math
import re
from typing import Any

from matplotlib.axis import Axis as FigureAxis
from matplotlib.axis import XAxis
from matplotlib.ticker import FixedLocator

from perilune.analysis.documents.interactive.charts import Axis
from tests.support.figures.unstated import UnstatedError

PLAIN = str.maketrans("\N{MINUS SIGN}⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789")
POWER = re.compile(r"(?:(\d+)·)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)")
NUMBER = re.compile(r"-?\d+(\.\d*)?(e-?\d+)?")
SAME = 1e-5  # relative to the axis: a text has ten digits of its tick, as a power of ten one
EDGE = 1e-9  # of the axis, by which a tick at its end may lie beyond


def read_axis(axis: FigureAxis, ends: tuple[float, float], label: str) -> Axis:
    """Read a drawn axis. Raises UnstatedError for ticks that could not be numbered again at another zoom."""
    scale = axis.get_scale()
    low, high = sorted(map(float, ends))
    if scale not in ("linear", "log"):
        raise UnstatedError(f"{scale} scale")
    if isinstance(axis, XAxis) and ends[0] > ends[1]:
        raise UnstatedError("abscissa from right to left")
    low, high = (
        (low / (1.0 + EDGE), high * (1.0 + EDGE))
        if scale == "log"
        else (low - EDGE * (high - low), high + EDGE * (high - low))
    )
    formatter = axis.get_major_formatter()
    locations = [float(each) for each in axis.get_majorticklocs()]
    texts = formatter.format_ticks(locations)
    ticks = [(at, text) for at, text in zip(locations, texts, strict=True) if low <= at <= high]
    named = not all(_reads(text, at, low, high) for at, text in ticks if text)
    if formatter.get_offset() or (named and not isinstance(axis.get_major_locator(), FixedLocator)):
        raise UnstatedError("texts of ticks that are no numbers")
    if any(low <= at <= high for at in axis.get_minorticklocs()):
        raise UnstatedError("minor ticks")
    marks = axis.get_major_ticks()
    bare = not any(tick.label1.get_visible() for tick in marks)
    if any(tick.label2.get_visible() or tick.tick2line.get_visible() for tick in marks) or _is_turned(marks):
        raise UnstatedError("ticks on both sides, or turned")
    return Axis(
        label=label,
        ends=(float(ends[0]), float(ends[1])),
        logarithmic=scale == "log",
        ticks=[(at, "" if bare else text) for at, text in ticks],
        named=named,
        bare=bare,
        size=float(marks[0].label1.get_fontsize()) if marks else 0.0,
        grid=any(tick.gridline.get_visible() for tick in marks),
        marked=any(tick.tick1line.get_visible() and tick.tick1line.get_markersize() > 0.0 for tick in marks),
    )


def _is_turned(ticks: list[Any]) -> bool:
    return any(tick.label1.get_rotation() != 0.0 for tick in ticks)


def _reads(text: str, at: float, low: float, high: float) -> bool:
    """Return True if a text is the number at its position."""
    power = POWER.fullmatch(text)
    plain = f"{power[1] or 1}e{power[2].translate(PLAIN)}" if power else text.translate(PLAIN)
    return bool(NUMBER.fullmatch(plain)) and math.isclose(float(plain), at, rel_tol=SAME, abs_tol=SAME * (high - low))
