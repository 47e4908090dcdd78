"""Ends and ticks of an axis at round numbers, chosen as matplotlib does."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

MARGIN = 0.05  # margin at either end, over the range of the data
STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)  # steps between ticks, times a power of ten
DECADES = 150.0  # ratio of the ends of a logarithmic axis from which only whole decades have labels
MULTIPLES = ((1.0,), (1.0, 2.0, 5.0), tuple(map(float, range(1, 10))))  # multiples of powers of ten with labels
FEWEST = 2  # ticks
FAR = 100.0  # distance from 0, in ranges, from which ticks are counted from a nearby round number
TINY = 1e-15  # relative width up to which a range counts as empty
SMALLEST = 1e21 * np.finfo(float).tiny  # magnitudes that count as 0
ROUNDING = 1e-10  # tolerance of rounding, over a step


def axis_ends(numbers: np.ndarray, margin: float = MARGIN) -> tuple[float, float]:
    """Return the ends of an axis for these numbers, extended by ``margin`` (a fraction of their range).

    Non-finite numbers are ignored.
    """
    finite = numbers[np.isfinite(numbers)]
    low, high = _widen(float(finite.min()), float(finite.max())) if finite.size else (-MARGIN, MARGIN)
    beyond = (high - low) * margin
    return low - beyond, high + beyond


def _widen(low: float, high: float) -> tuple[float, float]:
    """Return a range of nonzero width around a range of zero width."""
    size = max(abs(low), abs(high))
    if size < SMALLEST:
        return -MARGIN, MARGIN
    if high - low <= size * TINY:
        return low - MARGIN * abs(low), high + MARGIN * abs(high)
    return low, high


def axis_ticks(
    low: float, high: float, intervals: int, *, integer: bool = False, multiples: Sequence[float] = STEPS
) -> list[float]:
    """Return the ticks between two ends: at most ``intervals`` intervals, at integers if ``integer``.

    Steps are ``multiples`` (1 to 10) of a power of ten; if fewer than two ticks fit between the ends, steps are
    smaller.
    """
    width, centre = high - low, (high + low) / 2.0
    offset = 0.0
    if abs(centre) / width >= FAR:
        offset = math.copysign(10.0 ** (math.log10(abs(centre)) // 1), centre)
    low, high = low - offset, high - offset
    stairs = [*(0.1 * each for each in multiples[:-1]), *multiples, 10.0 * multiples[1]]
    steps = np.array(stairs) * 10.0 ** (math.log10(width / intervals) // 1)
    if integer:
        steps = steps[(steps < 1.0) | (np.abs(steps - np.round(steps)) < 0.001)]
    first = int(np.flatnonzero(steps >= (high - low) / intervals)[0])
    ticks = np.empty(0)
    for step in steps[first::-1]:
        if integer and math.floor(high) - math.ceil(low) >= FEWEST - 1:
            step = max(1.0, step)
        origin = (low // step) * step
        ticks = np.arange(_floor(low - origin, step, offset), _ceil(high - origin, step, offset) + 1) * step + origin
        if np.count_nonzero((ticks >= low) & (ticks <= high)) >= FEWEST:
            break
    edge = 1e-9 * width  # tolerance of a tick at an end
    return [float(tick + offset) for tick in ticks if low - edge <= tick <= high + edge]


def decade_ticks(low: float, high: float, limit: int, multiples: tuple[float, ...] = (1.0,)) -> list[float]:
    """Return at most ``limit`` powers of ten between two ends, a constant number of decades apart.

    If every decade has a tick, ``multiples`` of it are ticks as well.
    """
    lowest, highest = math.log10(low), math.log10(high)
    first, last = math.ceil(lowest), math.floor(highest)
    decades = last - first + 1
    step = decades // (limit + 1) + 1
    count = min(limit, math.ceil(decades / step))
    if count == 1:
        first = round((lowest + highest) / 2.0)
        step = max(first - math.ceil(lowest), last - first) + 1
    elif count > 1:
        step = (decades - 1) // (count - 1)
        if step * count < decades:
            step = decades // count
        fewest, beyond = max(decades - step * count, 0), min(decades - step * (count - 1), step)
        offset = -first % step
        first += offset if fewest <= offset < beyond else fewest
    begin = first - 1 if step == 1 else first
    factors = multiples if step == 1 or decades <= 1 else (1.0,)
    powers = range(begin, last + 1, step)
    return [tick for power in powers for factor in factors if low <= (tick := factor * 10.0**power) <= high]


def power_ticks(low: float, high: float, multiples: Sequence[float]) -> list[float]:
    """Return ``multiples`` of powers of ten between two positive ends, ascending."""
    powers = [10.0**exponent for exponent in range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1)]
    ticks = [multiple * power for power in powers for multiple in multiples]
    return [tick for tick in ticks if low * (1.0 - ROUNDING) <= tick <= high * (1.0 + ROUNDING)]


def text_ticks(low: float, high: float, limit: int) -> list[float]:
    """Return the ticks of a logarithmic axis that have labels: decades, and multiples of them if these are few."""
    if high >= DECADES * low:
        return decade_ticks(low, high, limit)
    for multiples in MULTIPLES[1:]:
        if len(ticks := power_ticks(low, high, multiples)) >= FEWEST:
            return ticks
    return axis_ticks(low, high, FEWEST + 1)


def _floor(number: float, step: float, offset: float) -> float:
    """Return the number of whole steps in a number, tolerant of rounding errors."""
    quotient, remainder = divmod(number, step)
    return quotient + 1 if _is_close(remainder / step, 1.0, step, offset) else quotient


def _ceil(number: float, step: float, offset: float) -> float:
    quotient, remainder = divmod(number, step)
    return quotient if _is_close(remainder / step, 0.0, step, offset) else quotient + 1


def _is_close(ratio: float, edge: float, step: float, offset: float) -> bool:
    tolerance = ROUNDING
    if offset:
        tolerance = min(0.4999, max(ROUNDING, 10.0 ** (math.log10(abs(offset) / step) - 12.0)))
    return abs(ratio - edge) < tolerance
