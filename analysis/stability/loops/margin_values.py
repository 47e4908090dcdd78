"""Comparable sizes of the margins of one loop: unstable is worse than any number, unlimited is better.

Sizes are in the units of limits and pages: gain in dB up or down, phase in deg of lag or lead, delay in s. Every margin
of an unstable loop has the size `UNSTABLE`, and a margin without a crossing has the size `UNLIMITED`. Both are floats
that can be compared, sorted, and used in minima and order statistics.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from ...campaigns.verdicts.order_statistics import quantile_rank
from .readings import Classical, Robust, decibel_size, degree_size

UNSTABLE = -math.inf
UNLIMITED = math.inf


class MarginQuantity(StrEnum):
    STABILITY = "stability"
    GAIN = "gain margin"
    PHASE = "phase margin"
    MODULUS = "modulus margin"
    DISK = "disk margin"
    DELAY = "delay margin"
    DISK_GAIN = "disk gain margin"
    DISK_PHASE = "disk phase margin"

    @property
    def unit(self) -> str:
        """Unit of the quantity's sizes: dB, deg, s or 1."""
        return {"gain": "dB", "phase": "deg", "delay": "s"}.get(self.split()[-2] if " " in self else "", "1")


# Quantities in the line of each loop.
MARGINS = (MarginQuantity.GAIN, MarginQuantity.PHASE, MarginQuantity.MODULUS, MarginQuantity.DISK)


@dataclass(frozen=True)
class LoopMargins:
    """Nearest margins of one loop.

    ``gain`` (factor, above 1: upwards), ``phase`` (rad, positive: lag) and ``delay`` (s) are inf without a crossing.
    ``stable`` is None if unknown. ``largest`` is the largest multiplier of the loop's closed-loop modes, None if no
    poles are known.
    """

    gain: float
    phase: float
    modulus: float
    disk: float
    delay: float
    stable: bool | None
    largest: float | None = None

    @classmethod
    def of(cls, classical: Classical, robust: Robust, stable: bool | None, largest: float | None) -> LoopMargins:
        """Return the margins of the nearest crossings, and the distances from -1."""
        gain, phase = classical.gain_margin, classical.phase_margin
        return cls(
            gain=gain.value if gain else math.inf,
            phase=phase.value if phase else math.inf,
            modulus=robust.modulus_margin,
            disk=robust.disk_margin,
            delay=classical.delay_margin,
            stable=stable,
            largest=largest,
        )

    @property
    def unstable(self) -> bool:
        """True if the loop is known to be unstable and therefore has no margins."""
        return self.stable is False

    def size(self, quantity: MarginQuantity) -> float:
        """Return the size of a margin in its unit, or `UNSTABLE` or `UNLIMITED`."""
        if self.unstable:
            return UNSTABLE
        if quantity is MarginQuantity.GAIN:
            return decibel_size(self.gain) if math.isfinite(self.gain) else UNLIMITED
        if quantity is MarginQuantity.PHASE:
            return degree_size(self.phase) if math.isfinite(self.phase) else UNLIMITED
        return {MarginQuantity.MODULUS: self.modulus, MarginQuantity.DISK: self.disk, MarginQuantity.DELAY: self.delay}[
            quantity
        ]


def order_statistic(sizes: Sequence[float], level: float) -> float:
    """Return the size at the quantile ``level`` (0: the least), without interpolation; `UNSTABLE` is the lowest."""
    return sorted(sizes)[quantile_rank(level, len(sizes))]
