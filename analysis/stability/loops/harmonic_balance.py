"""Limit cycles by harmonic balance: the amplitudes and frequencies at which 1 + N(a) L(jw) = 0.

L is the linear remainder of the loop (the negated transfer function without the element), for a sampled loop
L(e^{jwT}). The method is valid if L attenuates the harmonics of the element's output, and if the period of a sampled
loop's oscillation is many samples.

Stability has two conditions. First, the pair of poles on the axis must move left when the amplitude grows (Loeb 1956;
Gelb and Vander Velde 1968, chapter 3): with 1 + N(a) L(s) = 0 along a and s, ds/da = -(N'/N)/(L'(s)/L). Second, no
other pole of the loop with the gain N(a) may be unstable. Loeb's local rule does not detect such poles; they are
counted from the gains at which a pair crosses the axis, assuming that the loop is stable for some gain.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq, least_squares, minimize_scalar

from .describing_function import ELEMENTS, Parameters, complete_parameters

Response = Callable[[np.ndarray], np.ndarray]


class Balance(NamedTuple):
    """Solution: amplitude at the element's input (in its unit), angular frequency (rad/s), and stability."""

    amplitude: float
    frequency: float
    stable: bool


class _Loop:
    """N and L as functions of one variable, and L on a grid of frequencies."""

    def __init__(self, response: Response, frequency: np.ndarray, kind: str, parameters: dict[str, float]) -> None:
        self.response, self.frequency = response, frequency
        self.element, self.parameters = ELEMENTS[kind], parameters
        self.curve = np.asarray(response(frequency), dtype=complex)
        if self.curve.shape != frequency.shape or not np.all(np.isfinite(self.curve)):
            raise ValueError("the frequency response is not one finite complex number per frequency")

    def linear(self, frequency: float) -> complex:
        return complex(self.response(np.array([frequency]))[0])

    def gains(self, amplitude: np.ndarray) -> np.ndarray:
        return self.element.gain(amplitude, self.parameters)

    def gain(self, amplitude: float) -> complex:
        return complex(self.gains(np.array([amplitude]))[0])

    def critical(self, turn: complex) -> list[tuple[float, complex]]:
        """Return the frequencies at which turn * L is real and negative, and the values of turn * L there."""
        imaginary = (turn * self.curve).imag
        points = []
        for i in np.flatnonzero((imaginary[1:] < 0.0) != (imaginary[:-1] < 0.0)):
            lower, upper = self.frequency[i], self.frequency[i + 1]
            frequency = brentq(lambda w: (turn * self.linear(w)).imag, lower, upper, xtol=1e-14 * upper, rtol=1e-14)
            value = turn * self.linear(frequency)
            # a change of sign through a pole on the axis is not a crossing
            if value.real < 0.0 and abs(value.imag) < 1e-6 * abs(value):
                points.append((frequency, value))
        return points

    def slope(self, frequency: float) -> complex:
        """Return d ln L / dw."""
        h = 1e-5 * frequency
        upper = min(frequency + h, float(self.frequency[-1]))
        lower = max(frequency - h, float(self.frequency[0]))
        return complex(np.log(self.linear(upper) / self.linear(lower))) / (upper - lower)

    def amplitudes(self, least: float, largest: float) -> np.ndarray:
        """Return ascending amplitudes for abs(L) from ``least`` to ``largest``: kinks, with a dense grid above each."""
        kinks = self.element.kinks(self.parameters)
        output = self.element.output(self.parameters)
        last = self.element.farthest(self.parameters)
        if not math.isinf(output):
            last = 1.01 * 4.0 / math.pi * output * largest  # beyond, abs(N L) < 1
        first = float(kinks[0]) if len(kinks) else 0.99 * 4.0 / math.pi * output * least
        if last <= first:
            return np.zeros(0)
        edges = np.append(np.unique(np.append(first, kinks[kinks < last])), last)
        points = max(40, 400 // len(edges))
        pieces = [
            np.append(low, low + (high - low) * np.geomspace(1e-9, 1.0, points)[:-1])
            if high < 2.0 * low
            else np.append(low, low * (1.0 + np.geomspace(1e-9, high / low - 1.0, points)[:-1]))
            for low, high in pairwise(edges)
        ]
        return np.append(np.concatenate(pieces), last)

    def stable(self, amplitude: float, frequency: float) -> bool:
        gain = self.gain(amplitude)
        if gain == 0.0:
            return False  # exactly at the threshold of the element there is no restoring effect
        h = 1e-6 * amplitude
        growth = (self.gain(amplitude + h) - self.gain(amplitude - h)) / (2.0 * h) / gain
        if not (growth / self.slope(frequency)).imag < 0.0:  # Re ds/da
            return False
        # As a factor on N L grows from 0, the number of unstable pairs rises by one at each crossing of the axis with
        # falling phase, and falls by one with rising phase. The pair of the limit cycle itself crosses at factor 1.
        crossings = [(1.0 / abs(value), w) for w, value in self.critical(gain) if abs(w / frequency - 1.0) > 1e-6]
        crossings = sorted([*crossings, (1.0, frequency)])
        unstable = np.cumsum([0] + [1 if self.slope(w).imag < 0.0 else -1 for _, w in crossings])
        own = crossings.index((1.0, frequency))
        return bool(min(unstable[own], unstable[own + 1]) == unstable.min())


def _real_balances(loop: _Loop) -> list[tuple[float, float]]:
    """Solve for real N: frequencies from the phase of L alone, then amplitudes from the magnitude of N."""
    balances = []
    for frequency, value in loop.critical(1.0 + 0j):
        target = 1.0 / abs(value)

        def excess(a: float, target: float = target) -> float:
            return loop.gain(a).real - target

        grid = loop.amplitudes(abs(value), abs(value))
        if not len(grid):
            continue
        gains = loop.gains(grid).real
        # Between two kinks N rises and falls; its maximum is found first, so that no pair of roots near it is missed.
        rising = np.diff(gains) > 0.0
        tops = [
            float(
                minimize_scalar(
                    lambda a, s=s: -s * loop.gain(a).real, bounds=(grid[i], grid[i + 2]), method="bounded"
                ).x
            )
            for s, turns in ((1.0, rising[:-1] & ~rising[1:]), (-1.0, ~rising[:-1] & rising[1:]))
            for i in np.flatnonzero(turns)
            if s * (gains[i + 1] - target) < 0.0
        ]
        grid = np.unique(np.append(grid, tops))
        below = loop.gains(grid).real < target
        for i in np.flatnonzero(below[1:] != below[:-1]):
            balances.append((float(brentq(excess, grid[i], grid[i + 1], rtol=1e-13)), frequency))
    return balances


def _crossing_segments(first: np.ndarray, second: np.ndarray) -> list[tuple[int, int]]:
    """Return indices of intersecting segments of two complex polylines; angle jumps of over pi are not segments."""
    p, r = first[:-1], np.diff(first)
    q, s = second[:-1], np.diff(second)
    segments = []
    for i in np.flatnonzero(abs(r.imag) < math.pi):
        across = (np.conj(r[i]) * s).imag
        gap = q - p[i]
        with np.errstate(divide="ignore", invalid="ignore"):
            along_first = (np.conj(gap) * s).imag / across
            along_second = (np.conj(gap) * r[i]).imag / across
        inside = (along_first >= 0.0) & (along_first < 1.0) & (along_second >= 0.0) & (along_second < 1.0)
        segments += [(int(i), int(j)) for j in np.flatnonzero(inside & (abs(s.imag) < math.pi))]
    return segments


def _complex_balances(loop: _Loop) -> list[tuple[float, float]]:
    """Solve for complex N: intersections of ln N(a) and ln(-1/L(w)) in the plane, then both refined together."""
    sizes = abs(loop.curve)
    grid = loop.amplitudes(float(sizes.min()), float(sizes.max()))
    if not len(grid):
        return []
    w = loop.frequency

    def mismatch(unknown: np.ndarray) -> np.ndarray:
        value = np.log(-loop.gain(math.exp(unknown[0])) * loop.linear(math.exp(unknown[1])))
        return np.array([value.real, value.imag])

    balances: list[tuple[float, float]] = []
    for i, j in _crossing_segments(np.log(loop.gains(grid)), np.log(-1.0 / loop.curve)):
        lower = np.log([grid[max(i - 1, 0)], w[max(j - 1, 0)]])
        upper = np.log([grid[min(i + 2, len(grid) - 1)], w[min(j + 2, len(w) - 1)]])
        start = np.log([math.sqrt(grid[i] * grid[i + 1]), math.sqrt(w[j] * w[j + 1])])
        solution = least_squares(
            mismatch, start, bounds=(lower, upper), jac="3-point", xtol=1e-14, ftol=1e-14, gtol=1e-14
        )
        if np.max(abs(solution.fun)) > 1e-7:
            continue  # the chord of a jump crossed, not the curve
        amplitude, frequency = (float(value) for value in np.exp(solution.x))
        if not any(
            math.isclose(amplitude, a, rel_tol=1e-6) and math.isclose(frequency, f, rel_tol=1e-6) for a, f in balances
        ):
            balances.append((amplitude, frequency))
    return balances


def predict(
    response: Response, low: float, high: float, element: str, parameters: Parameters, points: int = 4000
) -> list[Balance]:
    """Return all solutions of 1 + N(a) L = 0 with low < w < high (rad/s), by amplitude; [] if there are none.

    ``response`` returns L for angular frequencies, ``element`` is a kind in ``ELEMENTS``. The grid has ``points``
    logarithmically spaced frequencies; if two crossings are between neighbouring frequencies, both are missed. ``high``
    itself is excluded, since at the Nyquist frequency a sample has only one phase of the sine and N has no meaning.
    Raises ValueError for wrong parameters or frequencies.
    """
    complete = complete_parameters(element, parameters)
    if not (0.0 < low < high and math.isfinite(high)):
        raise ValueError(f"frequencies from {low!r} to {high!r} rad/s are not an interval above 0")
    loop = _Loop(response, np.geomspace(low, high * (1.0 - 1e-5), points), element, complete)
    kinks = loop.element.kinks(complete)
    is_real = loop.gain(2.0 * float(kinks[-1]) if len(kinks) else 1.0).imag == 0.0
    pairs = _real_balances(loop) if is_real else _complex_balances(loop)
    return [Balance(amplitude, w, loop.stable(amplitude, w)) for amplitude, w in sorted(pairs)]
