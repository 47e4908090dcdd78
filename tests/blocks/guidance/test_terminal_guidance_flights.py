"""Complete descents of the terminal guidances over a flat Moon.

Truth: `support/flights/independent_lander.py`, 1e-8 m and 1e-9 m/s; bounds on the errors left by a stop within a cycle.
"""

import numpy as np
import pytest

from perilune.fmus_src.guidance.analytic import AnalyticGuidance
from perilune.fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from perilune.fmus_src.guidance.astar import AstarGuidance
from perilune.fmus_src.guidance.astar_modified import AstarModifiedGuidance
from perilune.fmus_src.guidance.astar_robust import AstarRobustGuidance
from tests.support.flights.independent_lander import fly
from tests.support.flights.linear_thrust import (
    GRAVITY,
    POSITION,
    TARGET,
    UP,
    VELOCITY,
    states_of_the_box,
)
from tests.support.flights.terminal_guidance import EXACT, GOOD, flight
from tests.support.lengths import either


@pytest.mark.parametrize(("guidance_class", "variant"), [(AnalyticGuidance, "stop"), (AnalyticExactGuidance, "exact")])
@pytest.mark.parametrize("step", [0.1, 1.0, 5.0])
def test_flights_are_those_of_the_independent_lander(guidance_class, variant, step):
    states = [(POSITION, VELOCITY), *states_of_the_box(1 if step < 1.0 else either(4, 1), 9)]
    for position, velocity in states:
        rows, _ = flight(guidance_class, position, velocity, step)
        truth = fly(position, velocity, step, variant)
        assert rows[:, 0] == pytest.approx(truth["times"], abs=1e-9)
        assert rows[:, 1:4] == pytest.approx(truth["positions"], rel=1e-9, abs=1e-8)
        assert rows[:, 4:] == pytest.approx(truth["velocities"], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    ("guidance_class", "step", "distance", "speed"),
    [
        (AnalyticExactGuidance, 5.0, 1.7e-2, 0.24),
        (AnalyticExactGuidance, 1.0, 1e-5, 1e-2),
        (AnalyticExactGuidance, 0.1, 1e-8, 1e-4),
        (AstarRobustGuidance, 1.0, 200.0, 10.0),
    ],
)
def test_exact_flights_arrive_within_the_published_bounds(guidance_class, step, distance, speed):
    for position, velocity in states_of_the_box(either(2, 1) if step < 1.0 else either(12, 4), 10):
        rows, guidance = flight(guidance_class, position, velocity, step)
        assert guidance.status == GOOD
        assert np.linalg.norm(rows[-1, 1:4] - TARGET) <= distance
        assert np.linalg.norm(rows[-1, 4:]) <= speed


@pytest.mark.parametrize("guidance_class", [AnalyticGuidance, AstarModifiedGuidance, AstarGuidance])
def test_stopped_flights_land_with_the_speed_of_less_than_a_cycle(guidance_class):
    """At most W h of speed and W h^2/2 of way are left, once the method has found its solution."""
    step = 0.5
    rows, guidance = flight(guidance_class, POSITION, VELOCITY, step, latch=False)
    left = guidance.time_to_go
    assert left < step
    assert np.linalg.norm(rows[-1, 4:]) < 6.0 * step
    assert np.linalg.norm(rows[-1, 1:4] - TARGET) < 6.0 * step**2


@pytest.mark.parametrize("guidance_class", EXACT)
def test_exact_flight_that_starts_within_its_last_cycle_finishes(guidance_class):
    """Constant thrust that arrives exactly, from a fraction of the cycle before."""
    total = np.array([4.5, 0.3, 1.4]) - GRAVITY * UP
    for time in (0.1, 0.2, 0.3, 0.4, 0.6, 0.9):
        rows, _ = flight(guidance_class, TARGET + 0.5 * total * time**2, -total * time, 1.0, most=50)
        assert np.linalg.norm(rows[-1, 1:4] - TARGET) < 1e-3
        assert len(rows) == 2  # over at the end of the cycle of the last burn
