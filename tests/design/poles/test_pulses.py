"""Plants driven by pulses. Truth: an integrator that stops at every switch-off, a zero-order hold, differences."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.signal import cont2discrete

from perilune import modal
from tests.support.lengths import either
from tests.support.modal.draws import random_systems

PERIOD = 0.8


def integrated(rate, state: np.ndarray, lengths: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Integrate the same by scipy, interval by interval."""
    instants = np.unique([0.0, *lengths, PERIOD])
    for begin, end in pairwise(instants):
        on = np.where(lengths > 0.5 * (begin + end), values, 0.0)
        state = solve_ivp(lambda t, x, on=on: rate(x, on), (begin, end), state, "DOP853", rtol=1e-12, atol=1e-13).y[
            :, -1
        ]
    return state


@given(st.lists(st.sampled_from([0.0, 0.2, 0.5, PERIOD]), min_size=3, max_size=3), st.integers(0, 2**32 - 1))
@settings(max_examples=either(60, 8))
def test_linear_plants_are_exact(lengths: list[float], seed: int) -> None:
    a, b, _, _ = next(random_systems(1, 4, 3, seed=seed))
    random = np.random.default_rng(seed)
    state, values, tau = random.normal(size=4), random.normal(size=3), np.array(lengths)
    plant = modal.PulsedPlant.of(a, b, PERIOD)
    expected = integrated(lambda x, u: a @ x + b @ u, state, tau, values)
    np.testing.assert_allclose(plant.after(state, tau, values), expected, atol=1e-9 * (1.0 + np.max(np.abs(expected))))


def test_a_whole_tick_is_a_zero_order_hold_and_none_is_free() -> None:
    a, b, c, _ = next(random_systems(1, 4, 2))
    transition, held, *_ = cont2discrete((a, b, c, np.zeros((1, 2))), PERIOD)
    plant = modal.PulsedPlant.of(a, b, PERIOD)
    np.testing.assert_allclose(plant.transition, transition, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(plant.after(np.zeros(4), [PERIOD] * 2, [2.0, -3.0]), held @ [2.0, -3.0], rtol=1e-11)
    np.testing.assert_array_equal(plant.after(np.ones(4), [0.0, 0.0], [2.0, -3.0]), plant.transition @ np.ones(4))


def test_derivatives_by_differences() -> None:
    a, b, _, _ = next(random_systems(1, 4, 3, seed=1))
    plant = modal.PulsedPlant.of(a, b, PERIOD)
    state, tau, values = np.array([1.0, -2.0, 0.5, 0.3]), np.array([0.1, 0.4, 0.7]), np.array([1.0, -2.0, 3.0])
    h = 1e-5
    for i in range(3):
        step = h * np.eye(3)[i]
        central = (plant.after(state, tau + step, values) - plant.after(state, tau - step, values)) / (2.0 * h)
        np.testing.assert_allclose(plant.by_lengths(tau, values)[:, i], central, atol=1e-8)
    for i in range(4):
        moved = plant.after(state + np.eye(4)[i], tau, values) - plant.after(state, tau, values)
        np.testing.assert_allclose(plant.transition[:, i], moved, atol=1e-12)


def pendulum(x: np.ndarray, u: np.ndarray) -> np.ndarray:
    return np.array([x[1], -np.sin(x[0]) + u[0] - 0.3 * u[1] * np.cos(x[0])])


def test_nonlinear_plants_are_of_fourth_order_across_switch_offs() -> None:
    state, tau, values = np.array([0.5, -0.2]), np.array([0.13, 0.61]), np.array([2.0, -3.0])
    exact = integrated(pendulum, state, tau, values)
    errors = [
        np.max(np.abs(modal.pulsed_step(pendulum, state, tau, values, PERIOD, longest=h) - exact))
        for h in (0.05, 0.025, 0.0125)
    ]
    assert errors[0] < 1e-6
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 4.0, atol=0.5)


def test_the_derivative_at_rest_is_the_linear_one() -> None:
    a, b = np.array([[0.0, 1.0], [-1.0, 0.0]]), np.array([[0.0, 0.0], [1.0, -0.3]])
    plant = modal.PulsedPlant.of(a, b, 0.2)
    h = 1e-4
    for i in range(2):
        ends = [
            modal.pulsed_step(pendulum, sign * h * np.eye(2)[i], [0.1, 0.05], [0.0, 0.0], 0.2, longest=0.01)
            for sign in (1, -1)
        ]
        np.testing.assert_allclose((ends[0] - ends[1]) / (2.0 * h), plant.transition[:, i], atol=2e-9)


def test_what_is_no_pulse() -> None:
    plant = modal.PulsedPlant.of(np.eye(2), np.eye(2), 0.2)
    for lengths, values, problem in (
        ([0.1, 0.3], [1.0, 1.0], "lengths: a pulse lasts 0.3 s; give 0 to 0.2 s, the tick"),
        ([-0.1, 0.1], [1.0, 1.0], "lengths: a pulse lasts -0.1 s; give 0 to 0.2 s, the tick"),
        ([0.1], [1.0, 1.0], "lengths: is 1; give 2 numbers"),
        ([0.1, 0.1], [1.0], "values: is 1; give 2 numbers"),
    ):
        with pytest.raises(ValueError, match=problem):
            plant.after([0.0, 0.0], lengths, values)
    with pytest.raises(ValueError, match="state: is 3; give 2 numbers"):
        plant.after([0.0, 0.0, 0.0], [0.1, 0.1], [1.0, 1.0])
    with pytest.raises(ValueError, match="period: is 0 s; give a time above 0"):
        modal.PulsedPlant.of(np.eye(2), np.eye(2), 0.0)
    with pytest.raises(ValueError, match="longest: is 0 s; give a time above 0"):
        modal.pulsed_step(pendulum, [0.0, 0.0], [0.1], [1.0], 0.2, longest=0.0)
