"""Powered explicit guidance: thrust integrals, and solution of its equations.

Truth: integrals of F/(m - F t/v_e) and its moments by quad; the conditions on velocity, range and offset written with
these integrals and solved by scipy; an integration of the solution by DOP853, which misses the target by the truncation
error of the steering. Printed numbers are from a separate program.
"""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from perilune.fmus_src.mathlib.lunar.powered_explicit import (
    SteeringProblem,
    SteeringState,
    has_solution,
    iterate_steering,
    thrust_integrals,
)
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.descent.laws import C1, C2
from tests.support.descent.polynomial_laws import EXHAUST, central
from tests.support.descent.powered_steering import MASS, moments, solve

PRINTED = {  # time, thrust, direction, turning, centre
    "C1": (
        203.33764865325458,
        4010.480404108341,
        (0.9478039704611982, 0.0, 0.31885362406281054),
        (-0.0004715081464566968, 0.0, 0.0014015750789409956),
        107.1625620901227,
    ),
    "C2": (
        292.26576854896166,
        4317.342431151106,
        (0.988747040328062, 0.0, 0.14959709302823204),
        (-0.00028518660384333817, 0.0, 0.0018849123654969197),
        159.71403592201904,
    ),
}
STARTS = {"C1": (C1, 215.0), "C2": (C2, 320.0)}
MISSES = {"C1": (38.6, 0.053), "C2": (637.0, 1.0)}  # m and m/s, flown open loop


def converge(leg, time):
    state = SteeringState(
        time=time,
        thrust=0.85 * 5099.0,
        direction=vector(0.0, 0.0, 1.0),
        turning=vector(0.0, 0.0, 0.0),
        centre=0.0,
        change=1.0,
    )
    here, there = central(leg.position), central(leg.target)
    for _ in range(60):
        t = state.time
        problem = SteeringProblem(
            way=vector(*(leg.target - leg.position - t * t * (here / 3.0 + there / 6.0))),
            gain=vector(*(-leg.velocity - 0.5 * t * (here + there))),
            velocity=vector(*leg.velocity),
            mass=MASS,
            exhaust=EXHAUST,
            minimum=510.0,
            maximum=5099.0,
        )
        state = iterate_steering(state, problem)
        assert has_solution(state)
    return state


@pytest.mark.parametrize(("thrust", "time"), [(4000.0, 200.0), (510.0, 30.0), (6600.0, 300.0)])
def test_thrust_integrals_by_quadrature(thrust, time):
    tau = EXHAUST * MASS / thrust
    impulse = quad(lambda t: EXHAUST / (tau - t), 0.0, time, epsrel=1e-13)[0]
    actual = thrust_integrals(impulse, tau, time, EXHAUST)
    expected = moments(thrust, time)
    for name in ("J", "S", "Q", "P"):  # recursions lose digits where little is burnt
        assert getattr(actual, name) == pytest.approx(expected[name], rel=1e-7), name
    assert pytest.approx(expected["J"] / impulse, rel=1e-12) == actual.K
    assert pytest.approx(expected["H"], rel=1e-7) == actual.H


@pytest.mark.parametrize("start", PRINTED)
def test_the_iteration_ends_at_the_solution(start):
    leg, first = STARTS[start]
    state = converge(leg, first)
    printed = PRINTED[start]
    actual_numbers = (state.time, state.thrust, list(state.direction), list(state.turning), state.centre)
    for actual, expected in zip(actual_numbers, printed, strict=True):
        assert actual == pytest.approx(expected, rel=1e-9, abs=1e-12)
    time, thrust, centre, direction, turning = solve(leg, first)
    assert state.time == pytest.approx(time, rel=1e-8)
    assert state.thrust == pytest.approx(thrust, rel=1e-8)
    assert state.centre == pytest.approx(centre, rel=1e-8)
    assert list(state.direction) == pytest.approx(direction, abs=1e-8)
    assert list(state.turning) == pytest.approx(turning, abs=1e-10)


@pytest.mark.parametrize("start", PRINTED)
def test_flown_open_loop_it_misses_by_its_truncation(start):
    leg, first = STARTS[start]
    state = converge(leg, first)
    here, there = central(leg.position), central(leg.target)

    def motion(t, s):
        line = np.array(state.direction) + (t - state.centre) * np.array(state.turning)
        acceleration = state.thrust / (MASS - state.thrust * t / EXHAUST)
        return [*s[3:], *(acceleration * line / np.linalg.norm(line) + here + (there - here) * t / state.time)]

    begin = [*leg.position, *leg.velocity]
    path = solve_ivp(motion, (0.0, state.time), begin, method="DOP853", rtol=1e-11, atol=1e-7)
    miss, speed = MISSES[start]
    assert np.linalg.norm(path.y[:3, -1] - leg.target) == pytest.approx(miss, rel=0.05)
    assert np.linalg.norm(path.y[3:, -1]) == pytest.approx(speed, rel=0.1)


def test_what_has_no_solution():
    """No velocity to gain, or no time."""
    state = converge(C1, 215.0)
    nothing = vector(0.0, 0.0, 0.0)
    problem = SteeringProblem(
        way=nothing, gain=nothing, velocity=nothing, mass=MASS, exhaust=EXHAUST, minimum=510.0, maximum=5099.0
    )
    lost = iterate_steering(state, problem)
    assert not has_solution(lost)
