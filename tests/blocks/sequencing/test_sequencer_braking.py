"""Landing sequencer during braking: ignition of the engine, start of the hover, timeouts of phases.

Truth: the rules in docs/systems/landing_mission.md, with times and thresholds written out.
"""

import math

import numpy as np
import pytest

from tests.support.flights.sequenced import BRAKING, CAPTURE, CENTRE, HOVER, RADIUS, braking

NEAR = {"estimated_position": [1700.0, 0.0, 2770.0], "estimated_velocity": [-120.0, 0.0, -45.0]}
FAR = {"estimated_position": [12e3, 500.0, 1500.0], "estimated_velocity": [-40.0, 2.0, -3.0]}


@pytest.mark.parametrize(("off", "lit"), [(1.9, True), (2.1, False)])
def test_the_engine_waits_for_the_axis(off, lit):
    flown = braking(attitude=[math.cos(math.radians(off)), 0.0, math.sin(math.radians(off))])
    assert flown.step().engine_on == lit
    assert flown.block.source == BRAKING


def test_the_engine_does_not_wait_for_ever():
    flown = braking(attitude=[0.0, 0.0, 1.0])
    while not flown.step().engine_on:
        assert flown.time < 31.0
    assert flown.time == pytest.approx(30.0)
    assert flown.block.status == 3
    assert flown.block.phase == 3


def test_braking_ends_with_28_seconds_to_go():
    flown = braking(**NEAR)
    assert flown.step(3, braking_time_to_go=28.1).phase == 3
    block = flown.step(braking_time_to_go=28.0)
    assert (block.phase, block.source, block.hover_mode, block.status) == (4, HOVER, CAPTURE, 0)
    assert block.target_position == pytest.approx([0.0, 0.0, 2400.0], abs=1e-6)
    assert not block.braking_active


def test_braking_that_ends_elsewhere_moves_the_site():
    flown = braking(**FAR)
    assert flown.step(20, braking_time_to_go=27.0).phase == 3
    flown.step(20, braking_time_to_go=0.0)
    block = flown.step(estimated_velocity=[-29.0, 1.0, -3.0])
    assert (block.phase, block.hover_mode, block.status) == (4, CAPTURE, 4)
    place = np.array([12e3 - 8.0 * 29.0, 508.0, 1500.0 - 24.0])
    up = (place - CENTRE) / np.linalg.norm(place - CENTRE)
    assert block.site == pytest.approx(RADIUS * up + CENTRE, abs=1e-6)
    assert block.target_position == pytest.approx(place, abs=1e-6)  # between 300 m and H3: where it is


def test_braking_elsewhere_also_ends_when_its_guidance_does():
    flown = braking(**FAR)
    flown.step(5, braking_time_to_go=20.0)
    assert flown.step(braking_finished=True).phase == 4
    assert flown.block.status == 4


@pytest.mark.parametrize(("height", "captured"), [(60.0, 300.0), (5000.0, 2400.0)])
def test_a_hover_elsewhere_is_neither_low_nor_high(height, captured):
    flown = braking(estimated_position=[12e3, 0.0, height], estimated_velocity=[0.0] * 3, braking_time_to_go=5.0)
    block = flown.step()
    assert np.linalg.norm(block.target_position - CENTRE) - RADIUS == pytest.approx(captured, abs=1e-6)


def test_braking_without_a_solution_is_given_up_after_20_seconds():
    flown = braking(**NEAR, braking_status=3, braking_time_to_go=0.0)
    assert flown.until(4, 25.0) == pytest.approx(20.0)
    assert flown.block.status == 8
    assert flown.block.status_time[3] == -1.0


def test_a_solution_in_between_counts():
    flown = braking(**NEAR, braking_status=2)
    flown.step(150)
    flown.step(braking_status=1)
    assert flown.step(150, braking_status=2).phase == 3
    assert flown.until(4, 10.0) == pytest.approx(35.1)


def test_a_held_command_counts_down_to_the_hover():
    flown = braking(**NEAR, braking_status=2, braking_time_to_go=29.0)
    flown.step(50)
    assert flown.step(braking_time_to_go=27.9).phase == 4
    assert flown.block.status == 0


def test_braking_does_not_go_on_for_ever():
    flown = braking(**FAR)
    assert flown.until(4, 451.0) == pytest.approx(450.0)
    assert flown.block.status == 8
    assert flown.block.status_time[3] == pytest.approx(450.0)
