"""Lifted model of a periodic system: frequency response, multipliers, removable states, states of a cut.

Truth: simulations of plain recurrences; python-control's state spaces for time-invariant systems sampled several times
per period; matrices with obvious modes.
"""

import control
import numpy as np
import pytest

from perilune.analysis.stability.point.lifted import LiftedModel, SampledChannel, reachable
from perilune.analysis.stability.point.modes import modes, structure
from perilune.analysis.stability.request.channels import Channel
from tests.support.loops.exact_periodic import STATES, exact_model, flown_response, hyperperiod
from tests.support.loops.sampled_loops import held, response_of


def port(count, seconds=0.5, first=0):
    return SampledChannel(Channel("c", "c", ("c.y",), None, None, 1, None, None), seconds, first, count)


def lasting(values):
    return np.sort_complex(values[abs(values) > 1e-9])


def lifted(loop, samples):
    """Return the closed loop of a state space over several of its samples."""
    back = np.linalg.solve(np.eye(loop.ninputs) + loop.D, np.hstack([-loop.C, -loop.D]))
    c, d = back[:, : loop.nstates], back[:, loop.nstates :]  # v = c x + d (what is added)
    a, b = loop.A + loop.B @ c, loop.B @ (np.eye(loop.ninputs) + d)
    powers = [np.linalg.matrix_power(a, index) for index in range(samples + 1)]
    cv = np.vstack([c @ power for power in powers[:-1]])
    dv = np.block(
        [
            [c @ powers[row - column - 1] @ b if row > column else d * (row == column) for column in range(samples)]
            for row in range(samples)
        ]
    )
    whole = np.hstack([power @ b for power in reversed(powers[:-1])])
    return LiftedModel(
        powers[-1], whole, cv, dv + np.eye(samples), cv, dv, (), samples * loop.dt, (port(samples, loop.dt),)
    )


@pytest.fixture(scope="module")
def periodic():
    return exact_model()


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize(("cycles", "samples"), [(1, 24), (5, 24), (11, 30)])
def test_response_is_what_a_flight_with_a_wave_shows(periodic, axis, cycles, samples):
    place = periodic.ports[axis]
    frequency = 2.0 * np.pi * cycles / samples / place.seconds
    actual = periodic.response((place,), np.array([frequency]))
    assert actual.shape == (1, 1, 1)
    assert actual[0, 0, 0] == pytest.approx(flown_response(axis, cycles, samples), rel=1e-11)


def test_a_periodic_loop_answers_at_other_frequencies_too(periodic):
    place, frequency = periodic.ports[0], np.array([0.8])
    assert periodic.periodicity(place, frequency) > 1e-4
    u, v = periodic.disturbance_response((place,), frequency)
    assert abs(u - v - 1.0).max() < 1e-12  # what goes in is what comes back and what is added


@pytest.mark.parametrize("samples", [1, 3, 4])
def test_a_time_invariant_loop_over_several_samples_is_its_transfer_function(samples):
    loop = control.ss(0.5, 1.0, 0.3, 0.6, 0.5) * held(control.tf([1.0], [1.0, 0.4, 0.0]), 0.5)
    model = lifted(loop, samples)
    frequency = np.geomspace(1e-3, 1.0, 30) * np.pi / loop.dt
    actual = model.response(model.ports, frequency)[:, 0, 0]
    assert actual == pytest.approx(response_of(loop)(frequency), rel=1e-9)
    assert model.periodicity(model.ports[0], frequency[::8]) < 1e-12
    closed = np.linalg.eigvals(loop.A - loop.B @ np.linalg.solve(np.eye(1) + loop.D, loop.C))
    assert np.sort_complex(model.poles()) == pytest.approx(np.sort_complex(closed**samples), abs=1e-12)
    poles = model.open_loops(model.ports)
    assert lasting(poles) == pytest.approx(lasting(np.linalg.eigvals(loop.A) ** samples), abs=1e-7)


def test_multipliers(periodic):
    values = np.linalg.eigvals(periodic.a)
    assert lasting(periodic.poles()) == pytest.approx(lasting(values), abs=1e-10)
    assert len(periodic.poles()) == 6  # of 10 memory cells
    assert (abs(np.diff(abs(periodic.poles()))) < 1e-9).sum() == 3  # conjugates side by side, largest first
    assert periodic.unstable() == 0


