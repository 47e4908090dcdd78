"""Verdicts on a campaign whose number of flights was fixed beforehand, after Hanson and Beard (2010).

A requirement asks that a ``share`` of all flights that could be flown keep it, shown with a ``confidence``; of
``flights`` independent ones, ``failures`` did not. With the required failure rate p = 1 - share, failures are
binomial, and everything here is exact.

J. M. Hanson and B. B. Beard, "Applying Monte Carlo Simulation to Launch Vehicle Design and Requirements Analysis",
NASA/TP-2010-216447, 2010; C. J. Clopper and E. S. Pearson, Biometrika 26, 1934.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import scipy

ROUNDING = 1e-12  # of a risk, relative: 1 - 0.9 is less than 0.1
FURTHER = (0, 1, 2)  # numbers of further failures for which the required flights are reported


class AcceptanceVerdict(StrEnum):
    """Verdict of a campaign on a requirement."""

    MET = "met"
    NOT_MET = "not met"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Decision:
    """A verdict, and after how many flights with how many failures it was found.

    ``consumer_risk`` is the probability, at the required share, of meeting the requirement with no more than that.
    """

    verdict: AcceptanceVerdict
    flights: int
    failures: int
    consumer_risk: float


def risk_limit(confidence: float) -> float:
    """Return the probability of a wrong verdict that a confidence permits."""
    return (1.0 - confidence) * (1.0 + ROUNDING)


def consumer_risk(flights: int, failures: int, share: float) -> float:
    """Return the risk of accepting: the probability of that many failures or fewer at the share (Hanson and Beard).

    No system with a smaller share has so few failures with a larger probability.
    """
    return float(scipy.stats.binom.cdf(failures, flights, 1.0 - share))


def producer_risk(flights: int, failures: int, share: float) -> float:
    """Return the risk of rejecting: the probability of that many failures or more at the required share.

    No system with a larger share has so many failures with a larger probability.
    """
    return float(scipy.stats.binom.sf(failures - 1, flights, 1.0 - share))


def decide_by_size(flights: int, failures: int, share: float, confidence: float) -> AcceptanceVerdict:
    """Decide a campaign whose size did not depend on its outcome.

    Met where the consumer's risk is at most 1 - ``confidence``, not met where the producer's is: Clopper and Pearson's
    one-sided bounds of the share, at that confidence each, exclude the other side of the required one. Both would be
    possible below a confidence of 0.5, which is refused by ValueError.
    """
    if not 0.5 <= confidence < 1.0:
        raise ValueError(f"a confidence of {confidence:g} is not in 0.5 to 1")
    risk = risk_limit(confidence)
    if consumer_risk(flights, failures, share) <= risk:
        return AcceptanceVerdict.MET
    return AcceptanceVerdict.NOT_MET if producer_risk(flights, failures, share) <= risk else AcceptanceVerdict.UNDECIDED


def acceptance_number(flights: int, share: float, confidence: float) -> int:
    """Return the largest number of failures with which the requirement is met; -1 where none is small enough."""
    risk = risk_limit(confidence)
    # the fewest that are no longer few enough, or exactly so
    failures = int(scipy.stats.binom.ppf(risk, flights, 1.0 - share))
    while failures >= 0 and consumer_risk(flights, failures, share) > risk:
        failures -= 1
    return failures


def flights_needed(failures: int, share: float, confidence: float) -> int:
    """Return the fewest flights that meet the requirement with that many failures."""
    risk = risk_limit(confidence)
    few, enough = failures, failures + 1  # with failures alone the risk is 1
    while consumer_risk(enough, failures, share) > risk:
        few, enough = enough, 2 * enough
    while enough - few > 1:
        middle = (few + enough) // 2
        if consumer_risk(middle, failures, share) <= risk:
            enough = middle
        else:
            few = middle
    return enough


class FixedSize:
    """The verdict on a campaign whose number of flights did not depend on what came of it."""

    def __init__(self, share: float, confidence: float) -> None:
        self.share = share
        self.confidence = confidence

    def decision(self, kept: np.ndarray) -> Decision:
        """Return the verdict on all flights, True where the requirement was kept."""
        flights, failures = len(kept), int(np.count_nonzero(~np.asarray(kept, dtype=bool)))
        verdict = decide_by_size(flights, failures, self.share, self.confidence)
        return Decision(verdict, flights, failures, consumer_risk(flights, failures, self.share))

    def count_permitted(self, flights: int) -> tuple[int, int]:
        """Return the number of flights that count, all, and the failures with which they meet
        the requirement, -1 for none."""
        return flights, acceptance_number(flights, self.share, self.confidence)

    def flights_to_meet(self, flights: int, failures: int) -> dict[int, int]:
        """Return the number of further flights one campaign would have needed, by failures in those."""
        needed = {more: flights_needed(failures + more, self.share, self.confidence) for more in FURTHER}
        return {more: max(0, number - flights) for more, number in needed.items()}
