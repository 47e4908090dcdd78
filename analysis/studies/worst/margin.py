"""Which margin is to be worst, as a number of every draw: minus the margin, above 0 where the loop is unstable."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from ...stability.loops.margin_values import UNSTABLE, Margins, Quantity
from ..evaluation.flown import strict
from .metric import Badness

MOST = 1e9  # what a margin without a crossing counts as: more than any
SIZES = {
    "disk": ("disk_margin", Quantity.DISK),
    "modulus": ("modulus_margin", Quantity.MODULUS),
    "gain": ("gain_margin_db", Quantity.GAIN),
    "phase": ("phase_margin_deg", Quantity.PHASE),
    "delay": ("delay_margin_s", Quantity.DELAY),
}
LARGEST = "largest_multiplier"


def margin_columns(channels: Sequence[str], studied: Sequence[Sequence[Margins] | None]) -> dict[str, np.ndarray]:
    """The margins of all channels, a row for each of ``found`` and a column for each margin and largest multiplier.

    A margin of an unstable loop is `UNSTABLE`, one without a crossing inf; a row of None is nan.
    """
    columns: dict[str, np.ndarray] = {}
    for index, channel in enumerate(channels):
        for key, quantity in SIZES.values():
            columns[f"{channel}.{key}"] = np.array([row[index].size(quantity) if row else np.nan for row in studied])
        columns[f"{channel}.{LARGEST}"] = np.array(
            [row[index].largest if row else np.nan for row in studied], dtype=float
        )
    return columns


def badness_of_margin(name: str, point: str, channels: Sequence[str], margin: str) -> Badness:
    """Of the least margin of a loop's channels at a point; ``margin`` is one of `SIZES`.

    Of an unstable channel it is its largest multiplier less 1, which continues where margins end at 0.
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
    return Badness(f"{quantity} of {name} at {point}{unit}", of, _size, _fact)


def _size(value: float) -> float:
    """The margin that a value is of; nan where there is none."""
    if value == math.inf:
        return math.nan
    return UNSTABLE if value > 0.0 else 0.0 - value


def _fact(size: float) -> float | str | None:
    return "unstable" if size == UNSTABLE else "unlimited" if size >= MOST else strict(size)
