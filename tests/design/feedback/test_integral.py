"""Pole placement with integrals of the outputs.

Truth: a PID in closed form; motions by scipy's matrix exponential with a disturbance and a plant that differ from the
design, whose steady state solves linear equations; zeros of the plant's transfer function.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from perilune import modal
from tests.support.lengths import either
from tests.support.modal.draws import assert_placed, random_spectrum, random_systems

COUNT = either(50, 6)


def test_a_mass_has_a_pid() -> None:
    """(s + 1)^3: u = -3 x - 3 x' - integral."""
    actual = modal.place_integral([[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0]], [[1.0, 0.0]], [-1.0] * 3)
    np.testing.assert_allclose(actual.on_state, [[3.0, 3.0]], atol=1e-13)
    np.testing.assert_allclose(actual.on_integral, [[1.0]], atol=1e-13)


@pytest.mark.parametrize(("states", "inputs", "outputs"), [(4, 1, 1), (4, 2, 1), (5, 2, 2), (6, 3, 3)])
def test_places_every_draw(states: int, inputs: int, outputs: int) -> None:
    random = np.random.default_rng(71)
    for a, b, c, _ in random_systems(COUNT, states, inputs, outputs, seed=24):
        poles = random_spectrum(random, states + outputs, outputs)
        actual = modal.place_integral(a, b, c, poles)
        loop = np.block([[a - b @ actual.on_state, -b @ actual.on_integral], [c, np.zeros((outputs, outputs))]])
        assert_placed(loop, poles)


@pytest.mark.parametrize("sampled", [False, True])
def test_outputs_come_to_rest_at_the_reference(sampled: bool) -> None:
    """Under disturbances that nobody knows, and with a plant 2 % off."""
    random = np.random.default_rng(72)
    a, b = (
        np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.3], [0.2, 0.0, -0.5]]),
        np.array([[0.0, 0.0], [1.0, 0.0], [0.2, 1.0]]),
    )
    c = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    if sampled:
        both = expm(0.2 * np.block([[a, b], [np.zeros((2, 5))]]))
        a, b = both[:3, :3], both[:3, 3:]
    poles = [0.6, 0.65, 0.7, 0.75, 0.8] if sampled else [-1.0, -1.2, -1.4, -1.6, -2.0]
    actual = modal.place_integral(a, b, c, poles, sampled=sampled)
    for _ in range(COUNT):
        plant, disturbance, reference = a * random.uniform(0.98, 1.02, a.shape), *random.normal(size=(2, 3))
        closed = np.block([[plant - b @ actual.on_state, -b @ actual.on_integral], [c, sampled * np.eye(2)]])
        forcing = np.concatenate([disturbance, -reference[:2]])
        if sampled:
            state = np.zeros(5)
            for _ in range(400):
                state = closed @ state + forcing
        else:
            state = (expm(60.0 * np.block([[closed, forcing[:, None]], [np.zeros((1, 6))]])) @ np.eye(6)[5])[:5]
        np.testing.assert_allclose(c @ state[:3], reference[:2], atol=1e-9)


def test_without_integrals_a_disturbance_leaves_an_error() -> None:
    """The error that `place` leaves is A_c^-1 E d; with integrals there is none."""
    a, b, c = np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]]), np.array([[1.0, 0.0]])
    gain = modal.place(a, b, [-1.0, -1.0]).gain
    assert (c @ np.linalg.solve(a - b @ gain, -b)).item() == pytest.approx(1.0)
    loop = modal.place_integral(a, b, c, [-1.0] * 3).closed_loop
    assert np.linalg.solve(loop, -np.array([0.0, 1.0, 0.0]))[0] == pytest.approx(0.0, abs=1e-14)


def test_a_zero_at_rest_is_refused() -> None:
    """s/(s + 1)^2: the input does not move the output at rest."""
    with pytest.raises(modal.PlacementError, match="the plant has a zero at s = 0") as caught:
        modal.place_integral([[0.0, 1.0], [-1.0, -2.0]], [[0.0], [1.0]], [[0.0, 1.0]], [-1.0] * 3)
    assert caught.value.reason is modal.Reason.RANK
    with pytest.raises(modal.PlacementError, match="no more outputs than there are inputs"):
        modal.place_integral([[0.0, 1.0], [-1.0, -2.0]], [[0.0], [1.0]], np.eye(2), [-1.0] * 4)


def test_a_sampled_zero_at_rest_is_refused() -> None:
    with pytest.raises(modal.PlacementError, match="the plant has a zero at s = 0"):
        modal.place_integral([[0.0, 1.0], [-0.25, 1.0]], [[0.0], [1.0]], [[-1.0, 1.0]], [0.5] * 3, sampled=True)
