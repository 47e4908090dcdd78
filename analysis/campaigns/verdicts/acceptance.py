"""Verdicts on a campaign with a fixed number of simulations, after Hanson and Beard (2010).

A requirement demands that a ``share`` of all possible simulations satisfy it, shown with a ``confidence``. Of the
``flights``, which are independent simulations, ``failures`` did not satisfy it. With the permitted failure rate p = 1 -
share, failures are binomially distributed, and all results here are exact.

J. M. Hanson and B. B. Beard, "Applying Monte Carlo Simulation to Launch Vehicle Design and Requirements Analysis",
NASA/TP-2010-216447, 2010; C. J. Clopper and E. S. Pearson, Biometrika 26, 1934.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import scipy

ROUNDING = 1e-12  # relative tolerance of a risk: 1 - 0.9 is less than 0.1
FURTHER = (0, 1, 2)  # numbers of further failures for which the required flights are reported


class AcceptanceVerdict(StrEnum):
    """Verdict of a campaign on a requirement."""

    MET = "met"
    NOT_MET = "not met"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Decision:
    """Verdict, with the numbers of simulations and failures at which it was reached.

    ``consumer_risk`` is the probability, at the required share, of meeting the requirement with no more failures than
    these.
    """

    verdict: AcceptanceVerdict
    flights: int
    failures: int
    consumer_risk: float


def risk_limit(confidence: float) -> float:
    """Return the probability of a wrong verdict that corresponds to a confidence."""
    return (1.0 - confidence) * (1.0 + ROUNDING)


def consumer_risk(flights: int, failures: int, share: float) -> float:
    """Return the risk of accepting: the probability of at most ``failures`` at the required share (Hanson and Beard).

    For any smaller share the probability is smaller.
    """
    return float(scipy.stats.binom.cdf(failures, flights, 1.0 - share))


def producer_risk(flights: int, failures: int, share: float) -> float:
    """Return the risk of rejecting: the probability of at least ``failures`` at the required share.

    For any larger share the probability is smaller.
    """
    return float(scipy.stats.binom.sf(failures - 1, flights, 1.0 - share))


def decide_by_size(flights: int, failures: int, share: float, confidence: float) -> AcceptanceVerdict:
    """Return the verdict on a campaign whose size did not depend on its outcome.

    The requirement is met if the consumer's risk is at most 1 - ``confidence``, and not met if the producer's risk is.
    This is equivalent to Clopper and Pearson's one-sided bounds of the share at that confidence, which then exclude
    shares below, or above, the required share. Below a confidence of 0.5 both verdicts would be possible, which raises
    ValueError.
    """
    if not 0.5 <= confidence < 1.0:
        raise ValueError(f"a confidence of {confidence:g} is not in 0.5 to 1")
    risk = risk_limit(confidence)
    if consumer_risk(flights, failures, share) <= risk:
        return AcceptanceVerdict.MET
    return AcceptanceVerdict.NOT_MET if producer_risk(flights, failures, share) <= risk else AcceptanceVerdict.UNDECIDED


def acceptance_number(flights: int, share: float, confidence: float) -> int:
    """Return the largest number of failures with which the requirement is met, or -1 if it cannot be met."""
    risk = risk_limit(confidence)
    # fewest failures with a risk at or above the limit
    failures = int(scipy.stats.binom.ppf(risk, flights, 1.0 - share))
    while failures >= 0 and consumer_risk(flights, failures, share) > risk:
        failures -= 1
    return failures


def flights_needed(failures: int, share: float, confidence: float) -> int:
    """Return the smallest number of simulations that meets the requirement with this number of failures."""
    risk = risk_limit(confidence)
    few, enough = failures, failures + 1  # if every simulation fails, the risk is 1
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
    """Rule for a campaign whose number of simulations does not depend on their outcomes."""

    def __init__(self, share: float, confidence: float) -> None:
        self.share = share
        self.confidence = confidence

    def decision(self, kept: np.ndarray) -> Decision:
        """Return the verdict on all simulations; ``kept`` is True for simulations that satisfy the requirement."""
        flights, failures = len(kept), int(np.count_nonzero(~np.asarray(kept, dtype=bool)))
        verdict = decide_by_size(flights, failures, self.share, self.confidence)
        return Decision(verdict, flights, failures, consumer_risk(flights, failures, self.share))

    def count_permitted(self, flights: int) -> tuple[int, int]:
        """Return the number of simulations that count (all), and the permitted failures, or -1 if there are too few."""
        return flights, acceptance_number(flights, self.share, self.confidence)

    def flights_to_meet(self, flights: int, failures: int) -> dict[int, int]:
        """Return the numbers of further simulations a single campaign would have needed, by the failures in them."""
        needed = {more: flights_needed(failures + more, self.share, self.confidence) for more in FURTHER}
        return {more: max(0, number - flights) for more, number in needed.items()}
