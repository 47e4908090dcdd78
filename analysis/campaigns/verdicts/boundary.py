"""Stopping boundary of a count at interim looks, with its risk computed exactly by recursion over looks and counts.

A count of events, each with probability ``rate``, is observed repeatedly. The boundary at a look is the count at or
below which to stop, because so small a count is improbable. It is the largest count for which the probability of having
stopped so far, at that rate, is within the risk that may be spent so far (Lan and DeMets, Biometrika 70, 1983; the
recursion is that of Armitage, McPherson and Rowe, J. R. Statist. Soc. A 132, 1969, on counts). At a larger rate counts
are equal or larger and stop no more often: the risk is valid for every larger rate.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

TAIL = 1e-18  # probability cut off at either end of a distribution: negligible against any risk
SPENT = 1.0 - 1e-9  # fraction of the permitted risk that is spent; the remainder covers rounding and the tails


def spending(flights: int, risk: float, half: int) -> float:
    """Return the risk that may be spent in the first ``flights``: half of it in ``half`` flights, all in the limit."""
    return SPENT * risk * flights / (flights + half)


@dataclass(frozen=True)
class InterimLook:
    """Interim look, which stops at counts up to ``most``.

    ``spent`` is the probability of having stopped at an earlier look. ``probabilities`` are the probabilities of
    reaching this look with the counts from ``lowest`` on.
    """

    flights: int
    most: int
    spent: float
    lowest: int
    probabilities: np.ndarray

    def risk(self, count: int) -> float:
        """Return the probability of having stopped before, or of a count of at most ``count`` at this look."""
        return self.spent + float(self.probabilities[: max(0, count - self.lowest + 1)].sum())


class Boundary:
    """Stopping counts, look by look; a new look follows all earlier looks and does not change them.

    ``spend`` returns the risk that may be spent in a number of simulations, as `spending` does; it must not decrease.
    """

    def __init__(self, rate: float, spend: Callable[[int], float]) -> None:
        self.rate = rate
        self.spend = spend
        self.looks: list[InterimLook] = []

    def add(self, flights: int) -> InterimLook:
        """Add and return the next look, after ``flights`` simulations in all."""
        last = self.looks[-1] if self.looks else InterimLook(0, -1, 0.0, 0, np.ones(1))
        start = max(last.lowest, last.most + 1)
        flown = flights - last.flights
        new = scipy.stats.binom(flown, self.rate)
        first, end = int(new.ppf(TAIL)), int(new.isf(TAIL))
        events = new.pmf(np.arange(first, end + 1))
        probabilities = np.convolve(last.probabilities[start - last.lowest :], events)
        lowest = start + first
        spent = last.risk(last.most)
        low = int(np.searchsorted(np.cumsum(probabilities), TAIL))
        high = len(probabilities) - int(np.searchsorted(np.cumsum(probabilities[::-1]), TAIL))
        probabilities, lowest = probabilities[low:high], lowest + low
        left = self.spend(flights) - spent
        maximum = lowest + int(np.searchsorted(np.cumsum(probabilities), left, side="right")) - 1
        self.looks.append(InterimLook(flights, maximum, spent, lowest, probabilities))
        return self.looks[-1]
