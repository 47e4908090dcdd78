"""Diverts of the terminal guidances: a target that changes in flight.

Truth: a new guidance started at the same state and time with the new target, whose commands equal those after the
divert to the bit; arrival at the target; the same guidance without a divert.
"""

import numpy as np
import pytest

from perilune.fmus_src.guidance.network_operator import NetworkOperatorGuidance
from perilune.fmus_src.interfaces.ports.landing import TerminalStatus
from tests.support.descent.laws import C2, DESCENT_LAWS, TO_A_PLACE, GravityTurnGuidance, fly, start
from tests.support.flights.terminal_guidance import ALL, command_of, see

STEP = 0.5
PARAMETERS = {"sample_period": STEP, "terminal_step": 1}
ASIDE = np.array([900.0, -700.0, 1600.0])


def rows_of(leg, count=12):
    """Return a path along which nothing ends."""
    s = np.linspace(0.0, 0.4, count)[:, None]
    return leg.position + s**2 * (leg.target - leg.position), (1.0 - s) * leg.velocity


def outputs(guidance):
    time = guidance.command_time if guidance.status < TerminalStatus.NOT_CONVERGED else None
    return [*command_of(guidance), time, guidance.time_to_go, guidance.status]


def follow(guidance, positions, velocities, first):
    collected = []
    for k in range(first, len(positions)):
        see(guidance, positions[k], velocities[k])
        guidance.step((k - 1) * STEP, STEP)
        collected.append(outputs(guidance))
    return collected


@pytest.mark.parametrize("law", [*ALL, *DESCENT_LAWS])
@pytest.mark.parametrize("correction", [False, True])
def test_diverted_it_is_a_fresh_guidance_to_the_new_target(law, correction):
    positions, velocities = rows_of(C2)
    guidance = start(law, C2, gravity_correction=correction, **PARAMETERS)
    follow(guidance, positions[:6], velocities[:6], 1)
    guidance.divert_count, guidance.divert_position = 7, ASIDE.tolist()
    actual = follow(guidance, positions, velocities, 6)
    fresh = law(mass=940.0, target_position=ASIDE.tolist(), gravity=1.624219, gravity_correction=correction)
    fresh.sample_period, fresh.terminal_step, fresh.start_time = STEP, 1, 6 * STEP
    see(fresh, positions[6], velocities[6])
    fresh.initialize()
    expected = [outputs(fresh), *follow(fresh, positions, velocities, 7)]
    assert list(guidance.aim_position) == ASIDE.tolist()
    assert actual == expected
    assert any(row[0] > 0.0 for row in expected) or law is GravityTurnGuidance  # which is below the target


@pytest.mark.parametrize("law", [*ALL, *DESCENT_LAWS, NetworkOperatorGuidance])
def test_a_count_that_stays_and_a_target_that_is_the_same_change_nothing(law):
    """Whatever divert_position is; a divert to the target in force is a new start, of which only the time is chosen."""
    positions, velocities = rows_of(C2)
    plain = start(law, C2, **PARAMETERS)
    other = start(law, C2, divert_count=3, divert_position=ASIDE.tolist(), **PARAMETERS)
    assert follow(plain, positions, velocities, 1) == follow(other, positions, velocities, 1)


@pytest.mark.parametrize("law", TO_A_PLACE)
def test_a_flight_ends_at_the_new_place(law):
    guidance = start(law, C2, last_burn=2.0)
    plant, _ = fly(guidance, C2, aside=(120, ASIDE))
    assert guidance.finished
    assert np.linalg.norm(np.subtract(plant.position, ASIDE)) < 1.0
    assert np.linalg.norm(plant.velocity) < 0.3


@pytest.mark.parametrize("law", TO_A_PLACE)
def test_without_a_solution_the_last_command_is_held(law):
    """At rest at the new target there is no time to go; the sample after that, elsewhere, there is one."""
    positions, velocities = rows_of(C2)
    guidance = start(law, C2, **PARAMETERS)
    follow(guidance, positions[:4], velocities[:4], 1)
    before, left = command_of(guidance), guidance.time_to_go
    guidance.divert_count, guidance.divert_position = 1, ASIDE.tolist()
    see(guidance, ASIDE, np.zeros(3))
    guidance.step(3 * STEP, STEP)
    assert guidance.status == TerminalStatus.NO_SOLUTION
    assert command_of(guidance) == before
    assert guidance.time_to_go == pytest.approx(left - STEP)
    see(guidance, positions[5], velocities[5])
    guidance.step(4 * STEP, STEP)
    assert guidance.status < TerminalStatus.NOT_CONVERGED
    assert command_of(guidance) != before


def test_the_network_operator_takes_the_new_altitude():
    positions, velocities = rows_of(C2)
    guidance = start(NetworkOperatorGuidance, C2, **PARAMETERS)
    fresh = start(NetworkOperatorGuidance, C2, **PARAMETERS, handover_speed=5.9)
    fresh.target_position = ASIDE.tolist()
    fresh.initialize()
    guidance.divert_count, guidance.divert_position = 1, ASIDE.tolist()
    assert follow(guidance, positions, velocities, 1) == follow(fresh, positions, velocities, 1)


def test_an_inactive_guidance_begins_with_its_own_target():
    guidance = start(TO_A_PLACE[0], C2, divert_count=0, **PARAMETERS)
    guidance.divert_count, guidance.divert_position = 1, ASIDE.tolist()
    guidance.step(0.0, STEP)
    assert list(guidance.aim_position) == ASIDE.tolist()
    guidance.active = False
    guidance.step(STEP, STEP)
    guidance.active = True
    guidance.step(2 * STEP, STEP)
    assert list(guidance.aim_position) == C2.target.tolist()
