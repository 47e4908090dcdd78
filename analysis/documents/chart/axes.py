"""Axes of charts: ends, ticks and their labels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..common.quantities import log_tick, tick
from ..interactive.charts import Axis
from ..interactive.measures import LABEL_SIZE, TICK_SIZE
from .ticks import MULTIPLES, STEPS, axis_ticks, decade_ticks, power_ticks, text_ticks


def linear_axis(
    ends: tuple[float, float],
    intervals: int,
    *,
    label: str = "",
    integer: bool = False,
    multiples: Sequence[float] = STEPS,
) -> Axis:
    """Return a linear axis with at most ``intervals`` intervals between ticks, which are integers if ``integer``.

    The intervals are ``multiples`` of a power of ten.
    """
    ticks = axis_ticks(*ends, intervals, integer=integer, multiples=multiples)
    return _axis(ends, [(at, tick(at)) for at in ticks], label, named=False)


def ticked_axis(ends: tuple[float, float], ticks: Sequence[float], *, label: str = "") -> Axis:
    """Return a linear axis with these ticks."""
    return _axis(ends, [(at, tick(at)) for at in ticks], label, named=False)


def logarithmic_axis(
    ends: tuple[float, float], limit: int, *, label: str = "", multiples: tuple[float, ...] = (1.0,)
) -> Axis:
    """Return a logarithmic axis with at most ``limit`` labelled decades.

    If every decade is labelled, ``multiples`` of each are ticks, too.
    """
    low, high = min(ends), max(ends)
    ticks = [(at, log_tick(at)) for at in decade_ticks(low, high, limit, multiples)]
    return replace(_axis(ends, ticks, label, named=False), logarithmic=True)


def fine_axis(ends: tuple[float, float], limit: int = 6, *, label: str = "") -> Axis:
    """Return a logarithmic axis with ticks at k 10^n, k = 1 to 9, few of them labelled.

    Beyond ``limit`` decades only whole decades have ticks.
    """
    texts = {at: log_tick(at) for at in text_ticks(*ends, limit)}
    decades = power_ticks(*ends, MULTIPLES[0])
    ticks = sorted({*(decades if len(decades) > limit else power_ticks(*ends, MULTIPLES[-1])), *texts})
    return replace(_axis(ends, [(at, texts.get(at, "")) for at in ticks], label, named=False), logarithmic=True)


def named_axis(ends: tuple[float, float], ticks: Sequence[tuple[float, str]], *, label: str = "") -> Axis:
    """Return an axis with names as tick labels."""
    return _axis(ends, list(ticks), label, named=True)


def lane_axis(labels: Sequence[str], ends: tuple[float, float] | None = None, *, size: float = LABEL_SIZE) -> Axis:
    """Return the ordinate of lanes, horizontal strips at 0, 1, ... from the top, without tick marks or grid lines."""
    low, high = ends or (len(labels) - 0.4, -0.6)
    ticks = [(float(index), label) for index, label in enumerate(labels)]
    return replace(named_axis((low, high), ticks), size=size, grid=False, marked=False)


def bare_axis(axis: Axis) -> Axis:
    """Return an axis without tick labels."""
    return replace(axis, ticks=[(at, "") for at, _ in axis.ticks], label="", named=False, bare=True)


def _axis(ends: tuple[float, float], ticks: list[tuple[float, str]], label: str, *, named: bool) -> Axis:
    return Axis(label=label, ends=ends, ticks=ticks, named=named, size=TICK_SIZE, grid=True, marked=True)
