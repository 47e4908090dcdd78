"""`perilune.fmus_src.mathlib.attitude.pursuit`: a direction that follows a moving goal.

Truth: closed forms for a goal at rest (a straight line down to the knee angle limit * response, an exponential after
it) and for a goal that rotates steadily (angle response * rate); scipy's DOP853 at 1e-12 for moving goals, with the law
written as cross products. The order of convergence is measured.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.attitude.pursuit import follow, goal_at
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.lengths import either

START = np.array([0.6, 0.0, 0.8])
BASE = np.array([-0.48, 0.6, 0.64])  # 1.35 rad away
RATE = np.array([0.06, -0.05, 0.11])  # across and along; the goal turns at 0.13 rad/s at first


def unit(values):
    return np.asarray(values) / np.linalg.norm(values)


def angle_between(a, b):
    return 2.0 * math.atan2(np.linalg.norm(np.subtract(a, b)), np.linalg.norm(np.add(a, b)))


def followed(base, rate, end, step, response, limit, start=START):
    """Return directions at the ends of all steps, the start included."""
    direction = vector(*start)
    rows = [np.array(direction)]
    for k in range(round(end / step)):
        direction = follow(direction, vector(*base), vector(*rate), k * step, step, response, limit)
        rows.append(np.array(direction))
    return rows


def integrated(base, rate, end, response, limit, start=START):
    """Integrate the same by DOP853."""

    def slope(s, y):
        goal = unit(np.add(base, np.multiply(rate, s)))
        axis = np.cross(y, goal)  # never 0 here
        angle = angle_between(unit(y), goal)
        speed = min(angle / response if response else math.inf, limit or math.inf)
        return speed * np.cross(axis / np.linalg.norm(axis), y)

    return unit(solve_ivp(slope, (0.0, end), start, method="DOP853", rtol=1e-12, atol=1e-13, max_step=0.02).y[:, -1])


@given(st.floats(0.05, 3.1), st.sampled_from([0.2, 0.5, 2.0]), st.sampled_from([0.02, 0.1]))
@settings(max_examples=either(40, 10), deadline=None)
def test_response_to_a_goal_at_rest_is_exponential(apart, response, step):
    goal = Rotation.from_rotvec([0.0, apart, 0.0]).apply(START)
    rows = followed(goal, np.zeros(3), 1.0, step, response, 0.0)
    for k, row in enumerate(rows):
        left = apart * math.exp(-k * step / response)
        expected = Rotation.from_rotvec([0.0, apart - left, 0.0]).apply(START)
        constant = 0.006 if apart < 1.6 else 0.15  # of the fourth order
        assert row == pytest.approx(expected, abs=1e-12 + constant * apart * (step / response) ** 4)
        assert np.linalg.norm(row) == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize("apart", [0.05, 0.8, 3.0])
def test_response_with_a_limit_is_a_line_and_then_an_exponential(apart):
    response, limit, step = 0.5, 0.2, 0.02
    goal = Rotation.from_rotvec([0.0, apart, 0.0]).apply(START)
    knee = response * limit
    straight = max(0.0, (apart - knee) / limit)
    for k, row in enumerate(followed(goal, np.zeros(3), 20.0, step, response, limit)):
        left = apart - limit * k * step
        if k * step > straight:
            left = min(apart, knee) * math.exp(-(k * step - straight) / response)
        assert angle_between(row, goal) == pytest.approx(left, abs=2e-8)


@pytest.mark.parametrize("apart", [0.03, 0.8, 3.0])
def test_limit_alone_catches_a_goal_at_rest_after_angle_over_limit(apart):
    limit, step = 0.2, 0.07
    goal = Rotation.from_rotvec([0.0, apart, 0.0]).apply(START)
    for k, row in enumerate(followed(goal, np.zeros(3), 21.0, step, 0.0, limit)):
        assert angle_between(row, goal) == pytest.approx(max(0.0, apart - limit * k * step), abs=1e-9)
    assert row == pytest.approx(goal, abs=1e-15)


def test_goal_that_turns_steadily_is_followed_at_response_times_rate():
    """The goal is set again in every step, as a guidance does; started on the steady angle."""
    response, rate, step = 0.5, 0.3, 0.05
    behind = Rotation.from_rotvec([0.0, 0.0, -response * rate])
    direction = vector(*behind.apply([1.0, 0.0, 0.0]))
    for k in range(100):
        turned = rate * step * k
        goal = [math.cos(turned), math.sin(turned), 0.0]
        rates = [-rate * goal[1], rate * goal[0], 0.0]
        # base + rate s turns by atan(rate s): a third-order difference within a step
        direction = follow(direction, vector(*goal), vector(*rates), 0.0, step, response, 0.0)
    turned = rate * step * 100
    assert angle_between(direction, [math.cos(turned), math.sin(turned), 0.0]) == pytest.approx(
        response * rate, abs=3e-6
    )


@pytest.mark.parametrize(
    ("response", "limit", "least"), [(0.5, 0.0, 3.8), (0.5, 0.3, 3.3), (0.2, 0.3, 3.3)], ids=["smooth", "knee", "fast"]
)
def test_moving_goal_follows_dop853_with_fourth_order(response, limit, least):
    end = 8.0
    exact = integrated(BASE, RATE, end, response, limit)
    errors = [np.linalg.norm(followed(BASE, RATE, end, step, response, limit)[-1] - exact) for step in (0.2, 0.1, 0.05)]
    assert errors[-1] < 2e-8
    assert math.log2(errors[0] / errors[-1]) / 2.0 > least


def test_direction_between_the_knee_and_the_goal_follows_dop853():
    """At 4 s the limit has just been left."""
    for end in (3.0, 4.0, 5.0, 6.0):
        exact = integrated(BASE, RATE, end, 0.5, 0.3)
        assert followed(BASE, RATE, end, 0.05, 0.5, 0.3)[-1] == pytest.approx(exact, abs=2e-7)


def test_limit_alone_is_a_pursuit_until_the_goal_is_caught():
    """Before: DOP853. After: the goal itself, as long as it is slower than the limit."""
    rate = 0.2 * RATE
    assert followed(BASE, rate, 3.0, 0.05, 0.0, 0.3)[-1] == pytest.approx(
        integrated(BASE, rate, 3.0, 0.0, 0.3), abs=1e-8
    )
    rows = followed(BASE, rate, 8.0, 0.05, 0.0, 0.3)
    caught = [bool(np.allclose(row, unit(BASE + rate * 0.05 * k), atol=1e-14)) for k, row in enumerate(rows)]
    assert caught[-1]
    assert sorted(caught) == caught  # once caught, for good


def test_goal_faster_than_the_limit_runs_away():
    base, rate = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])  # at 1 rad/s
    rows = followed(base, rate, 1.0, 0.05, 0.0, 0.2, start=base)
    for k, row in enumerate(rows):
        assert row == pytest.approx([math.cos(0.01 * k), math.sin(0.01 * k), 0.0], abs=1e-10)


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.3, 1.0]), st.floats(0.01, 1.0))
@settings(max_examples=either(100, 8), deadline=None)
def test_limit_is_never_exceeded(seed, response, limit):
    generator = np.random.default_rng(seed)
    start, base = unit(generator.normal(size=3)), unit(generator.normal(size=3))
    rows = followed(base, 0.5 * generator.normal(size=3), 2.0, 0.1, response, limit, start)
    for first, second in itertools.pairwise(rows):
        assert angle_between(first, second) <= 0.1 * limit * (1.0 + 1e-9) + 1e-12
        assert np.linalg.norm(second) == pytest.approx(1.0, abs=1e-15)


def test_without_response_and_limit_the_direction_is_the_goal():
    rows = followed(BASE, RATE, 2.0, 0.5, 0.0, 0.0)
    for k, row in enumerate(rows[1:], 1):
        assert row == pytest.approx(unit(BASE + RATE * 0.5 * k), abs=1e-15)


@pytest.mark.parametrize(("response", "limit"), [(0.5, 0.0), (0.5, 0.3), (0.0, 0.3)])
@pytest.mark.parametrize("axis", range(3))
def test_opposite_goal_is_reached(axis, response, limit):
    start = np.eye(3)[axis]
    rows = followed(-start, np.zeros(3), 20.0, 0.1, response, limit, start)
    assert angle_between(rows[0], rows[1]) > 0.02
    assert rows[-1] == pytest.approx(-start, abs=1e-8)  # the exponential's rest


def test_goal_without_direction_leaves_everything():
    otherwise = vector(0.0, 0.6, 0.8)
    assert goal_at(vector(1.0, 0.0, 0.0), vector(-1.0, 0.0, 0.0), 1.0, otherwise) == otherwise
    for response, limit in ((0.5, 0.0), (0.5, 0.3), (0.0, 0.3), (0.0, 0.0)):
        assert followed(np.zeros(3), np.zeros(3), 1.0, 0.5, response, limit)[-1] == pytest.approx(START, abs=1e-15)
