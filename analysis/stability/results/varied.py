"""Margins while something varies: the communication step, the trials of a campaign, a parameter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..loops.margin_values import LoopMargins, MarginQuantity, order_statistic
from .requirement import MarginRequirement

LEVELS = {"least": 0.0, "5 %": 0.05, "50 %": 0.5}  # of dispersed margins


@dataclass(frozen=True)
class StepMargins:
    """The margins with another communication step (s); None where there are none, and ``note`` says why."""

    step: float
    margins: LoopMargins | None
    note: str = ""


@dataclass(frozen=True)
class Dispersion:
    """Margins over the trials of a campaign.

    ``worst`` is the trial with the least disk margin, of unstable ones that with the largest multiplier, and ``replay``
    the command that studies it again. ``poles`` are all trials' closed-loop multipliers, side by side.
    """

    campaign: str
    margins: tuple[LoopMargins, ...]
    poles: np.ndarray
    worst: int
    replay: str
    requirements: tuple[MarginRequirement, ...]

    @property
    def trials(self) -> int:
        return len(self.margins)

    @property
    def unstable(self) -> int:
        return sum(item.unstable for item in self.margins)

    def sizes(self, quantity: MarginQuantity) -> np.ndarray:
        """Return a margin's size in every trial, `UNSTABLE` and `UNLIMITED` among them."""
        return np.array([item.size(quantity) for item in self.margins])

    def levels(self, quantity: MarginQuantity) -> dict[str, float]:
        """Return least, 5 % and median over all trials: order statistics, so each is the margin of a trial."""
        sizes = [item.size(quantity) for item in self.margins]
        return {name: order_statistic(sizes, level) for name, level in LEVELS.items()}


@dataclass(frozen=True)
class SweepCrossing:
    """The value of the parameter at which a margin reaches its limit or, of stability, the loop becomes unstable.

    ``below``: the side that fails.
    """

    quantity: MarginQuantity
    value: float
    below: bool


@dataclass(frozen=True)
class SweepReport:
    """Margins over one parameter, and the values at which each limit is crossed, ascending."""

    name: str
    loop: str
    parameter: str
    unit: str | None
    values: np.ndarray
    margins: tuple[LoopMargins, ...]
    crossings: tuple[SweepCrossing, ...]
