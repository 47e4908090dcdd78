"""Input `active` of the terminal guidances: a guidance waits, starts when activated, and can be restarted.

Truth: the same guidance without waiting. Activated at t it equals a new guidance started at t, to the bit, over a
complete descent; always active it equals a guidance whose input is not set; inactive it commands nothing.
"""

import numpy as np
import pytest

from perilune.fmus_src.guidance.network_operator import NetworkOperatorGuidance
from tests.support.descent.laws import DESCENT_LAWS
from tests.support.flights.linear_thrust import POSITION, VELOCITY
from tests.support.flights.terminal_guidance import ALL, command_of, see

LAWS = [*ALL, *DESCENT_LAWS, NetworkOperatorGuidance]
START = 37.0
STEP = 0.5


def states(guidance_class):
    """Return a path to the target, sampled every step; the network operator's band is 1200 to 1800 m."""
    fraction = np.linspace(1.0, 0.0, 40)[:, None]
    target = np.array([0.0, 0.0, 1500.0 if guidance_class is NetworkOperatorGuidance else 2000.0])
    return target + fraction**2 * (POSITION - target), fraction * VELOCITY


def outputs(guidance):
    timing = [guidance.command_time, guidance.burn_duration, guidance.time_to_go, guidance.status, guidance.finished]
    return [*command_of(guidance), *timing]


def fresh(guidance_class, **parameters):
    """Return outputs of a guidance that is started at START, with its input left alone."""
    positions, velocities = states(guidance_class)
    guidance = guidance_class(mass=940.0, **parameters)
    guidance.start_time = START
    see(guidance, positions[0], velocities[0])
    guidance.initialize()
    rows = [outputs(guidance)]
    for k in range(1, len(positions)):
        see(guidance, positions[k], velocities[k])
        guidance.step(START + (k - 1) * STEP, STEP)
        rows.append(outputs(guidance))
    return rows


def told(guidance, **parameters):
    """Return outputs of a guidance in flight that is activated at START."""
    positions, velocities = states(type(guidance))
    guidance.active = True
    rows = []
    for k in range(len(positions)):
        see(guidance, positions[k], velocities[k])
        guidance.step(START + (k - 1) * STEP, STEP)
        rows.append(outputs(guidance))
    return rows


@pytest.mark.parametrize("parameters", [{}, {"gravity_correction": True, "terminal_step": 1}, {"sample_period": STEP}])
@pytest.mark.parametrize("guidance_class", LAWS)
def test_activated_in_flight_it_is_a_fresh_one(guidance_class, parameters):
    guidance = guidance_class(mass=940.0, active=False, **parameters)
    guidance.initialize()
    for k in range(20):
        see(guidance, [1e3 * k, -5.0, 3e3], [-10.0, 0.0, 1.0])
        guidance.step(START - 10.5 + STEP * k, STEP)
    expected = fresh(guidance_class, **parameters)
    assert told(guidance) == expected
    assert any(row[0] > 0.0 for row in expected)


@pytest.mark.parametrize("guidance_class", LAWS)
def test_inactive_it_commands_nothing_and_forgets(guidance_class):
    guidance = guidance_class(mass=940.0)
    see(guidance, 0.8 * POSITION, VELOCITY)
    guidance.initialize()
    for k in range(10):
        guidance.step(k * STEP, STEP)
    assert guidance.thrust_acceleration > 0.0
    guidance.active = False
    for k in range(10, 20):
        guidance.step(k * STEP, STEP)
        assert [guidance.thrust_acceleration, guidance.time_to_go, guidance.status, guidance.finished] == [0.0] * 4
    assert told(guidance) == fresh(guidance_class)


@pytest.mark.parametrize("guidance_class", LAWS)
def test_active_all_along_is_the_default(guidance_class):
    rows = []
    for settings in ({}, {"active": True}):
        positions, velocities = states(guidance_class)
        guidance = guidance_class(mass=940.0, **settings)
        see(guidance, positions[0], velocities[0])
        guidance.initialize()
        flown = [outputs(guidance)]
        for k in range(1, len(positions)):
            see(guidance, positions[k], velocities[k])
            guidance.step((k - 1) * STEP, STEP)
            flown.append(outputs(guidance))
        rows.append(flown)
    assert rows[0] == rows[1]
