"""The stopping boundary of a count at looks, its risk spent exactly: by recursion over looks and counts.

A count of events that each have a probability ``rate`` is looked at again and again. The boundary says at which
counts to stop as improbably low: at every look the largest for which the probability of having stopped by then,
at that rate, keeps within what may be spent by then (Lan and DeMets, Biometrika 70, 1983; the recursion is that of
Armitage, McPherson and Rowe, J. R. Statist. Soc. A 132, 1969, on counts). At a larger rate, counts of the same
flights are as large or larger, and so stop no more often: the risk holds for every larger rate.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

TAIL = 1e-18  # probability cut off at either end of a distribution: negligible against any risk
SPENT = 1.0 - 1e-9  # of the risk that is permitted: the rest is for rounding and for those tails


def spending(flights: int, risk: float, half: int) -> float:
    """Return the share of ``risk`` to spend in the first ``flights``: half of it in ``half``, all in no finite
    number."""
    return SPENT * risk * flights / (flights + half)


@dataclass(frozen=True)
class InterimLook:
    """One look: counts up to ``most`` stop.

    ``spent`` is the probability of having stopped at an earlier look, ``probabilities`` are of the counts from
    ``lowest`` on that reach this look.
    """

    flights: int
    most: int
    spent: float
    lowest: int
    probabilities: np.ndarray

    def risk(self, count: int) -> float:
        """Return the probability of having stopped before, or of a count here that is no larger."""
        return self.spent + float(self.probabilities[: max(0, count - self.lowest + 1)].sum())


class Boundary:
    """Counts that stop, look by look; looks are added in ascending order and do not change those before.

    ``spend`` is what may be spent by a number of flights, such as `spending`, which does not grow less.
    """

    def __init__(self, rate: float, spend: Callable[[int], float]) -> None:
        self.rate = rate
        self.spend = spend
        self.looks: list[InterimLook] = []

    def add(self, flights: int) -> InterimLook:
        """Return the next look, after ``flights`` flights in all."""
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
