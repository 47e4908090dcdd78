"""Disk margins of several loops. Truth: python-control for one loop, and poles of perturbed loops."""

from __future__ import annotations

import control
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from perilune.analysis.stability.loops.disk import disk_margins, joint_disk_margin
from perilune.analysis.stability.loops.margins import robust
from tests.support.lengths import either
from tests.support.loops.sampled_loops import delay, held, nearest_to_circle, outside, random_loops, response_of

S = control.tf("s")
# The spinning satellite that is robust loop by loop and not in both at once (python-control's own example), sampled.
SPINNING = control.c2d(
    control.ss([[0, 10], [-10, 0]], np.eye(2), [[1, 10], [-10, 1]], 0) * control.ss([], [], [], [[1, -2], [0, 1]]), 1e-3
)


def coupled() -> control.StateSpace:
    one = held(0.3 * (S + 0.1) / S**2, 1.0) * delay(1, 1.0)
    two = held(0.2 / S, 1.0) * delay(2, 1.0)
    return control.append(one, two) * control.ss([], [], [], [[1.0, 0.4], [-0.3, 0.8]], 1.0)


@pytest.mark.parametrize("system", [coupled(), SPINNING])
def test_two_coupled_loops_equal_python_control(system: control.StateSpace) -> None:
    high = np.pi / system.dt
    actual = joint_disk_margin(response_of(system), 1e-3 * high, high)
    # python-control takes S from the closed loop's state space, we from the response of the open one
    alphas, gains, phases = control.disk_margins(system, actual.frequencies, returnall=True)
    np.testing.assert_allclose(actual.alphas, alphas, rtol=1e-9)
    worst = int(np.argmin(actual.alphas))
    assert actual.alpha == actual.alphas[worst]
    assert actual.frequency == actual.frequencies[worst]
    assert 20 * np.log10(actual.gain) == pytest.approx(gains[worst], rel=1e-9)
    assert np.degrees(actual.phase) == pytest.approx(phases[worst], rel=1e-9)
    fine = np.linspace(max(0.98 * actual.frequency, 1e-3 * high), min(1.02 * actual.frequency, high), 201)
    assert np.min(control.disk_margins(system, fine, returnall=True)[0]) >= actual.alpha * (1.0 - 1e-9)


def three_coupled() -> control.StateSpace:
    loops = [held(gain * (S + 0.1) / S**2, 1.0) * delay(1, 1.0) for gain in (0.3, 0.2, 0.1)]
    return control.append(*loops) * control.ss([], [], [], [[1.0, 0.4, -0.2], [-0.3, 0.8, 0.1], [0.2, -0.5, 0.9]], 1.0)


def test_three_coupled_loops_equal_python_control() -> None:
    system = three_coupled()
    actual = joint_disk_margin(response_of(system), 1e-2, np.pi)
    assert outside(system) == 0
    # the precision is that of the reference, SLICOT's AB13MD
    alphas = control.disk_margins(system, actual.frequencies[::5], returnall=True)[0]
    np.testing.assert_allclose(actual.alphas[::5], alphas, rtol=1e-7)
    fine = np.linspace(0.98 * actual.frequency, 1.02 * actual.frequency, 21)
    assert np.min(control.disk_margins(system, fine, returnall=True)[0]) >= actual.alpha * (1.0 - 1e-7)


@given(random_loops())
@settings(max_examples=either(10, 5))
def test_one_loop_equals_the_closed_form(system: control.StateSpace) -> None:
    assume(nearest_to_circle(system) > 1e-2)
    low, high, single = 1e-3 / system.dt, np.pi / system.dt, response_of(system)
    actual = joint_disk_margin(lambda frequency: single(frequency)[:, None, None], low, high)
    expected = robust(single, low, high)
    assert actual.alpha == pytest.approx(expected.disk_margin, rel=1e-8)
    assert actual.gain == pytest.approx(expected.disk_gain, rel=1e-7)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=either(15, 5))
def test_loops_without_coupling_have_the_least_of_their_margins(seed: int) -> None:
    random = np.random.default_rng(seed)
    values = random.normal(size=(4, 3)) + 1j * random.normal(size=(4, 3))
    joint = disk_margins(np.array([np.diag(row) for row in values]))
    np.testing.assert_allclose(joint, np.min(1.0 / np.abs(1.0 / (1.0 + values) - 0.5), axis=1), rtol=1e-9)


def test_no_gain_or_phase_within_the_disk_makes_the_loops_unstable_and_one_on_it_does() -> None:
    system = coupled()
    response = response_of(system)
    actual = joint_disk_margin(response, 1e-3, np.pi)
    assert outside(system) == 0
    random = np.random.default_rng(1)
    for _ in range(300):
        turned = 0.5 * actual.alpha * 0.999 * np.exp(1j * random.uniform(-np.pi, np.pi, 2))
        factors = (1.0 + turned) / (1.0 - turned)
        perturbed = system.A - system.B @ np.linalg.solve(
            np.eye(2) + np.diag(factors) @ system.D, np.diag(factors) @ system.C
        )
        assert np.all(np.abs(np.linalg.eigvals(perturbed)) < 1.0)
    # on the disk's rim, at its frequency, some pair of factors leaves I + diag(f) L singular
    value = response(np.array([actual.frequency]))[0]
    angles = np.linspace(-np.pi, np.pi, 721)
    rim = 0.5 * actual.alpha * np.exp(1j * angles)
    rim = (1.0 + rim) / (1.0 - rim)
    # det = 1 + f1 L11 + f2 L22 + f1 f2 det L = 0 solved for f2, whose place relative to the rim changes with f1
    determinant = np.linalg.det(value)
    second = -(1.0 + rim * value[0, 0]) / (value[1, 1] + rim * determinant)
    assert np.min(np.abs(2.0 * (second - 1.0) / (second + 1.0))) == pytest.approx(actual.alpha, rel=1e-4)
