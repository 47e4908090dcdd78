"""Guidances with a time to go for every initial state: hovering, slow, receding and fast starts, and their ends.

Truth: arrival, in simulations with the plant; for starts at rest the least integral of the squared thrust acceleration,
g^2 T + 12 h^2/T^3 at T = sqrt(6 h/g), in closed form; the smallest effort over all times by scipy. Tolerance 1e-3 m and
1e-3 m/s at the target unless a test says otherwise.
"""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from perilune.fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from perilune.fmus_src.guidance.astar_robust import AstarRobustGuidance
from tests.support.flights.linear_thrust import (
    GRAVITY,
    POSITION,
    TARGET,
    UP,
    VELOCITY,
    linear_thrust,
    states_of_the_box,
)
from tests.support.flights.terminal_guidance import EXACT, GOOD, NO_SOLUTION, commanded, flight, see
from tests.support.lengths import either

STARTS = {  # from the target, m and m/s
    "hovering 500 m above": ([0.0, 0.0, 500.0], [0.0, 0.0, 0.0]),
    "hovering 500 m below": ([0.0, 0.0, -500.0], [0.0, 0.0, 0.0]),
    "hovering 2 km beside": ([2000.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
    "hovering 2 km on the other side": ([-2000.0, 10.0, 0.0], [0.0, 0.0, 0.0]),
    "hovering 50 km away": ([5e4, 0.0, 1000.0], [0.0, 0.0, 0.0]),
    "hovering 1 m above": ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
    "sinking slowly": ([0.0, 0.0, 500.0], [0.0, 0.0, -1e-3]),
    "sinking": ([0.0, 0.0, 500.0], [0.0, 0.0, -5.0]),
    "rising": ([0.0, 0.0, 500.0], [0.0, 0.0, 5.0]),
    "rising from below": ([0.0, 0.0, -500.0], [0.0, 0.0, 20.0]),
    "coasting up": ([0.0, 0.0, -500.0], [0.0, 0.0, 40.0]),
    "slow above": ([1000.0, 0.0, 500.0], [-20.0, 0.0, -5.0]),
    "5 km away": ([5000.0, 200.0, 1500.0], [-100.0, 3.0, -20.0]),
    "past the target": ([-1000.0, 0.0, 500.0], [-50.0, 0.0, 0.0]),
    "fast approach from the other side": ([-1e5, 0.0, 8500.0], [950.0, 0.0, -20.0]),
}


@pytest.mark.parametrize("guidance_class", EXACT)
@pytest.mark.parametrize("start", STARTS)
def test_every_start_arrives(guidance_class, start):
    position, velocity = (np.array(part) for part in STARTS[start])
    first = commanded(guidance_class, TARGET + position, velocity)
    rows, guidance = flight(guidance_class, TARGET + position, velocity, 0.1)
    assert guidance.status == GOOD
    assert np.linalg.norm(rows[-1, 1:4] - TARGET) < 1e-3
    assert np.linalg.norm(rows[-1, 4:]) < 1e-3
    assert rows[-1, 0] == pytest.approx(first.time_to_go, rel=0.05)


@pytest.mark.parametrize("guidance_class", EXACT)
def test_any_start_arrives(guidance_class):
    """Up to 200 km away and up to 1 km/s, towards the target or in any direction, in 400 cycles or so."""
    generator = np.random.default_rng(13)
    kinds = set()
    for number in range(either(24, 8)):
        place = 10 ** generator.uniform(1.0, 5.3) * generator.uniform(-1.0, 1.0, size=3)
        place[2] = generator.uniform(-300.0, 3000.0)
        heading = generator.normal(size=3) if number % 2 else -place
        speed = generator.uniform(0.0, 2.0) * math.sqrt(np.linalg.norm(place))
        velocity = speed * heading / np.linalg.norm(heading)
        first = commanded(guidance_class, TARGET + place, velocity)
        kinds.add(first.braking)
        rows, guidance = flight(guidance_class, TARGET + place, velocity, first.time_to_go / 400.0)
        assert guidance.status == GOOD
        assert np.linalg.norm(rows[-1, 1:4] - TARGET) < 0.02
        assert np.linalg.norm(rows[-1, 4:]) < 0.02
    assert kinds == {True, False}


@pytest.mark.parametrize("guidance_class", EXACT)
@pytest.mark.parametrize("start", ["hovering 500 m above", "hovering 500 m below", "hovering 2 km beside"])
def test_starts_at_rest_fly_the_least_effort(guidance_class, start):
    position, velocity = (np.array(part) for part in STARTS[start])
    distance = np.linalg.norm(position)
    guidance = commanded(guidance_class, TARGET + position, velocity)
    time = math.sqrt(6.0 * distance / GRAVITY)
    assert guidance.time_to_go == pytest.approx(time, rel=1e-12)
    a0, _ = linear_thrust(TARGET + position, velocity, time)
    assert guidance.thrust_acceleration == pytest.approx(np.linalg.norm(a0), abs=1e-9)
    rows, _ = flight(guidance_class, TARGET + position, velocity, 0.1)
    thrust = np.diff(rows[:-1, 4:], axis=0) / 0.1 + GRAVITY * UP  # the last burn left out
    assert 0.1 * np.sum(thrust**2) == pytest.approx(GRAVITY**2 * time + 12.0 * distance**2 / time**3, rel=0.01)


@pytest.mark.parametrize("start", ["sinking", "rising", "slow above", "5 km away", "past the target"])
def test_time_of_least_effort_is_the_least(start):
    position, velocity = (np.array(part) for part in STARTS[start])

    def effort_of(time):
        a0, a1 = linear_thrust(TARGET + position, velocity, time)
        return a0 @ a0 * time + a0 @ a1 * time**2 + a1 @ a1 * time**3 / 3.0

    guidance = commanded(AnalyticExactGuidance, TARGET + position, velocity)
    assert guidance.least_effort
    best = minimize_scalar(effort_of, bounds=(1.0, 1000.0), method="bounded", options={"xatol": 1e-6})
    assert guidance.time_to_go == pytest.approx(best.x, rel=1e-5)


@pytest.mark.parametrize("guidance_class", EXACT)
def test_the_published_box_brakes(guidance_class):
    for position, velocity in states_of_the_box(either(200, 50), 14):
        guidance = commanded(guidance_class, position, velocity)
        assert guidance.braking
        assert not guidance.least_effort


@pytest.mark.parametrize("guidance_class", EXACT)
def test_one_wrong_estimate_does_not_end_the_flight(guidance_class):
    """For one cycle in the middle of braking the vehicle is believed to hover above the target."""
    rows, _ = flight(guidance_class, POSITION, VELOCITY, 1.0)
    position, velocity = rows[100, 1:4], rows[100, 4:]
    guidance = commanded(guidance_class, POSITION, VELOCITY)
    for k in range(100):
        see(guidance, rows[k + 1, 1:4], rows[k + 1, 4:])
        guidance.step(float(k), 1.0)
    before = guidance.time_to_go
    see(guidance, TARGET + 500.0 * UP, [0.0, 0.0, 0.0])
    guidance.step(100.0, 1.0)
    assert guidance.status == GOOD
    assert guidance.least_effort
    assert guidance.time_to_go == pytest.approx(math.sqrt(6.0 * 500.0 / GRAVITY), rel=1e-9)
    see(guidance, position, velocity)
    guidance.step(101.0, 1.0)
    assert not guidance.least_effort
    assert guidance.time_to_go == pytest.approx(before, rel=1e-9)


@pytest.mark.parametrize("guidance_class", EXACT)
@pytest.mark.parametrize("start", ["hovering 500 m above", "hovering 2 km beside", "rising", "past the target"])
def test_flights_of_least_effort_end_in_spite_of_noise(guidance_class, start):
    """White errors of 0.3 m and 0.1 m/s per axis in every cycle: the flight neither chases them for long nor misses."""
    position, velocity = (np.array(part) for part in STARTS[start])
    generator = np.random.default_rng(15)
    planned = commanded(guidance_class, TARGET + position, velocity).time_to_go
    rows, _ = flight(
        guidance_class,
        TARGET + position,
        velocity,
        0.1,
        error=lambda: generator.normal(scale=[0.3] * 3 + [0.1] * 3),
    )
    assert rows[-1, 0] < 1.1 * planned
    assert np.linalg.norm(rows[-1, 1:4] - TARGET) < 5.0
    assert np.linalg.norm(rows[-1, 4:]) < 3.0


def test_robust_astar_flies_the_linear_thrust_where_arcsines_cannot():
    """Thrust backwards along x, where the method's own programme has no angle: fast flight towards +x."""
    mirror = np.array([-1.0, 1.0, 1.0])
    plain = commanded(AnalyticExactGuidance, mirror * POSITION, mirror * VELOCITY)
    robust = commanded(AstarRobustGuidance, mirror * POSITION, mirror * VELOCITY)
    assert robust.braking
    assert robust.time_to_go == plain.time_to_go
    assert robust.thrust_direction == pytest.approx(plain.thrust_direction, abs=1e-12)
    assert robust.thrust_direction_rate == pytest.approx(plain.thrust_direction_rate, abs=1e-12)
    a0, _ = linear_thrust(mirror * POSITION, mirror * VELOCITY, robust.time_to_go)
    assert robust.thrust_acceleration == pytest.approx(np.linalg.norm(a0), rel=1e-9)


@pytest.mark.parametrize("guidance_class", EXACT)
def test_without_gravity_a_start_at_rest_has_no_solution(guidance_class):
    guidance = commanded(guidance_class, TARGET + 500.0 * UP, [0.0, 0.0, 0.0], gravity=0.0)
    assert guidance.status == NO_SOLUTION
    assert guidance.thrust_acceleration == 0.0
    guidance.step(0.0, 0.1)
    assert guidance.status == NO_SOLUTION
    assert not guidance.finished
