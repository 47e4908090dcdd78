"""Pole placement by feedback of the state's derivative.

Truth: the closed loop's pencil (A, I + B K) by scipy; for one input the gain on the state of scipy's place_poles, times
the inverse of its closed loop; a motion with lagged feedback of the derivative, integrated by scipy.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigvals
from scipy.signal import place_poles

from perilune import modal
from tests.support.lengths import either
from tests.support.modal.draws import EPS, kappa_of, pole_error, random_systems

COUNT = either(50, 6)


@pytest.mark.parametrize(("states", "inputs"), [(4, 1), (4, 2), (5, 2), (6, 3), (8, 4)])
def test_the_pencil_has_the_poles(states: int, inputs: int) -> None:
    errors = []
    for a, b, _, poles in random_systems(COUNT, states, inputs, seed=21):
        actual = modal.place_derivative(a, b, poles)
        inverted = np.linalg.inv(actual.closed_loop)  # what is placed, and what its rounding moves
        bound = 1e3 * EPS * kappa_of(inverted) * np.linalg.norm(inverted, 2) * np.max(np.abs(poles)) ** 2
        bound *= np.linalg.cond(a)
        pencil = eigvals(a, np.eye(states) + b @ actual.gain)
        apart = np.abs(pencil[:, None] - poles[None, :]).min(axis=0)
        assert np.max(apart) <= bound
        errors.append(pole_error(actual.closed_loop, poles))
        assert errors[-1] <= bound
    assert np.median(errors) < 1e-8


def test_one_input_has_one_gain() -> None:
    """K = Kx (A - b Kx)^-1 with Kx of scipy: rounding only."""
    for a, b, _, poles in random_systems(COUNT, 4, 1, seed=22):
        state = place_poles(a, b, poles).gain_matrix
        expected = state @ np.linalg.inv(a - b @ state)
        np.testing.assert_allclose(modal.place_derivative(a, b, poles).gain, expected, rtol=1e-6)


def test_a_mass_on_a_spring() -> None:
    """x'' = -x + u, u = -k1 x' - k2 x'': (1 + k2) s^2 + k1 s + 1 = c (s + 1)(s + 2) for c = 1/2."""
    actual = modal.place_derivative([[0.0, 1.0], [-1.0, 0.0]], [[0.0], [1.0]], [-1.0, -2.0])
    np.testing.assert_allclose(actual.gain, [[1.5, -0.5]], atol=1e-14)
    np.testing.assert_allclose(actual.fast, [0.5], atol=1e-14)
    assert actual.stands_lag


def lagged(a: np.ndarray, b: np.ndarray, gain: np.ndarray, lag: float, time: float) -> float:
    """Return the growth of a motion under lag u' = -u - K x'."""
    states = len(a)

    def rate(_: float, s: np.ndarray) -> np.ndarray:
        derivative = a @ s[:states] + b @ s[states:]
        return np.concatenate([derivative, (-s[states:] - gain @ derivative) / lag])

    start = np.concatenate([np.ones(states), np.zeros(b.shape[1])])
    end = solve_ivp(rate, (0.0, time), start, method="LSODA", rtol=1e-8).y[:, -1]
    return float(np.linalg.norm(end) / np.linalg.norm(start))


def test_one_unstable_pole_and_one_input_stand_no_lag() -> None:
    """An inverted pendulum: (1 + k2) has the sign that the lag does not stand."""
    a, b = np.array([[0.0, 1.0], [1.0, 0.0]]), np.array([[0.0], [1.0]])
    actual = modal.place_derivative(a, b, [-1.0, -2.0])
    assert pole_error(actual.closed_loop, np.array([-1.0, -2.0])) < 1e-14
    assert not actual.stands_lag
    assert lagged(a, b, actual.gain, 0.1, 3.0) > 10.0


def test_two_unstable_poles_and_two_inputs_may() -> None:
    """Two inverted pendulums: separate poles stand no lag, modes that turn one into the other do."""
    a, b = np.kron([[0.0, 1.0], [1.0, 0.0]], np.eye(2)), np.kron([[0.0], [1.0]], np.eye(2))
    separate = modal.place_derivative(a, b, [-1.0, -1.0, -2.0, -2.0])
    assert not separate.stands_lag
    # x1 + i x2 = z with (s + 1 - 1.7 i)^2, a gain on the state: z'' = z - (1 + (1 - 1.7 i)^2) z - 2 (1 - 1.7 i) z'
    spring, damper = 1.0 + (1.0 - 1.7j) ** 2, 2.0 * (1.0 - 1.7j)
    state = np.hstack([[[g.real, -g.imag], [g.imag, g.real]] for g in (spring, damper)])
    gain = state @ np.linalg.inv(a - b @ state)
    assert np.all(np.linalg.eigvals(np.eye(2) + gain @ b).real > 0.0)
    assert lagged(a, b, gain, 1e-3, 8.0) < 0.1
    assert lagged(a, b, separate.gain, 1e-3, 0.1) > 10.0


def test_a_singular_plant_is_refused() -> None:
    with pytest.raises(modal.PlacementError, match="A is singular: its smallest singular value is 0 times") as caught:
        modal.place_derivative([[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0]], [-1.0, -2.0])
    assert caught.value.reason is modal.Reason.SINGULAR
    assert caught.value.number == 0.0


def test_a_pole_at_zero_is_refused() -> None:
    with pytest.raises(modal.PlacementError.__mro__[1], match="poles: a pole is 0"):
        modal.place_derivative([[0.0, 1.0], [-1.0, 0.0]], [[0.0], [1.0]], [-1.0, 0.0])
