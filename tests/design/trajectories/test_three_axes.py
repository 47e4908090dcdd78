"""The convex form in three axes with tilt and glide slope.

Truth: Clarabel in another formulation (dense, gravity held at nodes), the plan of the blocks' interior-point method,
and the two-axis form in a rotated plane; derivatives by differences; limits checked at the nodes of a path.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.design.trajectories.convex_form import solve_fixed_time
from perilune.analysis.design.trajectories.descent_problem import check_roles, descent_problem
from perilune.analysis.design.trajectories.least_time import least_propellant
from perilune.analysis.design.trajectories.point_mass import CentralGravity, UniformGravity
from perilune.common.errors import InputError
from tests.support.flights.convex_descent import A1, C1, C2, MU, RADIUS, approach, settle
from tests.support.lengths import either

WHERE = ("c.toml", "lookup.bound.inputs")


def inputs_of(descent):
    """Return the same descent as numbers by role."""
    inputs = {"position": descent.position, "velocity": descent.velocity, "target": descent.target}
    numbers = {
        "mass": descent.mass,
        "specific_impulse": 319.0,
        "maximum_thrust": descent.maximum,
        "minimum_thrust": descent.minimum,
        "moon_radius": RADIUS,
        "gravitational_parameter": MU,
    }
    if descent.slope > 0.0:
        numbers |= {"glide_slope": descent.slope, "glide_offset": descent.depth, "largest_tilt": descent.tilt}
    return inputs | {name: (number,) for name, number in numbers.items()}


def problem_of(descent):
    return descent_problem(inputs_of(descent), WHERE)[0]


@pytest.mark.parametrize(("descent", "time"), [(C1, 200.0), (C2, 300.0), (A1, 60.0)], ids=["C1", "C2", "A1"])
def test_it_is_the_path_of_another_formulation(descent, time):
    """The other formulation holds gravity at the nodes of its last path and so misses its
    dependence on the path: it costs more."""
    actual, expected = solve_fixed_time(problem_of(descent), time, 24), settle(descent, time, 4)
    impulse = -descent.exhaust * actual.log_mass[-1]
    assert impulse == pytest.approx(expected.impulse, rel=2e-6)
    assert impulse < expected.impulse * (1.0 + 1e-8)
    assert actual.position == pytest.approx(expected.position, abs=2e-4 * np.linalg.norm(descent.position))
    assert actual.slack < 1e-6


def test_random_approaches_keep_their_limits():
    random = np.random.default_rng(3)
    for _ in range(either(40, 4)):
        descent = approach(random)
        actual, expected = solve_fixed_time(problem_of(descent), 70.0, 24), settle(descent, 70.0, 6)
        assert -descent.exhaust * actual.log_mass[-1] == pytest.approx(expected.impulse, rel=1e-5)
        along, height = np.hypot(*actual.position[:, :2].T), actual.position[:, 2] - descent.target[2]
        assert np.min(height + descent.depth - math.tan(descent.slope) * along) > -1e-3
        assert np.min(actual.thrust_acceleration[:, 2] - math.cos(descent.tilt) * actual.size) > -1e-6


@pytest.mark.parametrize(
    ("descent", "kg", "seconds"),
    [(A1, 19.928, 40.90), *either([(C1, 257.006, 180.96), (C2, 400.2684, 275.05)], [])],
    ids=either(["A1", "C1", "C2"], ["A1"]),
)
def test_least_time_is_that_of_bisection(descent, kg, seconds):
    """With 80 intervals; the expected ones bisect the derivative of the blocks' interior point to 0.1 s, with gravity
    held at nodes, so that they may be above by some grams."""
    path = least_propellant(problem_of(descent), 80, 0.1)
    assert path.propellant_fraction * descent.mass == pytest.approx(kg, abs=8e-3)
    assert path.propellant_fraction * descent.mass < kg + 1e-3
    assert path.time[-1] == pytest.approx(seconds, abs=1.1)


@pytest.mark.parametrize(
    ("descent", "time"), [(A1, 41.0), *either([(C1, 181.0)], [])], ids=either(["A1", "C1"], ["A1"])
)
def test_more_intervals_save_less_than_a_gram(descent, time):
    few, many = (solve_fixed_time(problem_of(descent), time, intervals) for intervals in (80, 240))
    saved = descent.mass * (few.propellant_fraction - many.propellant_fraction)
    assert 0.0 < saved < 1e-3


def test_a_rotated_plane_costs_the_same():
    problem = problem_of(C1)
    angle = 0.7
    turn = np.array(
        [[math.cos(angle), -math.sin(angle), 0.0], [math.sin(angle), math.cos(angle), 0.0], [0.0, 0.0, 1.0]]
    )
    rotated = replace(
        problem,
        start_position=tuple(turn @ problem.start_position),
        start_velocity=tuple(turn @ problem.start_velocity),
    )
    flat = replace(
        problem,
        **{
            name: getattr(problem, name)[::2]
            for name in ("start_position", "start_velocity", "end_position", "end_velocity")
        },
    )
    three, two = (solve_fixed_time(each, 200.0, 24) for each in (rotated, flat))
    assert three.propellant_fraction == pytest.approx(two.propellant_fraction, abs=1e-8)
    assert three.position @ turn == pytest.approx(np.insert(two.position, 1, 0.0, axis=1), abs=0.1)


@pytest.mark.parametrize("axes", [2, 3])
def test_the_gradient_is_that_of_gravity(axes):
    position = np.array([[3e4, -2e4, 1e4][-axes:]])
    for gravity in (CentralGravity(MU, RADIUS), UniformGravity(1.62)):
        steps = np.concatenate([position + 10.0 * np.eye(axes), position - 10.0 * np.eye(axes)])
        acceleration = np.stack(np.broadcast_arrays(*gravity.at(*steps.T)), axis=1)
        expected = (acceleration[:axes] - acceleration[axes:]).T / 20.0
        assert gravity.gradient(position)[0] == pytest.approx(expected, abs=1e-13)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"weight": (1.0,)}, "lookup.bound.inputs.weight: not an input of a bound"),
        ({"mass": (1.0, 2.0)}, "mass: 2 numbers, not 1"),
        ({"mass": None}, "no mass; add mass = "),
        ({"mass": (0.0,)}, "mass: 0 is not positive"),
        ({"glide_slope": (2.0,)}, "glide_slope: 2 rad is not a valid angle"),
        ({"minimum_thrust": (6000.0,)}, "minimum_thrust: 6000 N is negative, or not below"),
        ({"target": tuple(A1.position)}, "target: is the start of the descent itself"),
    ],
)
def test_wrong_inputs(change, words):
    inputs = {name: values for name, values in (inputs_of(A1) | change).items() if values is not None}

    def read():
        check_roles({name: len(values) for name, values in inputs.items()}, WHERE)
        descent_problem(inputs, WHERE)

    with pytest.raises(InputError, match=words):
        read()
