"""Pulse allocation with a carried remainder: properties for any demands, and a worked sequence.

Truth: the sum of the demands; a sequence computed by another program.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.actuators.pulse_allocation import PulseAllocation

TICK, LEAST = 0.2, 0.03
LEVELS = np.array([60.0, 120.0, 120.0])
demand = st.floats(-150.0, 150.0) | st.floats(-20.0, 20.0) | st.just(0.0)
demands = st.lists(st.tuples(demand, demand, demand), min_size=1, max_size=60)


def fired(commands, **parameters):
    """Return pulses and rests of a block with these commands, one a tick."""
    block = PulseAllocation(torque_command=commands[0], **parameters)
    block.initialize()
    rows = [[*block.pulse_lengths, *block.remainder]]
    for k, command in enumerate(commands[1:]):
        block.torque_command = command
        block.step(TICK * k, TICK)
        rows.append([*block.pulse_lengths, *block.remainder])
    return np.array(rows)[:, :3], np.array(rows)[:, 3:], block


def test_a_worked_sequence():
    lengths, _, block = fired([[7, 7, -7]] * 3 + [[70, -20, 5], [2, -20, 5]])
    expected = [[0, 0, 0], [0.0466667, 0, 0], [0, 0.035, -0.035], [0.2, -0.0333333, 0], [0, -0.0333333, 0]]
    assert lengths == pytest.approx(np.array(expected), abs=5e-8)
    assert block.pulse_count == 5


@given(demands)
def test_no_pulse_is_shorter_than_the_least_or_longer_than_the_tick(commands):
    lengths, rests, _ = fired(commands)
    sizes = np.abs(lengths[lengths != 0.0])
    assert ((sizes >= LEAST) & (sizes <= TICK)).all()
    assert (np.abs(rests) < LEAST).all()


@given(demands)
def test_what_is_fired_is_what_is_demanded_but_for_a_least_pulse(commands):
    """Outside full ticks: less than one least pulse from the start, less than two over any window."""
    lengths, _, _ = fired(commands)
    desired = np.array(commands) * TICK / LEVELS
    for axis in range(3):
        short = np.flatnonzero(np.abs(lengths[:, axis]) == TICK)
        first, last = (short[-1] + 1 if short.size else 0), len(commands)
        missing = np.cumsum((desired - lengths)[first:last, axis])
        assert (np.abs(missing) < LEAST + 1e-12).all()
        for start in range(len(missing)):
            assert (np.abs(missing[start:] - missing[start]) < 2.0 * LEAST + 1e-12).all()


def test_a_full_tick_forgets_what_it_cannot_fire():
    lengths, rests, block = fired([[1000.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    assert lengths[:, 0].tolist() == [TICK, 0.0]
    assert rests.tolist() == [[0.0] * 3] * 2
    assert block.status == 0
    assert fired([[1000.0, 0.0, 0.0]])[2].status == 1


def test_without_a_least_pulse_nothing_is_carried():
    lengths, rests, _ = fired([[1.0, -2.0, 3.0], [-4.0, 5.0, 0.0]], shortest_pulse=0.0)
    assert lengths == pytest.approx(np.array([[1, -2, 3], [-4, 5, 0]]) * TICK / LEVELS)
    assert rests == pytest.approx(np.zeros((2, 3)))


def test_the_mean_is_passed_within_the_levels():
    lengths, _, block = fired([[7.0, -150.0, 3.0]], mean=True)
    assert not lengths.any()
    assert [*block.mean_torque] == [7.0, -120.0, 3.0]
    assert block.status == 1


def test_a_demand_that_is_no_number_fires_nothing_and_keeps_the_rest():
    lengths, rests, block = fired([[7.0, 7.0, -7.0], [math.nan, 1.0, 1.0]])
    assert not lengths[1].any()
    assert rests[1].tolist() == rests[0].tolist()
    assert block.status == 2
