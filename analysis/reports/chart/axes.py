"""Axes of charts: ends, ticks and their texts."""

from __future__ import annotations

from collections.abc import Sequence

from ..common.quantities import tick
from ..interactive.charts import Axis
from ..interactive.measures import TICK_SIZE
from .ticks import axis_ticks


def linear_axis(ends: tuple[float, float], intervals: int, *, label: str = "", integer: bool = False) -> Axis:
    """Return a linear axis with at most ``intervals`` intervals between ticks, at integers if ``integer``."""
    return _axis(ends, [(at, tick(at)) for at in axis_ticks(*ends, intervals, integer=integer)], label, named=False)


def named_axis(ends: tuple[float, float], ticks: Sequence[tuple[float, str]], *, label: str = "") -> Axis:
    """Return an axis whose ticks have names."""
    return _axis(ends, list(ticks), label, named=True)


def _axis(ends: tuple[float, float], ticks: list[tuple[float, str]], label: str, *, named: bool) -> Axis:
    return Axis(label=label, ends=ends, ticks=ticks, named=named, size=TICK_SIZE, grid=True, marked=True)
