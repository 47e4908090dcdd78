"""Verdicts that are valid at any number of interim looks, so that a campaign may end with the first of them.

Looking at 1771, 2991 and 4093 simulations in turn, each as a campaign of that size alone, accepts a system at the limit
in 17.8 % of campaigns instead of 10 %. `StoppingRule` distributes the risk over all future looks (`boundary`),
separately for each of the two verdicts. There is no last look: a campaign that is undecided at its end may be extended.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache, partial

import numpy as np

from .acceptance import FURTHER, AcceptanceVerdict, Decision, flights_needed, risk_limit
from .boundary import Boundary, InterimLook, spending

FINEST = 32  # number of looks at the first distance; then the distance doubles whenever the number of simulations does
FIRST_LOOKS = 16  # least number of looks before a campaign of fixed size without failures would end


class StoppingRule:
    """Stopping rule: the verdict as a function of the numbers of simulations and failures at fixed looks.

    The probability of ever accepting a system with less than the ``share`` of successful simulations is at most 1 -
    ``confidence``, and so is the probability of ever rejecting a system with the ``share`` or more. Both are valid
    separately, even if simulations continue after a verdict.

    Looks are at multiples of ``look`` simulations, by default a round number of at most a sixteenth of the simulations
    that a campaign without failures needs. After 32 looks only every second multiple is a look, after 64 looks every
    fourth, and so on.
    """

    def __init__(self, share: float, confidence: float, look: int | None = None) -> None:
        if not 0.5 <= confidence < 1.0:
            raise ValueError(f"a confidence of {confidence:g} is not in 0.5 to 1")
        self.share = share
        self.confidence = confidence
        half = flights_needed(0, share, confidence)
        self.look = look or _round_look(half)
        spend = partial(spending, risk=risk_limit(confidence), half=half)
        self._met = Boundary(1.0 - share, spend)  # counts failures, of which few meet the requirement
        self._not_met = Boundary(share, spend)  # counts successes, of which few violate the requirement
        self._places: dict[int, int] = {}
        self._next = self.look

    def looks(self, most: int) -> list[int]:
        """Return the numbers of simulations, up to ``most``, at which looks are taken."""
        self._extend(most)
        return [flights for flights in self._places if flights <= most]

    def acceptance_number(self, flights: int) -> int:
        """Return the largest number of failures with which a look meets the requirement, or -1 if it cannot.

        Raises ValueError if there is no look after ``flights``.
        """
        return self._look(self._met, flights).most

    def rejection_number(self, flights: int) -> int:
        """Return the least number of failures with which a look rejects; a number above ``flights`` if it cannot.

        Raises ValueError if there is no look after ``flights``.
        """
        return flights - self._look(self._not_met, flights).most

    def decide(self, flights: int, failures: int) -> AcceptanceVerdict:
        """Return the verdict at a look regardless of earlier looks. Raises ValueError if there is no look."""
        if failures <= self.acceptance_number(flights):
            return AcceptanceVerdict.MET
        return AcceptanceVerdict.NOT_MET if failures >= self.rejection_number(flights) else AcceptanceVerdict.UNDECIDED

    def decision(self, kept: np.ndarray) -> Decision:
        """Return the first verdict on simulations in order; ``kept`` is True for those that satisfy the requirement.

        Later simulations are ignored. If no look decides, the undecided result of the last look is returned; without
        any look it contains no simulations. The consumer's risk is the probability of having met the requirement at an
        earlier look, or with at most as many failures at this look.
        """
        failed = np.flatnonzero(~np.asarray(kept, dtype=bool))
        last = failures = 0
        for flights in self.looks(len(kept)):
            last, failures = flights, int(np.searchsorted(failed, flights))
            verdict = self.decide(flights, failures)
            if verdict is not AcceptanceVerdict.UNDECIDED:
                return self._decision(verdict, flights, failures)
        return self._decision(AcceptanceVerdict.UNDECIDED, last, failures)

    def count_permitted(self, flights: int) -> tuple[int, int]:
        """Return the last look in ``flights``, and the failures that it permits, or -1 if there are too few flights."""
        last = max(self.looks(flights), default=0)
        return last, self.acceptance_number(last) if last else -1

    def flights_to_meet(self, flights: int, failures: int) -> dict[int, int]:
        """Return the numbers of further simulations that meet the requirement, by the number of failures in them."""
        by_failures = {}
        for more in FURTHER:
            analyses = (look for look in self._all_looks() if look >= flights)
            enough = next(look for look in analyses if self.acceptance_number(look) >= failures + more)
            by_failures[more] = enough - flights
        return by_failures

    def _decision(self, verdict: AcceptanceVerdict, flights: int, failures: int) -> Decision:
        risk = self._look(self._met, flights).risk(failures) if flights else 1.0
        return Decision(verdict, flights, failures, risk)

    def _look(self, boundary: Boundary, flights: int) -> InterimLook:
        self._extend(flights)
        if flights not in self._places:
            raise ValueError(f"no interim analysis is planned after {flights} trials")
        return boundary.looks[self._places[flights]]

    def _all_looks(self) -> Iterator[int]:
        maximum = self._next
        yield from self.looks(maximum)
        while True:
            maximum = self._next
            self._extend(maximum)
            yield maximum

    def _extend(self, most: int) -> None:
        while self._next <= most:
            self._places[self._next] = len(self._places)
            self._met.add(self._next)
            self._not_met.add(self._next)
            self._next += self.look * 2 ** max(0, (self._next // self.look).bit_length() - FINEST.bit_length() + 1)


def _round_look(flights: int) -> int:
    """Return the largest of 1, 2, 5, 10, 20, 50 ... that is at most a sixteenth of ``flights``, at least 1."""
    sizes = [digit * 10**power for power in range(len(str(flights))) for digit in (1, 2, 5)]
    return max((size for size in sizes if size * FIRST_LOOKS <= flights), default=1)


@lru_cache(maxsize=64)
def stopping_rule(share: float, confidence: float) -> StoppingRule:
    """Return the rule with default looks, cached with its boundaries."""
    return StoppingRule(share, confidence)
