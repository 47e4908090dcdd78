"""Draws as independent standard normal variables and as a box, and inverse maps.

Truth: scipy's distributions; the declared covariance; the inverse maps.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from perilune.analysis.studies.draw_space import DrawSpace
from perilune.common.errors import InputError

COVARIANCE = [[4.0, 1.2, 0.0], [1.2, 1.0, -0.3], [0.0, -0.3, 0.5]]
RANDOM = f"""
[draw.angle]
distribution = "uniform"
low = -3
high = 5
[draw.mass]
distribution = "normal"
mean = 940
sigma = 5
[draw.errors]
distribution = "correlated_normal"
names = ["x", "y", "z"]
mean = [1, 2, 3]
covariance = {COVARIANCE}
[draw.even]
distribution = "sobol"
low = 0
high = 2
"""
CHOICE = '[draw.mode]\ndistribution = "choice"\nvalues = [1, 2, 4]\n'
GRID = '[draw.case]\ndistribution = "grid"\nvalues = [10, 20]\n'


@pytest.fixture
def space(campaign):
    return DrawSpace(campaign(RANDOM))


def test_the_distributions_are_those_that_are_declared(space):
    columns = space.from_normals(np.random.default_rng(4).standard_normal((20000, 6)))
    assert space.size == 6
    assert list(columns) == ["angle", "mass", "x", "y", "z", "even"]
    for name, truth in {
        "angle": stats.uniform(-3, 8),
        "mass": stats.norm(940, 5),
        "x": stats.norm(1, 2),
        "even": stats.uniform(0, 2),
    }.items():
        assert stats.kstest(columns[name], truth.cdf).pvalue > 0.01, name
    actual = np.cov([columns[name] for name in "xyz"])
    np.testing.assert_allclose(actual, COVARIANCE, atol=0.1)
    others = np.corrcoef([columns[name] for name in columns])[:2, 2:]
    assert np.abs(others).max() < 0.03


@given(st.lists(st.floats(-7.0, 7.0), min_size=6, max_size=6))
def test_normals_and_back(campaign, u):
    space = DrawSpace(campaign(RANDOM))
    points = np.array([u])
    back = space.to_normals(space.from_normals(points))
    np.testing.assert_allclose(back, points, atol=2e-3, rtol=0)  # at 7 sigmas the ends' rounding shows
    middle = np.clip(points, -4.0, 4.0)
    np.testing.assert_allclose(space.to_normals(space.from_normals(middle)), middle, atol=1e-9)


@given(st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6))
def test_box_and_back(campaign, places):
    space = DrawSpace(campaign(RANDOM))
    points = np.array([places])
    columns = space.from_box(points, 3.0)
    np.testing.assert_allclose(space.to_box(columns, 3.0), points, atol=1e-10)
    assert -3 <= columns["angle"][0] <= 5
    assert 925 <= columns["mass"][0] <= 955
    offset = np.array([columns[name][0] for name in "xyz"]) - [1, 2, 3]
    distance = np.sqrt(offset @ np.linalg.solve(COVARIANCE, offset))  # Mahalanobis'
    assert distance <= 3.0 * np.sqrt(3.0) * (1 + 1e-9)


def test_the_far_tail_of_an_interval_is_kept(space):
    u = np.zeros((2, 6))
    u[:, 5] = [-10.0, 10.0]
    even = space.from_normals(u)["even"]
    assert even[0] == pytest.approx(2 * stats.norm.cdf(-10.0), rel=1e-12)
    assert even[1] == 2.0


def test_a_flat_covariance_has_fewer_coordinates(campaign):
    text = """[draw.pair]
distribution = "correlated_normal"
names = ["a", "b"]
mean = [0, 1]
covariance = [[1, 2], [2, 4]]
"""
    space = DrawSpace(campaign(text))
    assert space.size == 1
    columns = space.from_normals(np.linspace(-3, 3, 7)[:, None])
    np.testing.assert_allclose(columns["b"] - 1, 2 * columns["a"], atol=1e-12)
    np.testing.assert_allclose(np.abs(columns["a"]), np.abs(np.linspace(-3, 3, 7)), atol=1e-12)
    assert not space.independent


def test_held_draws_have_one_value(campaign):
    space = DrawSpace(campaign(RANDOM + CHOICE + GRID), {"mode": 4, "case": 10, "mass": 900})
    assert space.size == 5
    assert space.names == ["angle", "x", "y", "z", "even"]
    columns = space.from_normals(np.zeros((3, 5)))
    assert columns["mode"].tolist() == [4, 4, 4]
    assert columns["mass"].tolist() == [900, 900, 900]
    np.testing.assert_allclose(columns["angle"], 1.0)
    assert list(columns) == ["angle", "mass", "x", "y", "z", "even", "mode", "case"]


@pytest.mark.parametrize(
    ("text", "held", "words"),
    [
        (CHOICE, {}, "draw.mode: a choice has discrete values.*hold this draw: hold mode=1"),
        (GRID, {}, "draw.case: a grid has discrete values"),
        (RANDOM + CHOICE, {"mode": 3}, "hold: mode: 3 is not one of its values; use 1, 2, 4"),
        (RANDOM, {"x": 1}, "hold: x: is drawn together with y, z; hold all of them or none"),
        (RANDOM, {"moss": 1}, "hold: moss: test.toml does not draw this value.*mass"),
        (CHOICE, {"mode": 1}, "no draw varies"),
    ],
)
def test_refusals(campaign, text, held, words):
    with pytest.raises(InputError, match=words):
        DrawSpace(campaign(text), held)
