"""Frequency responses as functions: interpolated between measured lines, or sampled on a grid that resolves them.

A response is a function of angular frequencies (rad/s, shape (n,)). It returns L, the negated transfer function of the
loop: complex, of shape (n,), or (n, m, m) for m channels.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from scipy.interpolate import CubicSpline

from .readings import FrequencyResponse

Response = Callable[[np.ndarray], np.ndarray]

_PER_DECADE = 60
_UNIFORM = 200  # further points, evenly spaced: near the Nyquist frequency a logarithmic grid is coarse in z
_CLOSEST = 1e-10  # least relative distance of neighbours; a pole on the unit circle is not resolved further
_SILENT = 1e-9  # gain below which nothing is resolved: a zero on the unit circle
_HALVINGS = 16  # halvings of the intervals around a crossing
_NEAR = 0.5  # distance (rad, in log gain, or from -1) within which a closest approach is refined
_ROUNDING = 1e-9  # distance below which closest approaches are noise


class CachedResponse:
    """Response that caches the values of another response by frequency (rad/s)."""

    def __init__(self, response: Response) -> None:
        self._response = response
        self._known: dict[float, np.ndarray] = {}

    def __call__(self, frequency: np.ndarray) -> np.ndarray:
        requested = np.asarray(frequency, dtype=float).tolist()
        new = [angular for angular in dict.fromkeys(requested) if angular not in self._known]
        if new:
            self._known.update(zip(new, self._response(np.array(new)), strict=True))
        return np.array([self._known[angular] for angular in requested])


def cache_response(response: Response) -> Response:
    """Return the response with a cache, for several uses of one curve; a cached response is returned unchanged."""
    return response if isinstance(response, CachedResponse) else CachedResponse(response)


def quotient(value: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Return one response divided by another: 1 where both are 0, inf where only the divisor is 0."""
    silent = reference == 0.0
    same = np.where(value == 0.0, 1.0, np.inf)
    return np.where(silent, same, value / np.where(silent, 1.0, reference))


def interpolate(frequency: np.ndarray, value: np.ndarray, sample_period: float) -> Response:
    """Return a response through measured lines: ``value`` at ``frequency`` (rad/s, increasing, below pi/T).

    Log gain is a cubic spline over log tan(w T/2), the logarithm of Tustin's frequency, in which a sampled loop has the
    straight asymptotes of a continuous one, including the zero at z = -1 of a plant with hold. Unwrapped phase is a
    cubic spline over log w, in which a delay is as smooth near the Nyquist frequency as elsewhere. For a double
    integrator with hold, lead and one sample of delay, measured at 10 odd lines per decade, the error is at most 0.02
    dB and 0.02 deg (20 lines: 0.003 dB, 0.001 deg). Alternatives are worse: the error is 3 dB near the Nyquist
    frequency if both splines are over log w, 8 deg if both are over log tan(w T/2), and 0.01 dB and 0.14 deg with
    monotone splines (PCHIP). The phase must turn by less than pi between neighbouring lines, and a resonance needs
    lines within its width. Raises ValueError for lines that cannot be interpolated, and for frequencies outside their
    range.
    """
    frequency, value = np.asarray(frequency, dtype=float), np.asarray(value, dtype=complex)
    if frequency.ndim != 1 or frequency.shape != value.shape or len(frequency) < 4:
        raise ValueError(
            f"at least 4 frequencies and as many values are needed, not arrays of shapes {frequency.shape} and "
            f"{value.shape}"
        )
    if frequency[0] <= 0.0 or not np.all(np.diff(frequency) > 0.0) or frequency[-1] * sample_period >= np.pi:
        raise ValueError("the lines' frequencies must increase and lie between 0 and the Nyquist frequency")
    if not np.all(np.isfinite(value)) or np.any(value == 0.0):
        raise ValueError("the gain at a line is zero or not finite and cannot be interpolated")

    def tustin(angular: np.ndarray) -> np.ndarray:
        return np.log(np.tan(0.5 * sample_period * angular))

    gain = CubicSpline(tustin(frequency), np.log(np.abs(value)))
    phase = CubicSpline(np.log(frequency), np.unwrap(np.angle(value)))
    lowest, highest = frequency[0] * (1.0 - 1e-12), frequency[-1] * (1.0 + 1e-12)

    def response(angular: np.ndarray) -> np.ndarray:
        angular = np.asarray(angular, dtype=float)
        if np.any(angular < lowest) or np.any(angular > highest):
            raise ValueError(
                f"a requested frequency is outside of the measured range, {frequency[0]:g} to {frequency[-1]:g} rad/s"
            )
        return np.exp(gain(tustin(angular)) + 1j * phase(np.log(angular)))

    return response


