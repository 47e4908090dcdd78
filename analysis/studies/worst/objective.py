"""Objective of a worst-case search: a number for each trial, from its metrics or a loop's margins; larger is worse."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ....common.errors import InputError, suggestion
from ...campaigns.definition.campaign import Campaign
from ...campaigns.definition.expressions import Expression
from ...stability.loops.margin_values import UNSTABLE, LoopMargins, MarginQuantity
from ..failure import failure_of
from ..flown import strict_number


@dataclass(frozen=True)
class Objective:
    """Objective: a function of values by name (trials,) and of a mask of completed simulations (trials,).

    It is inf for a simulation that did not complete, and for a number that is not finite. ``text`` describes the
    objective, ``size`` converts an objective value to the number that it represents, and ``fact`` converts this number,
    or one of the values, to JSON. ``expression`` is the expression whose value or margin is the objective, None if the
    text contains the unit.
    """

    text: str
    of: Callable[[Mapping[str, np.ndarray], np.ndarray], np.ndarray]
    size: Callable[[float], float] = float
    fact: Callable[[float], float | str | None] = strict_number
    expression: Expression | None = None

    def __call__(self, values: Mapping[str, np.ndarray], flown: np.ndarray) -> np.ndarray:
        return self.of(values, flown)


def metric_objective(campaign: Campaign, text: str | None) -> Objective:
    """Return the objective of an expression over metrics and draws, by default the margin of success.

    Raises InputError.
    """
    if text is None:
        failure = failure_of(campaign, None)
        return Objective(f"margin of {failure.text}", failure.margins, expression=failure.expression)
    expression = Expression(text, ("`metric`", text))
    known = [metric.name for metric in campaign.metrics] + campaign.input_names()
    for name in sorted(expression.names - set(known)):
        raise InputError("`metric`", name, "neither a metric nor a draw of the campaign", suggestion(name, known))

    def of(values: Mapping[str, np.ndarray], flown: np.ndarray) -> np.ndarray:
        values_of_trials = np.broadcast_to(expression.evaluate(values), flown.shape)
        return np.where(flown & np.isfinite(values_of_trials), values_of_trials, np.inf)

    return Objective(expression.text, of, expression=expression)


MOST = 1e9  # value of a margin without a crossing: more than any other
SIZES = {
    "disk": ("disk_margin", MarginQuantity.DISK),
    "modulus": ("modulus_margin", MarginQuantity.MODULUS),
    "gain": ("gain_margin_db", MarginQuantity.GAIN),
    "phase": ("phase_margin_deg", MarginQuantity.PHASE),
    "delay": ("delay_margin_s", MarginQuantity.DELAY),
}
LARGEST = "largest_multiplier"


def margin_columns(channels: Sequence[str], studied: Sequence[Sequence[LoopMargins] | None]) -> dict[str, np.ndarray]:
    """Return columns with each margin and the largest multiplier of all channels, a row for each of ``studied``.

    The margin of an unstable loop is `UNSTABLE`, a margin without a crossing inf; the row for None is nan.
    """
    columns: dict[str, np.ndarray] = {}
    for index, channel in enumerate(channels):
        for key, quantity in SIZES.values():
            columns[f"{channel}.{key}"] = np.array([row[index].size(quantity) if row else np.nan for row in studied])
        columns[f"{channel}.{LARGEST}"] = np.array(
            [row[index].largest if row else np.nan for row in studied], dtype=float
        )
    return columns


def margin_objective(name: str, point: str, channels: Sequence[str], margin: str) -> Objective:
    """Return the objective of the least margin of a loop's channels at a point; ``margin`` is one of `SIZES`.

    For an unstable channel the objective is its largest multiplier minus 1, which is continuous with the margin 0.
    """
    key, quantity = SIZES[margin]

    def of(values: Mapping[str, np.ndarray], flown: np.ndarray) -> np.ndarray:
        worst = np.full(flown.shape, -np.inf)
        for channel in channels:
            size = np.minimum(values[f"{channel}.{key}"], MOST)
            beyond = np.maximum(values[f"{channel}.{LARGEST}"] - 1.0, np.finfo(float).tiny)
            worst = np.maximum(worst, np.where(size == UNSTABLE, beyond, -size))
        return np.where(flown, worst, np.inf)

    unit = "" if quantity.unit == "1" else f" ({quantity.unit})"
    return Objective(f"{quantity} of {name} at {point}{unit}", of, _size, _fact)


def _size(value: float) -> float:
    """Return the margin that an objective value represents; nan if there is none."""
    if value == math.inf:
        return math.nan
    return UNSTABLE if value > 0.0 else 0.0 - value


def _fact(size: float) -> float | str | None:
    return "unstable" if size == UNSTABLE else "unlimited" if size >= MOST else strict_number(size)
