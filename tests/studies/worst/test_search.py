"""Search for the largest value in a cube.

Truth: functions whose largest value is known; the largest of ten times as many random points.
"""

import numpy as np
import pytest

from perilune.analysis.studies.worst.search import largest

PEAK = np.array([0.7, 0.2, 0.45, 0.9, 0.05])


def corner(x):
    return x @ np.array([3.0, -2.0, 1.0, 0.5, -1.0])


def smooth(x):
    return -np.sum((x - PEAK) ** 2, axis=1)


def ripples(x):
    """Evaluate Rastrigin's function, its least of 0 at PEAK: many local peaks."""
    z = 4.0 * (x - PEAK)
    return -np.sum(z**2 + 10.0 * (1.0 - np.cos(2.0 * np.pi * z)), axis=1)


def valley(x):
    """Evaluate a function low in the middle of every edge: local peaks in all corners, the
    highest of them (0, 1, 0, 1, 0)."""
    return np.sum((x - np.array([0.51, 0.49, 0.51, 0.49, 0.51])) ** 2, axis=1)


def stairs(x):
    return np.floor(20.0 * smooth(x))


def actual(function, evaluations=1600, seed=1):
    random = np.random.default_rng(seed)
    points = random.random((200, 5))
    spent = [0]

    def counted(places):
        assert ((places >= 0.0) & (places <= 1.0)).all()
        spent[0] += len(places)
        return function(places)

    point, value, phases = largest(counted, points, function(points), evaluations, random)
    assert spent[0] <= evaluations
    assert sum(phase.evaluations for phase in phases) == spent[0]
    assert function(point[None])[0] == value
    return point, value


@pytest.mark.parametrize(
    ("function", "truth", "tolerance"),
    [(corner, 4.5, 1e-6), (smooth, 0.0, 1e-6), (ripples, 0.0, 6.0), (valley, 5 * 0.51**2, 1e-6), (stairs, -1.0, 0)],
)
def test_the_largest_value(function, truth, tolerance):
    _, value = actual(function)
    assert truth - tolerance <= value <= truth
    many = function(np.random.default_rng(2).random((18000, 5)))
    assert value >= many.max()


def test_the_same_random_numbers_give_the_same_point():
    assert actual(ripples)[0].tobytes() == actual(ripples)[0].tobytes()


def test_what_is_infinite_ends_the_search():
    calls = []

    def function(x):
        calls.append(len(x))
        return np.where(x[:, 0] > 0.9, np.inf, x[:, 1])

    start = np.array([[0.5, 0.5]])
    point, value, _ = largest(function, start, np.array([0.5]), 2000, np.random.default_rng(3))
    assert value == np.inf
    assert point[0] > 0.9
    assert sum(calls) < 100


@pytest.mark.parametrize("evaluations", [0, 1, 10, 50])
def test_few_evaluations(evaluations):
    point, value = actual(smooth, evaluations)
    assert value >= smooth(np.random.default_rng(1).random((200, 5))).max()
    assert point.shape == (5,)
