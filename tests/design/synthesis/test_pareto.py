"""Pareto's order.

Truth: the definition, pair by pair; Pareto sets by hand; properties of the order that make early rejection safe.
"""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.design.synthesis.pareto import ParetoOrder, dominators, is_dominated, ranks

VALUES = st.sampled_from([0.0, 1.0, 2.0, 3.0, 5.0, math.inf])  # few, so that many are equal
POINTS = st.integers(1, 3).flatmap(
    lambda width: st.lists(st.tuples(*[VALUES] * width), min_size=1, max_size=12).map(np.array)
)


def dominates(a, b):
    """Evaluate the definition."""
    return all(x <= y for x, y in zip(a, b, strict=True)) and any(x < y for x, y in zip(a, b, strict=True))


@given(POINTS)
def test_ranks_are_numbers_of_dominators(points):
    expected = [sum(dominates(other, point) for other in points) for point in points]
    assert ranks(points).tolist() == expected
    assert [dominators(points, point) for point in points] == expected


@given(POINTS)
def test_who_is_dominated(points):
    for point in points:
        assert is_dominated(points, point).tolist() == [dominates(point, other) for other in points]


def test_a_set_worked_by_hand():
    points = np.array([[1.0, 9.0], [2.0, 4.0], [3.0, 4.0], [8.0, 1.0], [9.0, 9.0], [2.0, 4.0]])
    assert ranks(points).tolist() == [0, 0, 2, 0, 5, 0]
    # ideal point (1, 1), extent of the Pareto set (7, 8): (1, 9) and (8, 1) are at distance 1
    order = ParetoOrder(points)
    np.testing.assert_allclose(order.distances(points)[[0, 1, 3]], [1.0, math.hypot(1 / 7, 3 / 8), 1.0])
    assert order.order().tolist() == [1, 5, 0, 3, 2, 4]
    assert order.worst() == 4


@given(POINTS)
def test_the_order_is_by_rank_first(points):
    order = ParetoOrder(points)
    places = order.order()
    assert sorted(places.tolist()) == list(range(len(points)))
    assert (np.diff(ranks(points)[places]) >= 0).all()
    standings = [order.standing(points[place]) for place in places]
    assert standings == sorted(standings)


@given(POINTS, st.data())
def test_growing_objectives_never_improve_a_standing(points, data):
    """Sums of which some terms are still missing can be rejected safely."""
    order = ParetoOrder(points)
    width = points.shape[1]
    point = np.array(data.draw(st.tuples(*[st.floats(0.0, 6.0)] * width)))
    growth = np.array(data.draw(st.tuples(*[st.floats(0.0, 1e9)] * width)))
    assert order.standing(point + growth) >= order.standing(point)


def test_objectives_that_no_one_reaches_do_not_spoil_the_others():
    points = np.array([[math.inf, 3.0], [math.inf, 2.0]])
    assert ParetoOrder(points).order().tolist() == [1, 0]
