"""A rare failure of a real campaign, compared with the trials of a batch that fail.

Truth: the share of failed trials in a batch, with its exact binomial interval (Clopper and Pearson); a million trials
under `make long`, and stored counts of trials of a noisy landing.
"""

import pytest
from pyarrow.compute import field
from scipy.stats import binom, binomtest

import perilune
from tests.support.landing_counts import CAMPAIGN as LANDING
from tests.support.landing_counts import GUIDANCE, MISSES
from tests.support.landing_counts import TRIALS as LANDINGS
from tests.support.lengths import LONG, either

CAMPAIGN = ("lunar_terminal_guidance", "paper")
TRIALS, SAMPLES = either(1_000_000, 2000), either(4500, 300)
LIMIT = either(3.55, 3.0)  # m/s: of a million trials 310 end faster, of 2000 about one in a hundred


@pytest.mark.usefixtures("fmus")
def test_the_intervals_of_both_meet(tmp_path):
    options = {"step": 0.5, "workers": either(None, 1)}
    perilune.batch(
        *CAMPAIGN, compare={"guidance": ["analytic_guidance"]}, trials=TRIALS, output=tmp_path / "trials", **options
    )
    results = perilune.open_results(tmp_path / "trials")
    failures = results.arrow(["trial"], where=field("metric.velocity_error") > LIMIT).num_rows
    assert results.flown == TRIALS
    exact = binomtest(failures, TRIALS).proportion_ci(method="exact")
    meeting = []
    for seed in (None, *range(1, 20)) if LONG else (None,):
        actual = perilune.rare(
            *CAMPAIGN, compare={"guidance": "analytic_guidance"}, failure=f"velocity_error > {LIMIT}", seed=seed,
            samples=SAMPLES, **options,
        )  # fmt: skip
        low, high = actual.interval
        print(
            f"{failures} of {TRIALS}: {exact.low:.3g} to {exact.high:.3g}; rare {actual.probability}, {low} to {high}"
        )
        meeting.append(low < exact.high and high > exact.low)
        assert actual.flights < TRIALS
    # intervals of 95 % miss in one of twenty: fewer meet than these once in a hundred times
    assert sum(meeting) >= (binom.ppf(0.01, len(meeting), 0.95) if LONG else 1)


@pytest.mark.usefixtures("fmus")
@pytest.mark.slow  # test_the_intervals_of_both_meet flies a campaign, test_rare_noise.py has noise
@pytest.mark.parametrize("limit", MISSES)
def test_a_noisy_landing_beside_its_trials(limit):
    """The noise of one trial gives anything between 0 and 1 here; what the trials give is an integral over it."""
    exact = binomtest(MISSES[limit], LANDINGS).proportion_ci(method="exact")
    actual = perilune.rare(
        *LANDING, compare={"guidance": GUIDANCE}, failure=f"position_error > {limit}", samples=4500,
    )  # fmt: skip
    low, high = actual.interval
    print(f"{limit}: {exact.low:.3g} to {exact.high:.3g}; rare {actual.probability}, {low} to {high}, {high / low:.2f}")
    assert low < exact.high
    assert high > exact.low
    if limit == 3.5:
        assert high / low < 4.0
