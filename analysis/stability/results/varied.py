"""Margins under variation of the communication step, of the trials of a campaign, or of a parameter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..loops.margin_values import LoopMargins, MarginQuantity, order_statistic
from .requirement import MarginRequirement

LEVELS = {"least": 0.0, "5 %": 0.05, "50 %": 0.5}  # quantiles of dispersed margins


@dataclass(frozen=True)
class StepMargins:
    """Margins with another communication step (s); None if they do not exist, with the reason in ``note``."""

    step: float
    margins: LoopMargins | None
    note: str = ""


@dataclass(frozen=True)
class Dispersion:
    """Margins over the trials of a campaign.

    ``worst`` is the trial with the least disk margin or, if there are unstable trials, with the largest multiplier;
    ``replay`` is the command that studies this trial again. ``poles`` are the closed-loop multipliers of all trials,
    concatenated.
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
        """Return a margin's size in every trial, which may be `UNSTABLE` or `UNLIMITED`."""
        return np.array([item.size(quantity) for item in self.margins])

    def levels(self, quantity: MarginQuantity) -> dict[str, float]:
        """Return least value, 5 % quantile and median over all trials; each is the margin of one trial."""
        sizes = [item.size(quantity) for item in self.margins]
        return {name: order_statistic(sizes, level) for name, level in LEVELS.items()}


@dataclass(frozen=True)
class SweepCrossing:
    """Value of the parameter at which a margin reaches its limit, or the loop becomes unstable.

    ``below`` is True if smaller values fail.
    """

    quantity: MarginQuantity
    value: float
    below: bool


@dataclass(frozen=True)
class SweepReport:
    """Margins over one parameter, and the values at which limits are crossed, ascending."""

    name: str
    loop: str
    parameter: str
    unit: str | None
    values: np.ndarray
    margins: tuple[LoopMargins, ...]
    crossings: tuple[SweepCrossing, ...]
