"""Margins and curves of a loop's frequency response: gains as factors, angles in rad, times in s, frequency in rad/s.

Limits and pages state margins in dB and deg, computed by the functions at the end.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import overload

import numpy as np


@dataclass(frozen=True)
class Crossing:
    """Gain or phase margin where the loop's frequency response crosses the critical ray or the unit circle.

    ``value`` makes the loop marginal: it is a factor on the gain (above 1: a margin upwards, below 1: downwards), or a
    phase lag (rad; negative: a lead). ``frequency`` is in rad/s.
    """

    value: float
    frequency: float


@dataclass(frozen=True)
class Classical:
    """All crossings of one loop; empty tuples for infinite margins. Encirclements of -1 are counter-clockwise."""

    gain: tuple[Crossing, ...]
    phase: tuple[Crossing, ...]
    delay_margin: float  # s; inf: none
    delay_frequency: float  # rad/s, at which the delay margin is reached; nan: none
    encirclements: int | None  # None: not counted, since nothing is known about poles

    @property
    def gain_margin(self) -> Crossing | None:
        """Gain crossing nearest to a factor of 1 in dB, up or down; None if there is none."""
        return min(self.gain, key=lambda crossing: abs(np.log(crossing.value)), default=None)

    @property
    def phase_margin(self) -> Crossing | None:
        """Phase crossing nearest to 0, lag or lead; None if there is none."""
        return min(self.phase, key=lambda crossing: abs(crossing.value), default=None)


@dataclass(frozen=True)
class Robust:
    """Distances from -1: peaks of |S| and |T| with their frequencies (rad/s); disk margin alpha with skew 0."""

    modulus_margin: float
    sensitivity_peak: float
    sensitivity_frequency: float
    complementary_peak: float
    complementary_frequency: float
    disk_margin: float
    disk_gain: float  # factor that the disk margin guarantees upwards, 1/factor downwards
    disk_phase: float  # rad
    disk_frequency: float


@dataclass(frozen=True)
class FrequencyResponse:
    """Frequency response: angular frequencies (rad/s), and L, the negated transfer function of the loop."""

    frequency: np.ndarray
    value: np.ndarray


@overload
def decibels(factor: complex) -> float: ...
@overload
def decibels(factor: np.ndarray) -> np.ndarray: ...
def decibels(factor: complex | np.ndarray) -> float | np.ndarray:
    """Return the magnitude of a real or complex gain in dB; minus infinity for 0."""
    with np.errstate(divide="ignore"):
        level = 20.0 * np.log10(np.abs(factor))
    return level if isinstance(factor, np.ndarray) else float(level)


def decibel_size(factor: float) -> float:
    """Return the distance of a factor on the gain from 1, up or down, in dB."""
    return abs(decibels(factor))


def factor_of(decibel: float) -> float:
    """Return the factor of ``decibel`` dB."""
    return float(10.0 ** (decibel / 20.0))


def degree_size(angle: float) -> float:
    """Return the magnitude of an angle (rad), lag or lead, in deg."""
    return float(np.degrees(abs(angle)))
