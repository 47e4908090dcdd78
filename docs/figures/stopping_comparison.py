"""Cost of stopping rules for 99.87 % success at 90 % confidence: `python -m docs.figures.stopping_comparison`.

Prints the tables of docs/campaigns.md. The numbers are exact, without random sampling: risks and expectations are
computed over all possible campaigns, by recursion over looks and counts of failures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import betainc, betaln
from scipy.stats import binom

from perilune.analysis.campaigns.verdicts.acceptance import FURTHER, acceptance_number, flights_needed, producer_risk
from perilune.analysis.campaigns.verdicts.boundary import SPENT, Boundary
from perilune.analysis.campaigns.verdicts.stopping import StoppingRule

SHARE, CONFIDENCE = 0.9987, 0.9
RISK, RATE = 1.0 - CONFIDENCE, 1.0 - SHARE
MOST = 20_000  # flights
SHARES = (0.9999, 0.9995, 0.9987, 0.998)  # true ones
COUNTS = np.arange(150)  # failures; every rule has rejected before more


@dataclass(frozen=True)
class Rule:
    """A stopping rule: at each look, the most failures with verdict met, and the fewest with verdict not met."""

    name: str
    looks: Sequence[int]
    permitted: Sequence[int]
    refused: Sequence[int]


@dataclass(frozen=True)
class RuleStatistics:
    """Statistics over all campaigns: shares met and not met, expected trials, trials by which 95 % have ended."""

    met: float
    refused: float
    flights: float
    nearly_all: int


def compute_statistics(rule: Rule, rate: float) -> RuleStatistics:
    """Return the statistics of campaigns with a failure rate, which end with their first verdict or the last look."""
    alive, met, refused, expected, last, nearly_all = np.ones(1), 0.0, 0.0, 0.0, 0, rule.looks[-1]
    for flights, low, high in zip(rule.looks, rule.permitted, rule.refused, strict=True):
        expected += (flights - last) * alive.sum()
        step = binom.pmf(np.arange(min(flights - last, COUNTS.size) + 1), flights - last, rate)
        alive, last = np.convolve(alive, step), flights
        met, refused = met + alive[: low + 1].sum(), refused + alive[high:].sum()
        alive[: low + 1], alive[high:] = 0.0, 0.0
        if met + refused >= 0.95:
            nearly_all = min(nearly_all, flights)
    return RuleStatistics(met, refused, expected, nearly_all)


def _by_evidence(name: str, looks: Sequence[int], good: Callable, bad: Callable) -> Rule:
    """Return a rule whose verdict falls when a likelihood ratio to the limit reaches 1 / risk.

    By Ville's inequality it does so wrongly, at any time, with at most this risk.
    """
    permitted: list[int] = []
    refused: list[int] = []
    for flights in looks:
        counts = COUNTS[flights >= COUNTS]
        at_limit = counts * np.log(RATE) + (flights - counts) * np.log1p(-RATE)
        for outcomes, likelihood in ((permitted, good), (refused, bad)):
            with np.errstate(divide="ignore"):
                enough = np.flatnonzero(likelihood(counts, flights) - at_limit >= -np.log(RISK))
            outcomes.append(int(enough.max(initial=-1) if outcomes is permitted else enough.min(initial=flights + 1)))
    return Rule(name, looks, permitted, refused)


def _point(rate: float) -> Callable:
    return lambda counts, flights: counts * np.log(rate) + (flights - counts) * np.log1p(-rate)


def _mixture(above: bool) -> Callable:
    """Return Robbins' mixture of all rates below or above the limit: a beta distribution whose mean is the limit."""
    a, b = 0.5, 0.5 / RATE

    def inside(first: np.ndarray | float, second: np.ndarray | float) -> np.ndarray:
        below = betainc(first, second, RATE)
        return betaln(first, second) + np.log(1.0 - below if above else below)

    return lambda counts, flights: inside(counts + a, flights - counts + b) - inside(a, b)


def _spending_rule(name: str, looks: Sequence[int], spend: Callable[[int], float]) -> Rule:
    """Return a rule that spends the risk exactly, all of it by the last look."""
    met, refused = Boundary(RATE, spend), Boundary(SHARE, spend)
    return Rule(
        name, looks, [met.add(n).most for n in looks], [flights - refused.add(flights).most for flights in looks]
    )


def _one_size(name: str, looks: Sequence[int]) -> Rule:
    refused = [int(np.argmax([producer_risk(n, int(k), SHARE) <= RISK for k in COUNTS])) for n in looks]
    return Rule(name, looks, [acceptance_number(flights, SHARE, CONFIDENCE) for flights in looks], refused)


def rules() -> list[Rule]:
    """Return the compared rules, Perilune's last."""
    ours = StoppingRule(SHARE, CONFIDENCE)
    analyses = ours.looks(MOST)
    sizes = [flights_needed(failures, SHARE, CONFIDENCE) for failures in FURTHER]
    return [
        _one_size(f"one campaign of {sizes[-1]}", sizes[-1:]),
        _one_size(f"{sizes[0]}, {sizes[1]}, {sizes[2]} in turn, each as if alone", sizes),
        _by_evidence("Wald's ratios, half and twice the rate", analyses, _point(RATE / 2.0), _point(2.0 * RATE)),
        _by_evidence("Robbins' mixture", analyses, _mixture(above=False), _mixture(above=True)),
        _spending_rule(f"spending planned for {MOST}", analyses, lambda flights: SPENT * RISK * flights / MOST),
        Rule(
            "spending without an end",
            analyses,
            [ours.acceptance_number(flights) for flights in analyses],
            [ours.rejection_number(flights) for flights in analyses],
        ),
    ]


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table in Markdown."""
    lines = [list(head), *map(list, rows)]
    return "\n".join(f"| {' | '.join(line)} |" for line in [lines[0], ["---"] * len(lines[0]), *lines[1:]])


def main() -> None:
    outcomes = rules()
    at_limit = [compute_statistics(rule, RATE) for rule in outcomes]
    risks = [
        [rule.name, f"{100 * c.met:.1f}", f"{100 * c.refused:.1f}"] for rule, c in zip(outcomes, at_limit, strict=True)
    ]
    print(table(["rule", "met, %", "not met, %"], risks))
    rows = []
    for rule in outcomes:
        courses = [compute_statistics(rule, 1.0 - fraction) for fraction in SHARES]
        decided = [100 * (c.met + c.refused) for c in courses]
        rows.append(
            [rule.name, *(f"{c.flights:.0f}, {c.nearly_all}, {d:.1f}" for c, d in zip(courses, decided, strict=True))]
        )
    print()
    print(table(["rule", *(f"{100 * fraction:g} %" for fraction in SHARES)], rows))


if __name__ == "__main__":
    main()
