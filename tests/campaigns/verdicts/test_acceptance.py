"""perilune.analysis.campaigns.verdicts.acceptance: verdicts on campaigns of a fixed size.

Truth: numbers of trials for 0, 1, 2 failures in the literature (Hanson and Beard, NASA/TP-2010-216447, whose formula is
the binomial sum; Wilks' 59, 93, 124, ... for 95 % at 95 %, as printed by Guba, Makai and Pal 2003); logarithms; the
beta distribution of Clopper and Pearson's bounds; the binomial distribution summed in fractions.
"""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import beta, binom

from perilune.analysis.campaigns.verdicts.acceptance import (
    AcceptanceVerdict,
    FixedSize,
    acceptance_number,
    consumer_risk,
    decide_by_size,
    flights_needed,
    producer_risk,
)

SHARES = st.floats(0.01, 0.9999)
CONFIDENCES = st.floats(0.5, 0.9999)


@pytest.mark.parametrize(
    ("share", "confidence", "flights"),
    [
        (0.9987, 0.90, [1771, 2991, 4093]),
        (0.99865, 0.90, [1705, 2880, 3941]),
        (0.9973, 0.90, [852, 1440, 1970]),
        (0.95, 0.95, [59, 93, 124, 153, 181, 208]),
        (0.90, 0.90, [22, 38, 52]),
    ],
)
def test_published_numbers_of_flights(share, confidence, flights):
    assert [flights_needed(failures, share, confidence) for failures in range(len(flights))] == flights


@given(SHARES, CONFIDENCES)
def test_flights_without_failures_are_a_logarithm(share, confidence):
    exact = math.log(1.0 - confidence) / math.log(share)
    assert flights_needed(0, share, confidence) in {max(1, math.ceil(exact - 1e-9)), max(1, math.ceil(exact + 1e-9))}


def test_half_of_3_sigma():
    assert flights_needed(0, 0.9973, 0.5) == math.ceil(math.log(0.5) / math.log(0.9973)) == 257


def test_risks_are_binomial_sums():
    fraction, flights = Fraction(997, 1000), 40
    terms = [math.comb(flights, k) * (1 - fraction) ** k * fraction ** (flights - k) for k in range(flights + 1)]
    for failures in (0, 1, 3, 40):
        assert consumer_risk(flights, failures, 0.997) == pytest.approx(float(sum(terms[: failures + 1])), rel=1e-10)
        assert producer_risk(flights, failures, 0.997) == pytest.approx(float(sum(terms[failures:])), rel=1e-10)


@given(st.integers(1, 3000), st.data(), SHARES, CONFIDENCES)
def test_verdicts_are_those_of_clopper_and_pearsons_bounds(flights, data, share, confidence):
    """Met where the lower bound of the share reaches the required one, not met where the upper one does from below."""
    failures = data.draw(st.integers(0, flights))
    good = flights - failures
    low = 0.0 if good == 0 else beta.ppf(1.0 - confidence, good, failures + 1)
    high = 1.0 if failures == 0 else beta.ppf(confidence, good + 1, failures)
    if min(abs(low - share), abs(high - share)) < 1e-9:
        return  # too near for another formula
    expected = (
        AcceptanceVerdict.MET
        if low > share
        else AcceptanceVerdict.NOT_MET
        if high < share
        else AcceptanceVerdict.UNDECIDED
    )
    assert decide_by_size(flights, failures, share, confidence) is expected


@given(st.integers(1, 5000), SHARES, CONFIDENCES)
def test_permitted_failures_are_the_most_that_meet_it(flights, share, confidence):
    maximum = acceptance_number(flights, share, confidence)
    assert maximum < 0 or decide_by_size(flights, maximum, share, confidence) is AcceptanceVerdict.MET
    assert decide_by_size(flights, maximum + 1, share, confidence) is not AcceptanceVerdict.MET


@given(st.integers(0, 30), st.floats(0.5, 0.9999), CONFIDENCES)
def test_flights_needed_are_the_fewest(failures, share, confidence):
    flights = flights_needed(failures, share, confidence)
    assert acceptance_number(flights, share, confidence) >= failures
    assert acceptance_number(flights - 1, share, confidence) < failures


def test_what_is_missing():
    rule = FixedSize(0.9987, 0.9)
    decision = rule.decision(np.arange(2000) != 7)
    assert (decision.verdict, decision.flights, decision.failures) == (AcceptanceVerdict.UNDECIDED, 2000, 1)
    assert decision.consumer_risk == pytest.approx(binom.cdf(1, 2000, 0.0013))
    assert rule.flights_to_meet(2000, 1) == {0: 991, 1: 2093, 2: 3138}
    assert rule.count_permitted(1770) == (1770, -1)
    assert rule.count_permitted(1771) == (1771, 0)


def test_below_a_half_both_verdicts_were_possible():
    assert consumer_risk(1, 0, 0.5) <= 0.6
    assert producer_risk(1, 0, 0.5) > 0.6
    assert consumer_risk(2, 1, 0.5) + producer_risk(2, 1, 0.5) == 1.5
    with pytest.raises(ValueError, match=r"0\.4 is not in 0\.5 to 1"):
        decide_by_size(2, 1, 0.5, 0.4)


@pytest.mark.parametrize("share", [0.9987, 0.99, 0.9])
@pytest.mark.parametrize("beside", [0.5, 0.999, 1.001, 2.0])
def test_ten_thousand_campaigns_are_wrong_in_a_tenth_at_most(share, beside):
    """Failure rates just off the required one and far from it; 10.9 % is three deviations above 10."""
    rate = (1.0 - share) * beside
    flights = flights_needed(1, share, 0.9)
    failures = np.random.default_rng(17).binomial(flights, rate, 10_000)
    verdicts = {count: decide_by_size(flights, count, share, 0.9) for count in np.unique(failures)}
    wrong = AcceptanceVerdict.MET if rate > 1.0 - share else AcceptanceVerdict.NOT_MET
    assert sum(verdicts[count] is wrong for count in failures) <= 1090
