"""Distance of a trial from failure, by the expression that defines the failure.

Truth: the value of the expression; differences written out here.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.studies.failure import Failure, failure_of
from perilune.common.errors import InputError

METRICS = """
[metric.miss]
expression = "1"
reduction = "final"
[draw.mass]
distribution = "normal"
mean = 940
sigma = 5
"""
WRITTEN = {
    "a > b": lambda a, b, c: a - b,
    "a < b": lambda a, b, c: b - a,
    "not a > b": lambda a, b, c: b - a,
    "a > b or c > 1": lambda a, b, c: np.maximum(a - b, c - 1),
    "a > b and c > 1": lambda a, b, c: np.minimum(a - b, c - 1),
    "not (a > b and c > 1)": lambda a, b, c: np.maximum(b - a, 1 - c),
    "not (a > b or not c > 1)": lambda a, b, c: np.minimum(b - a, c - 1),
    "b < a < c": lambda a, b, c: np.minimum(a - b, c - a),
    "not (b <= a <= c)": lambda a, b, c: np.maximum(b - a, a - c),
    "a != b": lambda a, b, c: np.abs(a - b),
    "a == b": lambda a, b, c: -np.abs(a - b),
    "2 * a - b": lambda a, b, c: np.abs(2 * a - b),
}
VALUES = st.lists(st.sampled_from([-2.0, -1.0, 0.0, 0.5, 1.0, 3.0, 1e-300, -1e-300]), min_size=1, max_size=20)


@pytest.mark.parametrize("text", WRITTEN)
def test_the_margin_is_the_difference(text):
    values = dict(zip("abc", np.random.default_rng(1).normal(size=(3, 50)), strict=True))
    actual = Failure(Expression(text)).margins(values, np.ones(50, dtype=bool))
    np.testing.assert_allclose(actual, WRITTEN[text](**values), rtol=1e-14)


@given(st.sampled_from([*WRITTEN, "a >= b", "a <= b and not c", "not (a == b) or c >= a", "where(c > 0, a, b) > 1"]),
       VALUES, VALUES, VALUES)  # fmt: skip
def test_a_margin_of_0_or_more_is_a_failure_and_no_other(text, a, b, c):
    count = min(len(a), len(b), len(c))
    values = {name: np.array(column[:count]) for name, column in zip("abc", (a, b, c), strict=True)}
    failure = Failure(Expression(text))
    expression = Expression(text)
    actual = failure.margins({name: values[name] for name in "abc"}, np.ones(count, dtype=bool))
    expected = np.broadcast_to(expression.evaluate(values), (count,)) != 0.0
    assert ((actual >= 0.0) == expected).all(), text


def test_what_is_not_finite_is_a_failure():
    a = np.array([np.nan, np.inf, -np.inf, 1.0, 1.0, 0.0])
    flown = np.array([True, True, True, True, False, True])
    actual = Failure(Expression("a > 2")).margins({"a": a}, flown)
    assert actual.tolist() == [np.inf, np.inf, np.inf, -1.0, np.inf, -2.0]
    assert Failure(Expression("1 / a - 1 / a > 2")).margins({"a": a[-1:]}, flown[-1:]).tolist() == [np.inf]


def test_a_campaign_fails_where_it_has_no_success(campaign):
    created = campaign(METRICS)
    assert failure_of(created, None).text == "not (1)"
    assert failure_of(created, "miss > 2 and mass < 930").names == {"miss", "mass"}
    with pytest.raises(InputError, match="failure: moss: neither a metric nor a draw of the campaign; use one of"):
        failure_of(created, "moss > 2")
    with pytest.raises(InputError, match="failure"):
        failure_of(created, "miss >")