def base_grid(low: float, high: float, include: Iterable[float] = ()) -> np.ndarray:
    """Return frequencies (rad/s) from ``low`` to ``high``: logarithmic and even grids, and all of ``include``."""
    if not 0.0 < low < high:
        raise ValueError(f"low = {low:g} rad/s and high = {high:g} rad/s are not in the order 0 < low < high")
    logarithmic = np.geomspace(low, high, max(2, round(_PER_DECADE * np.log10(high / low)) + 1))
    grid = np.concatenate([logarithmic, np.linspace(low, high, _UNIFORM), np.asarray([*include], dtype=float)])
    grid = np.unique(grid[(grid >= low) & (grid <= high)])
    return grid[np.concatenate([[True], np.diff(grid) > _CLOSEST * grid[:-1]])]


def dense(
    response: Response,
    low: float,
    high: float,
    *,
    step: float = 0.1,
    include: Iterable[float] = (),
    refine: bool = True,
    most: int = 20000,
) -> FrequencyResponse:
    """Return the response of one channel on a grid from ``low`` to ``high`` (rad/s) that resolves it.

    Between neighbouring points the complex logarithm changes by at most ``step`` (1: a factor e, or one rad), except
    next to a pole or zero on the unit circle. Unless ``refine`` is off, the grid is much finer where L is closest to
    the unit circle, the negative real axis or -1. A resonance narrower than the first grid, about 4 %, can be missed
    unless ``include`` contains its frequency. Raises ValueError if ``most`` points do not resolve the response.
    """
    frequency = base_grid(low, high, include)
    value = _finite(response, frequency)
    while True:
        loud = np.maximum(np.abs(value), _SILENT)
        change = np.hypot(np.diff(np.log(loud)), np.angle(value[1:] * np.conj(value[:-1])))
        audible = np.maximum(loud[1:], loud[:-1]) > _SILENT
        coarse = np.flatnonzero((change > step) & audible & (np.diff(frequency) > _CLOSEST * frequency[:-1]))
        if not coarse.size:
            break
        if len(frequency) + len(coarse) > most:
            raise ValueError(f"the frequency response is not resolved by {most} points up to {high:g} rad/s")
        frequency, value = _halve(response, frequency, value, coarse)
    return _refine(response, frequency, value, most) if refine else FrequencyResponse(frequency, value)


def _finite(response: Response, frequency: np.ndarray) -> np.ndarray:
    value = np.asarray(response(frequency), dtype=complex)
    if not np.all(np.isfinite(value)):
        where = frequency[~np.isfinite(value)][0]
        raise ValueError(f"the frequency response is not finite at {where:g} rad/s")
    return value


def _halve(
    response: Response, frequency: np.ndarray, value: np.ndarray, intervals: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    middle = 0.5 * (frequency[intervals] + frequency[intervals + 1])
    middle_values = _finite(response, middle)
    return np.insert(frequency, intervals + 1, middle), np.insert(value, intervals + 1, middle_values)


def _refine(response: Response, frequency: np.ndarray, value: np.ndarray, most: int) -> FrequencyResponse:
    """Refine the curve around every closest approach, which includes crossings and contacts without a crossing."""
    for _ in range(_HALVINGS):
        gain = np.abs(np.log(np.maximum(np.abs(value), _SILENT)))
        phase = np.abs(np.angle(-value))
        chosen = np.zeros(len(frequency), dtype=bool)
        for distance in (gain, phase, np.abs(1.0 + value)):
            inner = distance[1:-1]
            minimum = (inner <= distance[:-2]) & (inner < distance[2:]) & (inner < _NEAR) & (inner > _ROUNDING)
            chosen[1:-1] |= minimum
        points = np.flatnonzero(chosen)
        intervals = np.unique(np.concatenate([points - 1, points]))
        intervals = intervals[np.diff(frequency)[intervals] > 1e-8 * frequency[intervals]]
        if not intervals.size or len(frequency) + len(intervals) > most:
            break
        frequency, value = _halve(response, frequency, value, intervals)
    return FrequencyResponse(frequency, value)
