"""Rare failures of a noisy landing compared with Monte Carlo: `python benchmarks/rare_landing.py [RESULTS]`.

RESULTS is the folder of a batch as described in `tests/support/landing_counts.py`; by default the reference is the
counts in that file. A study has 4500 samples per level and takes some minutes.
"""

import sys

from pyarrow.compute import field
from scipy.stats import binomtest

import perilune
from tests.support.landing_counts import CAMPAIGN, GUIDANCE, MISSES, TRIALS

SAMPLES = 4500


def counts() -> tuple[int, dict[float, int]]:
    """Return the number of trials, and the number of trials that exceed each limit."""
    if len(sys.argv) < 2:
        return TRIALS, MISSES
    results = perilune.open_results(sys.argv[1])
    over = {limit: field("metric.position_error") > limit for limit in MISSES}
    return results.flown, {limit: results.arrow(["trial"], where=where).num_rows for limit, where in over.items()}


def main() -> None:
    trials, misses = counts()
    print("| failure | Monte Carlo, 95 % | rare, 95 % | high/low | flights |")
    print("| --- | --- | --- | --- | --- |")
    for limit, missed in misses.items():
        exact = binomtest(missed, trials).proportion_ci(method="exact")
        estimate = perilune.rare(
            *CAMPAIGN, compare={"guidance": GUIDANCE}, failure=f"position_error > {limit}", samples=SAMPLES
        )
        low, high = estimate.interval
        batch = f"{missed} of {trials}: {exact.low:.3g} to {exact.high:.3g}"
        print(
            f"| over {limit} m | {batch} | {low:.3g} to {high:.3g} | {high / low:.2f} | {estimate.flights} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
