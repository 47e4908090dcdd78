"""Shared code of tests of the terminal guidances: classes, commands, descents.

`flight` steps plant and guidance in turn, like the co-simulation. Code that is independent of the components is in
`linear_thrust`.
"""

import numpy as np
import pytest
from hypothesis import strategies as st

from perilune.fmus_src.guidance.analytic import AnalyticGuidance
from perilune.fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from perilune.fmus_src.guidance.astar import AstarGuidance
from perilune.fmus_src.guidance.astar_modified import AstarModifiedGuidance
from perilune.fmus_src.guidance.astar_robust import AstarRobustGuidance
from perilune.fmus_src.plants.flat_moon_lander import FlatMoonLander
from tests.support.flights.linear_thrust import POSITION, VELOCITY, astar_roots, declared_state, states_of_the_box

ALL = [AnalyticGuidance, AnalyticExactGuidance, AstarGuidance, AstarRobustGuidance, AstarModifiedGuidance]
EXACT = [AnalyticExactGuidance, AstarRobustGuidance]
STOPPING = [AnalyticGuidance, AstarGuidance, AstarModifiedGuidance]
GOOD, CLAMPED, NOT_CONVERGED, NO_SOLUTION = range(4)


millionths = st.integers(0, 10**6).map(lambda number: number / 10**6)
box = st.lists(millionths, min_size=6, max_size=6).map(declared_state)


def commanded(guidance_class, position=POSITION, velocity=VELOCITY, **parameters):
    guidance = guidance_class(position=np.asarray(position).tolist(), velocity=np.asarray(velocity).tolist())
    for name, value in parameters.items():
        setattr(guidance, name, value)
    guidance.initialize()
    return guidance


def see(guidance, position, velocity):
    guidance.position = np.asarray(position).tolist()
    guidance.velocity = np.asarray(velocity).tolist()


def command_of(guidance):
    return [
        guidance.thrust_acceleration,
        *guidance.thrust_direction,
        *guidance.thrust_direction_rate,
    ]


def assert_points_along(guidance, direction, rate, tolerance=1e-9):
    assert guidance.thrust_direction == pytest.approx(direction, abs=tolerance)
    assert guidance.thrust_direction_rate == pytest.approx(rate, abs=1e-2 * tolerance)


def rootless_state():
    return next(state for state in states_of_the_box(100, 8) if not astar_roots(*state))


def flight(guidance_class, position, velocity, step, latch=True, most=5000, error=None):
    """Fly plant and guidance in turn, as the co-simulation schedules them; return rows of time, position, velocity.

    ``error()`` gives the errors of position and velocity (six) that guidance sees in a cycle.
    """
    plant = FlatMoonLander(
        initial_position=position.tolist(), initial_velocity=velocity.tolist(), latch_at_burn_end=latch
    )
    plant.initialize()
    guidance = commanded(guidance_class, position, velocity)
    rows = [[0.0, *plant.position, *plant.velocity]]
    for k in range(most):
        if guidance.finished:
            break
        plant.thrust = guidance.thrust_acceleration * plant.mass
        plant.thrust_direction = guidance.thrust_direction
        plant.thrust_direction_rate = guidance.thrust_direction_rate
        plant.command_time, plant.burn_duration = guidance.command_time, guidance.burn_duration
        plant.step(k * step, step)
        observed = np.array([*plant.position, *plant.velocity])
        if error is not None:
            observed = observed + error()
        see(guidance, observed[:3], observed[3:])
        guidance.step(k * step, step)
        rows.append([(k + 1) * step, *plant.position, *plant.velocity])
    assert guidance.finished
    return np.array(rows), guidance
