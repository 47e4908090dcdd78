"""perilune.analysis.design.trajectories: convex form of the point-mass problem, least time, direct method.

Truth: the same problem by a direct method without convexification; Lawden's primer vector, which is linear in time in
uniform gravity (Lawden 1963); the motion integrated by scipy; for a vertical descent, a free fall and a burn in closed
form.
"""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from perilune.analysis.design.trajectories.convex_form import solve_fixed_time
from perilune.analysis.design.trajectories.least_time import least_propellant
from perilune.analysis.design.trajectories.multiple_shooting import direct_propellant
from perilune.analysis.design.trajectories.path import PlanError
from perilune.analysis.design.trajectories.point_mass import landing_problem, transfer_problem
from perilune.analysis.design.trajectories.vehicle import Landing, Transfer, Vehicle
from tests.support.lengths import either

HOVER = Vehicle(600.0, 0.0, 300.0, 4707.192, 4707.192 / 15.0, math.radians(1.0))
TRANSFER = Transfer(1600.0, 2300.0, 1.622)
LANDER = Vehicle(940.13, 440.0, 319.0, 5099.0, 0.0, math.inf)
LANDING = Landing(285e3, 14995.3, 1692.342, 0.0, 4.0, 1.7374e6, 4.9028e12)
OTHER = Vehicle(800.0, 350.0, 330.0, 6000.0, 400.0, math.inf)
FROM_FARTHER = replace(LANDING, range=300e3, altitude=15e3, speed=1692.34)
INTERVALS = either(240, 60)
TIGHT = 3e-7  # m/s2


@cache
def bound(problem):
    return least_propellant(problem, INTERVALS)


@pytest.fixture(scope="module")
def transfer():
    return bound(transfer_problem(HOVER, TRANSFER))


@pytest.fixture(scope="module")
def landing():
    return bound(landing_problem(LANDER, LANDING))


@pytest.mark.parametrize(
    ("intervals", "fraction"), either([(60, 0.044814), (120, 0.044809), (240, 0.044807)], [(60, 0.044814)])
)
def test_transfer_at_its_time(intervals, fraction):
    path = solve_fixed_time(transfer_problem(HOVER, TRANSFER), 67.5, intervals)
    assert path.propellant_fraction == pytest.approx(fraction, abs=5e-7)
    assert path.slack <= TIGHT


def test_transfer_over_all_times(transfer):
    assert transfer.propellant_fraction == pytest.approx(0.044807, abs=either(5e-6, 1e-5))
    assert transfer.time[-1] == pytest.approx(67.5, abs=0.2)
    assert transfer.slack <= TIGHT


def test_landing(landing):
    assert landing.propellant_fraction * LANDER.mass == pytest.approx(400.82, abs=0.01)
    assert landing.time[-1] == pytest.approx(292.65, abs=0.1)
    assert landing.slack <= TIGHT
    burns = landing.make_path(landing_problem(LANDER, LANDING)).burns()
    assert np.array(burns) == pytest.approx(np.array([[0.0, 65.8], [112.2, 292.65]]), abs=0.4)


def test_the_engines_least_thrust_costs_grams():
    burning, free = (
        solve_fixed_time(landing_problem(replace(LANDER, minimum_thrust=minimum), LANDING), 292.65, INTERVALS)
        for minimum in (340.0, 0.0)
    )
    assert burning.slack <= TIGHT
    more = LANDER.mass * (burning.propellant_fraction - free.propellant_fraction)
    assert more == pytest.approx(0.0026, abs=1e-3)


CASES = {
    "transfer": (transfer_problem(HOVER, TRANSFER), HOVER.mass),
    "landing": (landing_problem(LANDER, LANDING), LANDER.mass),
    "to rest at H3": (landing_problem(LANDER, replace(LANDING, target_altitude=2400.0)), LANDER.mass),
    "climbing": (landing_problem(LANDER, replace(LANDING, climb=0.01)), LANDER.mass),
    "another vehicle": (landing_problem(OTHER, FROM_FARTHER), OTHER.mass),
    "its engine off": (landing_problem(replace(OTHER, minimum_thrust=0.0), FROM_FARTHER), OTHER.mass),
    "approach": (
        transfer_problem(replace(LANDER, mass=495.0, minimum_thrust=340.0), Transfer(22.4, 96.0, 1.624)),
        495.0,
    ),
}


@pytest.mark.parametrize("case", either([*CASES], ["another vehicle", "approach"]))
def test_a_direct_method_finds_the_same(case):
    problem, mass = CASES[case]
    actual = bound(problem)
    fraction, duration = direct_propellant(problem, INTERVALS)
    assert actual.slack <= TIGHT
    assert fraction * mass == pytest.approx(actual.propellant_fraction * mass, abs=0.01)
    assert duration == pytest.approx(actual.time[-1], rel=either(1e-3, 5e-3))


@pytest.mark.parametrize(
    ("case", "kg"), [("to rest at H3", 399.92), *either([("landing", 400.821)], [])]
)  # what a stop at H3 costs: the pieces of the split of a flown landing
def test_pieces(case, kg):
    problem, mass = CASES[case]
    assert bound(problem).propellant_fraction * mass == pytest.approx(kg, abs=0.01)


