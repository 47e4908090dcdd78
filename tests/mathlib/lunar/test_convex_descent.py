"""Interior-point method for descents on board, compared with Clarabel in another formulation.

Compared are the best path and its propellant for three starts, with converged expansions; objectives and infeasibility
for random starts, in braking and near the ground with glide slope and tilt; the derivative with respect to the time of
flight, with differences of Clarabel's objective; and a descent known in closed form.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from perilune.fmus_src.mathlib.lunar.convex.expansion import (
    LOG_MASS,
    PLAN,
    POSITION,
    THRUST,
    DescentTask,
    improve_plan,
    improve_plan_to,
    seed_plan,
)
from perilune.fmus_src.mathlib.lunar.convex.flight_time import is_met
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.flights.convex_descent import A1, C1, C2, INTERVALS, MU, RADIUS, approach, settle, solve
from tests.support.lengths import either

FINE = 1e-8
SEED = 20


def task_of(descent):
    """Return the same descent for the blocks."""
    return DescentTask(
        position=vector(*descent.position.tolist()),
        velocity=vector(*descent.velocity.tolist()),
        target=vector(*descent.target.tolist()),
        arrival=vector(0.0, 0.0, 0.0),
        mass=descent.mass,
        maximum=descent.maximum,
        minimum=descent.minimum,
        exhaust=descent.exhaust,
        tilt=float(descent.tilt),
        slope=float(descent.slope),
        depth=descent.depth,
        central=True,
        gravity=1.62,
        parameter=MU,
        radius=RADIUS,
    )


def rows(plan, first, count):
    return np.array(plan[first : first + 3 * count]).reshape(-1, 3)


@pytest.mark.parametrize(("descent", "time"), [(C1, 200.0), (C2, 300.0), (A1, 60.0)], ids=["C1", "C2", "A1"])
def test_a_settled_plan_is_that_of_another_solver(descent, time):
    plan = [0.0] * PLAN
    seed_plan(task_of(descent), time, plan)
    for _ in range(4):
        summary = improve_plan_to(task_of(descent), time, FINE, plan)
    path = settle(descent, time, 4)
    assert is_met(summary)
    assert summary.iterations < 20
    assert summary.impulse == pytest.approx(path.impulse, rel=1e-8)
    assert summary.propellant == pytest.approx(-descent.mass * math.expm1(path.log_mass[-1]), rel=1e-8)
    assert rows(plan, THRUST, INTERVALS)[[0, -1]] == pytest.approx(path.thrust[[0, -1]], abs=1e-2)
    assert rows(plan, POSITION, INTERVALS + 1) == pytest.approx(path.position, abs=1.0)


def random_start(random, kind):
    """Draw a start and a time: braking, or near the ground with glide slope and tilt."""
    if kind < 2:
        base, time = ((C1, 200.0), (C2, 300.0))[kind]
        position = base.position * random.uniform(0.97, 1.03) + np.array([0.0, random.uniform(-3e3, 3e3), 0.0])
        velocity = base.velocity * random.uniform(0.98, 1.02) + np.array([0.0, random.uniform(-20.0, 20.0), 0.0])
        return replace(base, position=position, velocity=velocity), time * random.uniform(0.97, 1.1)
    return approach(random), random.uniform(40.0, 80.0)


def test_random_starts_agree_with_another_solver():
    """To 1e-6 at the tolerance that is flown with; where Clarabel finds no path, the plan misses the target."""
    random = np.random.default_rng(SEED)
    count = either(300, 18)
    reached = 0
    for number in range(count):
        descent, time = random_start(random, number % 3)
        plan = [0.0] * PLAN
        seed_plan(task_of(descent), time, plan)
        expansion = rows(plan, POSITION, INTERVALS + 1), np.array(plan[LOG_MASS:])
        summary = improve_plan(task_of(descent), time, plan)
        path = solve(descent, time, *expansion)
        assert summary.solved, number
        assert summary.iterations <= 20
        assert is_met(summary) == (path is not None), number
        if path is not None:
            reached += 1
            assert summary.impulse == pytest.approx(path.impulse, rel=1e-6), number
    assert reached > 0.8 * count


@pytest.mark.parametrize(("descent", "time"), [(C1, 200.0), (A1, 60.0)], ids=["C1", "A1"])
def test_the_slope_is_that_of_another_solvers_objective(descent, time):
    plan = [0.0] * PLAN
    seed_plan(task_of(descent), time, plan)
    improve_plan_to(task_of(descent), time, FINE, plan)
    expansion = rows(plan, POSITION, INTERVALS + 1), np.array(plan[LOG_MASS:])
    summary = improve_plan_to(task_of(descent), time, FINE, plan)
    before, after = (solve(descent, time + change, *expansion).impulse for change in (-0.05, 0.05))
    assert summary.slope == pytest.approx((after - before) / 0.1, rel=1e-4)


def test_a_time_that_is_too_short_is_solved_with_a_miss():
    """The elastic end: 300 s are needed, and 150 s leave a miss of kilometres."""
    plan = [0.0] * PLAN
    seed_plan(task_of(C2), 150.0, plan)
    summary = improve_plan(task_of(C2), 150.0, plan)
    assert summary.solved
    assert solve(C2, 150.0, rows(plan, POSITION, INTERVALS + 1), np.zeros(INTERVALS + 1)) is None
    assert summary.position_miss > 1e3 or summary.velocity_miss > 10.0


def test_a_start_outside_of_the_glide_slope_is_not_solved():
    """In 20 s it cannot rise above the slope within the first interval."""
    outside = replace(A1, position=np.array([2000.0, 0.0, 300.0]), velocity=np.array([-60.0, 0.0, 0.0]))
    plan = [0.0] * PLAN
    seed_plan(task_of(outside), 20.0, plan)
    assert not improve_plan(task_of(outside), 20.0, plan).solved
    assert solve(outside, 20.0, rows(plan, POSITION, INTERVALS + 1), np.array(plan[LOG_MASS:])) is None


def test_memory_is_fixed():
    """A plan has the thrust of intervals, and position, velocity, gravity and log mass of nodes."""
    assert PLAN == 3 * INTERVALS + 10 * (INTERVALS + 1)
