"""Samples of a standard normal space given that a margin is above a threshold: chains from those that are known.

Adaptive conditional sampling (Papaioannou, Betz, Zwirglmaier and Straub 2015, section 4.3): a candidate is
rho u + sqrt(1 - rho^2) xi with xi standard normal, which leaves the normal distribution as it is, and it is taken where
its margin is above the threshold. Its spread sqrt(1 - rho^2) follows the share of candidates that are taken.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

TAKEN = 0.44  # the share of candidates taken that is aimed at (ibid., section 4.3)
GROUPS = 10  # of chains, between which the spread is adapted (ibid.: a tenth of the chains)
FIRST_SPREAD = 0.6

MarginOf = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class Chains:
    """Chains by time, ``points`` (chains, length, dimensions) and their ``margins`` (chains, length).

    The first point of each is its seed. ``taken`` is the share of candidates that were taken, ``spread`` the last one.
    """

    points: np.ndarray
    margins: np.ndarray
    taken: float
    spread: float


def grow_chains(
    margin: MarginOf,
    seeds: np.ndarray,
    margins: np.ndarray,
    threshold: float,
    length: int,
    spread: float,
    random: np.random.Generator,
) -> Chains:
    """Chains of ``length`` points from ``seeds`` (chains, dimensions), whose ``margins`` (chains,) reach ``threshold``.

    ``margin`` maps points (points, dimensions) to margins (points,); chains are independent of each other given the
    spread, which changes from one group of them to the next (ibid., equations 25 to 27).
    """
    points = np.empty((len(seeds), length, seeds.shape[1]))
    found = np.empty((len(seeds), length))
    taken = []
    for number, group in enumerate(np.array_split(np.arange(len(seeds)), min(GROUPS, len(seeds)))):
        here, worth = seeds[group], margins[group]
        points[group, 0], found[group, 0] = here, worth
        steps = []
        for step in range(1, length):
            candidates = np.sqrt(1.0 - spread**2) * here + spread * random.standard_normal(here.shape)
            values = margin(candidates)
            good = values >= threshold
            here, worth = np.where(good[:, np.newaxis], candidates, here), np.where(good, values, worth)
            points[group, step], found[group, step] = here, worth
            steps.append(float(good.mean()))
        if steps:
            taken.append(float(np.mean(steps)))
            spread = min(1.0, float(np.exp(np.log(spread) + (taken[-1] - TAKEN) / np.sqrt(number + 1.0))))
    return Chains(points, found, float(np.mean(taken)) if taken else 1.0, spread)
