"""perilune.analysis.campaigns.metric_limits: limits on metrics from expressions, and the worst trial.

Truth: the expressions themselves, evaluated at numbers within the limits and beyond them; rows sorted by hand.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.metric_limits import MetricLimits, metric_limits, worst_row, worst_trial
from perilune.analysis.campaigns.trials import TrialTable

INFINITY = math.inf


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("miss < 3", {"miss": (-INFINITY, 3.0)}),
        ("3 >= miss", {"miss": (-INFINITY, 3.0)}),
        ("miss > -2 * 3", {"miss": (-6.0, INFINITY)}),
        ("finished and 1200 <= height <= 1800 and speed < radians(180)",
         {"height": (1200.0, 1800.0), "speed": (-INFINITY, math.pi)}),
        ("miss < 3 and (miss < 2 and tilt > 1)", {"miss": (-INFINITY, 2.0), "tilt": (1.0, INFINITY)}),
        ("miss < 3 or tilt < 1", {}),
        ("not miss < 3", {}),
        ("miss + tilt < 3", {}),
        ("abs(miss) < 3", {}),
        ("miss == 3", {}),
        ("miss < tilt", {}),
        ("miss < 1 / 0", {}),
    ],
)  # fmt: skip
def test_limits_are_those_that_decide_alone(text, expected):
    limits = {name: MetricLimits(*ends) for name, ends in expected.items()}
    assert metric_limits([Expression(text)]) == limits


NUMBERS = st.integers(-4, 4).map(float)


@given(st.lists(st.tuples(st.sampled_from(["<", "<=", ">", ">="]), NUMBERS), min_size=1, max_size=4), st.floats(-5, 5))
def test_beyond_a_limit_an_expression_is_false_and_within_all_it_is_true(links, value):
    text = " and ".join(f"m {operator} {number}" for operator, number in links)
    excess = metric_limits([Expression(text)])["m"].excess(np.array([value]))[0]
    if excess != 0.0:  # a limit itself may be in or out
        assert (excess < 0.0) == (Expression(text).evaluate({"m": value}) == 1.0)


def test_which_end_is_better():
    ends = [(-INFINITY, 3.0), (3.0, INFINITY), (1.0, 3.0)]
    assert [MetricLimits(*each).better for each in ends] == [-1, 1, 0]


def test_the_worst_is_the_first_farthest_beyond_and_no_number_is_worse():
    limits = MetricLimits(1.0, 3.0)
    assert worst_row(np.array([2.0, 2.9, 1.05, 1.05]), limits.excess)[0] == 2
    assert worst_row(np.array([2.0, 9.0, math.nan, math.inf]), limits.excess)[0] == 2


def test_the_worst_of_all_trials():
    rows = TrialTable.of({"trial": np.arange(4), "metric.miss": np.array([2.0, 5.0, 5.0, 7.0])})
    assert worst_trial(rows, "miss", MetricLimits(high=3.0).excess) == (3, 7.0)
    assert worst_trial(rows, "miss", MetricLimits(low=3.0).excess) == (0, 2.0)
