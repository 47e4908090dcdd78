"""Landing sequencer from the first hover on: targets, re-designations, plans and the descent to the ground.

Truth: the rules in docs/systems/landing_mission.md, with times and thresholds written out.
"""

import numpy as np
import pytest

from tests.support.flights.sequenced import CAPTURE, CENTRE, HOLD, OWN, PROGRAMME, RADIUS, SINK, SLOW, Flown, hovering


@pytest.mark.parametrize("phase", [4, 6])
def test_a_hover_lasts_20_seconds_and_then_until_it_is_settled(phase):
    flown = hovering(phase)
    if phase == 4:
        assert flown.step(300).phase == 4
        flown.see(hover_finished=True)
    begun = flown.time
    unsettled = hovering(phase, hover_finished=True)
    assert flown.until(phase + 1, 25.0) - begun == pytest.approx(20.0)
    unsettled.step(250, estimated_velocity=[0.51, 0.0, 0.0])
    assert unsettled.block.phase == phase
    target = np.array(unsettled.block.target_position)
    unsettled.step(50, estimated_velocity=[0.0] * 3, estimated_position=np.add(target, [10.1, 0.0, 0.0]).tolist())
    assert unsettled.block.phase == phase
    assert unsettled.step(estimated_position=np.add(target, [9.9, 0.0, 0.0]).tolist()).phase == phase + 1
    assert unsettled.block.status == 0


@pytest.mark.parametrize("phase", [4, 6])
def test_a_hover_that_does_not_settle_is_ended(phase):
    flown = hovering(phase, hover_finished=True)
    flown.step()
    flown.see(estimated_velocity=[1.0, 0.0, 0.0])
    assert flown.until(phase + 1, 65.0) == pytest.approx(60.0)
    assert flown.block.status == 3


@pytest.mark.parametrize(("speed", "offset", "mode"), [(0.4, 9.0, HOLD), (0.6, 0.0, CAPTURE), (0.0, 11.0, CAPTURE)])
def test_a_flight_that_starts_in_hover_1_is_captured_unless_it_is_at_rest_over_the_site(speed, offset, mode):
    """Within 0.5 m/s and 10 m it holds; decided with the first inputs, a cycle after the start."""
    flown = hovering(4)
    flown.see(estimated_velocity=[speed, 0.0, 0.0])
    flown.see(estimated_position=np.add(flown.block.target_position, [offset, 0.0, 0.0]).tolist())
    assert flown.block.hover_mode == HOLD
    assert flown.step().hover_mode == mode
    assert flown.block.plan_number == (1 if mode == HOLD else 2)
    assert flown.step(20).hover_mode == mode


def test_a_whole_flight_of_hovers():
    """From hover 1 on: targets over the sites of both re-designations, a plan for each, and a contact."""
    flown = hovering(4, hover_finished=True, redesignation_1=[-1200.0, 600.0], redesignation_2=[20.0, -10.0])
    flown.until(5, 21.0)
    block = flown.block
    assert (block.hover_mode, block.plan_number) == (PROGRAMME, 2)
    assert block.site == pytest.approx([-1200.0, 600.0, -(1200.0**2 + 600.0**2) / 2.0 / RADIUS], abs=1e-3)
    assert np.linalg.norm(block.target_position - CENTRE) == pytest.approx(RADIUS + 100.0)
    flown.step(50, hover_finished=False, redesignation_1=[0.0, 0.0])
    assert block.phase == 5
    flown.step(hover_finished=True, estimated_position=block.target_position)
    assert (block.phase, block.hover_mode, block.plan_number) == (6, HOLD, 3)
    flown.until(7, 21.0, hover_finished=False)
    assert (block.hover_mode, block.plan_number) == (SLOW, 4)
    assert block.site[:2] == pytest.approx((-1180.0, 590.0), abs=1e-3)
    assert np.linalg.norm(block.target_position - CENTRE) == pytest.approx(RADIUS + 4.0)
    flown.step(hover_finished=True)
    assert (block.phase, block.hover_mode) == (8, HOLD)
    begun = block.phase_time[7]
    while flown.step(estimated_position=block.target_position).hover_mode == HOLD:
        assert flown.time < begun + 4.0
    assert flown.time - begun == pytest.approx(3.0)
    assert (block.hover_mode, block.plan_number) == (SINK, 6)
    assert flown.step(30).phase == 8
    assert flown.step(probe_contact=True).phase == 9
    assert (block.engine_on, block.source, block.hover_active) == (False, OWN, False)
    up = np.array(block.target_position) - CENTRE
    assert block.thrust_direction == pytest.approx(up / np.linalg.norm(up), abs=1e-12)
    assert not flown.step(5).finished
    assert flown.step(ground_contact=True).finished
    assert block.status == 0
    assert [time >= 0.0 for time in block.phase_time] == [False] * 3 + [True] * 6


@pytest.mark.parametrize(("phase", "reach"), [(5, 2990.0), (7, 100.0)])
def test_a_redesignation_is_shortened_to_its_reach(phase, reach):
    for fraction, status in ((0.999, 0), (1.001, 1)):
        flown = Flown(phase, **{f"redesignation_{phase // 2 - 1}": [0.6 * fraction * reach, -0.8 * fraction * reach]})
        moved = np.array(flown.block.site)[:2]
        assert moved == pytest.approx(min(fraction, 1.0) * reach * np.array([0.6, -0.8]), abs=0.01)
        assert flown.block.status == status


def test_a_transfer_that_needs_too_much_goes_straight_down():
    """Over 440 kg dry mass with a reserve of 25: 490 kg allow 25 kg, not 25.1."""
    for needed, status in ((24.9, 0), (25.1, 5)):
        flown = Flown(5, redesignation_1=[500.0, 300.0], mass=490.0)
        block = flown.step(predicted_propellant=needed, hover_finished=False)
        assert block.status == status
        assert block.plan_number == (2 if status else 1)
        expected = [0.0, 0.0] if status else [500.0, 300.0]
        assert block.target_position[:2] == pytest.approx(expected, abs=0.05)
        flown.step(5, predicted_propellant=40.0)  # looked at once
        assert block.plan_number == (2 if status else 1)
        assert flown.step(hover_finished=True).phase == 6
