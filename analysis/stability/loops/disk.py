"""Disk margin of several loops at once: how far all gains and phases may change simultaneously and independently."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from .curves import Response, base_grid, cache_response
from .margins import disk_gain, disk_phase, highest
from .structured import upper_bound

_STEP = 0.05  # largest change of log alpha between neighbouring frequencies
_MOST = 3000


class JointDisk(NamedTuple):
    """Least disk margin, the gain and phase that it permits in all channels at once, and the margin over frequency."""

    alpha: float
    gain: float  # factor upwards, 1/factor downwards
    phase: float  # rad
    frequency: float  # rad/s, at the least margin
    frequencies: np.ndarray
    alphas: np.ndarray


def disk_margins(value: np.ndarray) -> np.ndarray:
    """Return the disk margin (skew 0) of each L in ``value`` (n, m, m).

    It is the inverse structured singular value of S - I/2 for a separate complex uncertainty in every channel. This
    value is computed as its upper bound by diagonal scaling, which is exact up to three channels. python-control's
    `disk_margins` uses the same bound but does not accept frequency data. Source: Seiler, Packard and Gahinet, "An
    introduction to disk margins", IEEE Control Systems Magazine 40 (2020).
    """
    identity = np.eye(value.shape[-1])
    bounds = upper_bound(np.linalg.inv(identity + value) - 0.5 * identity)
    with np.errstate(divide="ignore"):
        return 1.0 / bounds


def joint_disk_margin(response: Response, low: float, high: float, *, include: Iterable[float] = ()) -> JointDisk:
    """Return the disk margin of the channels of ``response`` (n, m, m) between ``low`` and ``high`` (rad/s).

    It bounds the permitted perturbations only if the closed loop is stable. ``include`` are the frequencies of lightly
    damped poles. Raises ValueError if the margin is not resolved over frequency.
    """
    margins = cache_response(lambda angular: disk_margins(response(angular)))
    frequency = base_grid(low, high, include)
    alphas = margins(frequency)
    while (coarse := np.flatnonzero(np.abs(np.diff(np.log(alphas))) > _STEP)).size:
        if len(frequency) + len(coarse) > _MOST:
            raise ValueError(f"the disk margin is not resolved by {_MOST} frequencies up to {high:g} rad/s")
        middle = 0.5 * (frequency[coarse] + frequency[coarse + 1])
        frequency = np.insert(frequency, coarse + 1, middle)
        alphas = np.insert(alphas, coarse + 1, margins(middle))
    bound, worst = highest(lambda angular: 1.0 / margins(angular), frequency)
    alpha = 1.0 / bound
    place = int(np.searchsorted(frequency, worst))
    if place == len(frequency) or frequency[place] != worst:
        frequency, alphas = np.insert(frequency, place, worst), np.insert(alphas, place, alpha)
    return JointDisk(alpha, disk_gain(alpha), disk_phase(alpha), worst, frequency, alphas)
