"""Margins between measured lines: the response is measured at the crossings until they no longer move."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .readings import Classical, Crossing, FrequencyResponse, Robust, decibels

ROUNDS = 4
GAIN_STAYS = 0.01  # dB, change of a settled gain margin
PHASE_STAYS = 0.02  # deg, change of a settled phase margin
CROSSINGS = 12  # number of nearest crossings of each kind that are measured
SAME = 3e-4  # relative distance up to which frequencies count as equal
ENDS = 1e-3  # relative distance of a frequency from the ends of the lines


@dataclass(frozen=True)
class Refined:
    """Curve with lines at its crossings, after a number of ``rounds``.

    ``gain`` (dB) and ``phase`` (deg) are the changes of its margins in the last round.
    """

    curve: FrequencyResponse
    rounds: int
    gain: float
    phase: float

    @property
    def settled(self) -> bool:
        """True if the margins no longer change."""
        return self.gain < GAIN_STAYS and self.phase < PHASE_STAYS

    @property
    def remainder(self) -> str:
        """Remaining change as text, "" if the margins are settled."""
        if self.settled:
            return ""
        if not (np.isfinite(self.gain) and np.isfinite(self.phase)):
            return f"crossings still appear and vanish after {self.rounds} rounds of test frequencies at the crossings"
        shift = f"{self.gain:.2g} dB and {self.phase:.2g} deg"
        return f"they still move by {shift} after {self.rounds} rounds of test frequencies at the crossings"


def refine(
    curve: FrequencyResponse,
    margins_of: Callable[[FrequencyResponse], tuple[Classical, Robust]],
    measure: Callable[[float], tuple[float, complex]],
) -> Refined:
    """Return the curve with further lines where its margins are determined: at crossings and nearest to -1.

    ``measure`` takes a frequency (rad/s), and returns the frequency of a nearby line and L on this line; its errors are
    raised.
    """
    classical, robust = margins_of(curve)
    gain = phase = np.inf
    rounds = 0
    while rounds < ROUNDS and not (gain < GAIN_STAYS and phase < PHASE_STAYS):
        requested = [frequency for frequency in _decisive(classical, robust) if _is_new(curve, frequency)]
        if not requested:
            return Refined(curve, rounds, 0.0, 0.0)
        for frequency in requested:
            if _is_new(curve, frequency):  # with regard to the lines of this round, too
                curve = _with_line(curve, *measure(frequency))
        before = classical
        classical, robust = margins_of(curve)
        gain, phase = _shift(before, classical)
        rounds += 1
    return Refined(curve, rounds, gain, phase)


def _decisive(classical: Classical, robust: Robust) -> list[float]:
    """Return frequencies (rad/s) of the nearest crossings, and of the points nearest to -1."""
    gains = sorted(classical.gain, key=lambda crossing: abs(np.log(crossing.value)))[:CROSSINGS]
    phases = sorted(classical.phase, key=lambda crossing: abs(crossing.value))[:CROSSINGS]
    crossings = [crossing.frequency for crossing in (*gains, *phases)]
    return [*crossings, robust.sensitivity_frequency, robust.disk_frequency]


def _is_new(curve: FrequencyResponse, frequency: float) -> bool:
    """Return True if a frequency is between the lines, and close to none of them."""
    low, high = curve.frequency[0] * (1.0 + ENDS), curve.frequency[-1] * (1.0 - ENDS)
    return bool(low < frequency < high and np.min(abs(curve.frequency / frequency - 1.0)) > SAME)


def _with_line(curve: FrequencyResponse, frequency: float, response: complex) -> FrequencyResponse:
    index = int(np.searchsorted(curve.frequency, frequency))
    return FrequencyResponse(np.insert(curve.frequency, index, frequency), np.insert(curve.value, index, response))


def _shift(before: Classical, after: Classical) -> tuple[float, float]:
    """Return the largest change of the crossings (dB, deg); inf if one has appeared or vanished."""
    gain = _largest(before.gain, after.gain, lambda old, new: abs(decibels(old.value) - decibels(new.value)))
    phase = _largest(before.phase, after.phase, lambda old, new: abs(np.degrees(old.value - new.value)))
    return gain, phase


def _largest(
    before: tuple[Crossing, ...], after: tuple[Crossing, ...], distance: Callable[[Crossing, Crossing], float]
) -> float:
    if len(before) != len(after):
        return np.inf
    return max((float(distance(old, new)) for old, new in zip(before, after, strict=True)), default=0.0)