@pytest.mark.parametrize("axis", [0, 1])
def test_multipliers_with_one_cut_open(periodic, axis):
    """The open axis drifts: a double pole at 1, which rounding splits by its square root."""
    state, _, _ = hyperperiod((axis,))
    actual, expected = periodic.open_loops((periodic.ports[axis],)), np.linalg.eigvals(state[:, :STATES])
    assert lasting(actual) == pytest.approx(lasting(expected), abs=1e-6)
    both, expected = periodic.open_loops(periodic.ports), np.linalg.eigvals(hyperperiod((0, 1))[0][:, :STATES])
    assert lasting(both) == pytest.approx(lasting(expected), abs=1e-6)


def test_sampled_at_once_two_ports_are_a_matrix(periodic):
    """The input at each cut does not depend on which other cuts are studied."""
    frequency = np.array([0.3, 1.1])
    together = periodic.response(periodic.ports, frequency)
    u, v = periodic.disturbance_response(periodic.ports, frequency)
    assert together.shape == (2, 2, 2)
    assert -together @ u == pytest.approx(v, abs=1e-12)
    alone, _ = periodic.disturbance_response(periodic.ports[:1], frequency)
    assert alone[:, 0, 0] == pytest.approx(u[:, 0, 0], abs=1e-14)


def test_reduced_to_what_lies_between():
    """0 is moved by the cut and moves 1, which is read; 2 is moved only, 3 moves only, 4 is alone."""
    a = np.diag([0.5, 0.4, 0.3, 0.2, 0.1])
    a[1, 0] = a[2, 0] = a[1, 3] = 1.0
    b, c = np.eye(5, 1), np.eye(1, 5, 1)
    model = LiftedModel(a, b, c, np.eye(1), c, np.zeros((1, 1)), tuple("abcde"), 0.5, (port(1),))
    small = model.reduce(model.ports)
    assert small.names == ("a", "b")
    assert np.sort(small.poles()) == pytest.approx([0.4, 0.5])
    frequency = np.array([0.1, 1.0, 6.0])
    assert small.response(small.ports, frequency) == pytest.approx(model.response(model.ports, frequency), rel=1e-14)
    assert reachable(a != 0.0, b[:, 0] != 0.0).tolist() == [True, True, True, False, False]


def test_modes_that_the_cut_does_not_move_or_see():
    a = np.diag([0.9, 0.8, 0.7, 0.6])
    b, c = np.array([[1.0], [0.0], [1.0], [0.0]]), np.array([[1.0, 1.0, 0.0, 0.0]])
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(4, 4)))[0]
    model = LiftedModel(
        turn.T @ a @ turn, turn.T @ b, c @ turn, np.eye(1), c @ turn, np.zeros((1, 1)), tuple("abcd"), 0.5, (port(1),)
    )
    actual = modes(model, model.ports[0])
    assert [mode.z for mode in actual] == pytest.approx([0.9, 0.8, 0.7, 0.6])
    assert [mode.kind for mode in actual] == ["loop", "not controllable", "not observable", "neither"]
    assert actual[0].s == pytest.approx(np.log(0.9) / 0.5)
    ranks = structure(model, model.ports[0], 7)
    assert (ranks.states, ranks.order, ranks.controllable, ranks.observable) == (7, 4, 2, 2)


def test_damping_and_frequency_of_a_mode():
    """The held damped oscillator: damping and natural frequency of the continuous one."""
    damping, rate, seconds = 0.2, 1.5, 0.5
    loop = held(control.tf([1.0], [1.0, 2.0 * damping * rate, rate**2]), seconds)
    nothing = np.zeros((1, 2))
    model = LiftedModel(loop.A, loop.B, loop.C, np.eye(1), nothing, np.eye(1) * 0.0, ("a", "b"), seconds, (port(1),))
    actual = modes(model, model.ports[0])
    assert len(actual) == 2
    for mode in actual:
        assert (mode.damping, mode.frequency) == (pytest.approx(damping), pytest.approx(rate))
        assert mode.s.real == pytest.approx(-damping * rate)


def test_what_is_forgotten_leaves_no_pole():
    """A delay line of ten samples and one pole: ten multipliers at 0, which rounding would spread to 0.03."""
    line = np.eye(11, k=-1)
    line[0, 0], line[10, 9] = 0.5, 1.0
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(11, 11)))[0]
    nothing = np.zeros((1, 11))
    model = LiftedModel(
        turn.T @ line @ turn, np.zeros((11, 1)), nothing, np.eye(1), nothing, np.eye(1), (), 0.5, (port(1),)
    )
    assert model.poles() == pytest.approx([0.5], abs=1e-12)