def test_hovers_of_a_landing():
    """From 2.4 km to 100 m over a site 1342 m away, then to 4 m over one 22 m away."""
    first = transfer_problem(Vehicle(526.4, 440.0, 319.0, 5099.0, 340.0, math.inf), Transfer(1341.6, 2300.0, 1.623))
    assert bound(first).propellant_fraction * 526.4 == pytest.approx(21.23, abs=0.02)
    second = transfer_problem(Vehicle(495.3, 440.0, 319.0, 5099.0, 340.0, math.inf), Transfer(22.36, 96.0, 1.624))
    assert bound(second).propellant_fraction * 495.3 == pytest.approx(3.72, abs=0.01)


def test_thrust_follows_a_primer_vector_that_is_linear_in_time(transfer):
    """Thrust is along a + b t: u x (a + b t) = 0 is linear in a and b, with one solution."""
    middle = (transfer.time[1:] + transfer.time[:-1]) / (2.0 * transfer.time[-1])
    ux, uy = (transfer.thrust_acceleration / transfer.size[:, np.newaxis]).T
    _, sizes, rows = np.linalg.svd(np.stack([ux, ux * middle, -uy, -uy * middle], axis=1))
    assert sizes[-1] < 2e-3 * sizes[-2]
    (ay, by, ax, bx) = rows[-1]
    primer = np.hypot(ax + bx * middle, ay + by * middle)
    throttle = transfer.make_path(transfer_problem(HOVER, TRANSFER)).throttle
    size = primer / (1.0 - np.interp(middle, transfer.time / transfer.time[-1], -np.expm1(transfer.log_mass)))
    assert size[throttle > 0.99].min() > 0.99 * size[throttle < 0.07].max()  # full where the primer is large


@pytest.mark.parametrize("case", ["transfer", "landing"])
def test_scipy_integrates_to_the_same_end(case, request):
    path, problem = request.getfixturevalue(case), CASES[case][0]

    def rate(t, state):
        interval = min(int(t / path.time[-1] * path.size.size), path.size.size - 1)
        return [*state[2:], *np.add(problem.gravity.at(state[0], state[1]), path.thrust_acceleration[interval])]

    state = [*problem.start_position, *problem.start_velocity]
    for begin, end in zip(path.time[:-1], path.time[1:], strict=True):
        state = solve_ivp(rate, (begin + 1e-9, end - 1e-9), state, rtol=1e-10, atol=1e-9).y[:, -1]
    scale = np.array([problem.length, problem.length, problem.speed, problem.speed])
    end = np.array([*problem.end_position, *problem.end_velocity])
    assert np.max(np.abs(state - end) / scale) < either(1e-5, 1e-4)


def test_straight_down_it_falls_and_then_burns():
    """With an engine that can be off, from 2300 m; speed and height of a burn at full thrust by the rocket equation."""
    down = transfer_problem(replace(HOVER, minimum_thrust=0.0), Transfer(0.0, 2300.0, 1.622))
    c, rate = HOVER.exhaust_speed, HOVER.full / HOVER.exhaust_speed

    def short(burnt):  # m of height that are missing after a burn of this fraction of the mass
        time = -c * math.log1p(-burnt) / 1.622
        return 0.5 * 1.622 * time**2 - c / rate * (burnt + (1.0 - burnt) * math.log1p(-burnt)) - 2300.0

    burnt = brentq(short, 1e-3, 0.2)
    actual = bound(down)
    assert actual.propellant_fraction == pytest.approx(burnt, rel=either(3e-5, 2e-4))
    assert actual.time[-1] == pytest.approx(-c * math.log1p(-burnt) / 1.622, abs=0.1)


def test_mass_and_thrust_scale_together():
    problem = transfer_problem(HOVER, TRANSFER)
    heavy = replace(
        HOVER, mass=1200.0, maximum_thrust=2.0 * HOVER.maximum_thrust, minimum_thrust=2.0 * HOVER.minimum_thrust
    )
    assert transfer_problem(heavy, TRANSFER) == problem


def test_lengths_scale_with_the_square_of_time():
    """Twice the time, four times the way, twice the exhaust speed: the same accelerations, the same fraction."""
    one = solve_fixed_time(transfer_problem(HOVER, TRANSFER), 70.0, 40)
    large = transfer_problem(replace(HOVER, specific_impulse=600.0), Transfer(6400.0, 9200.0, 1.622))
    four = solve_fixed_time(large, 140.0, 40)
    assert four.propellant_fraction == pytest.approx(one.propellant_fraction, rel=1e-6)
    assert four.position == pytest.approx(4.0 * one.position, abs=0.05)


def test_no_time_is_enough():
    assert solve_fixed_time(transfer_problem(HOVER, TRANSFER), 30.0, 40) is None
    weak = replace(HOVER, maximum_thrust=600.0, minimum_thrust=0.0)  # cannot carry its weight
    with pytest.raises(PlanError, match="cannot reach the target within any duration from"):
        least_propellant(transfer_problem(weak, TRANSFER), 40)
