"""The landing sequencer against the table of its phases: every transition, every timeout, every refusal.

Truth: the rules as docs/systems/landing_mission.md has them, with times and thresholds written out; the burn's length
from the ellipse's own speeds; and, over random inputs, what must hold of any flight: phases only go on, one at a time,
the status is the largest so far, a re-designation stays within its reach, targets lie above the site.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.block import Output
from perilune.fmus_src.sequencing.landing_sequencer import LandingSequencer

H = 0.1
RADIUS = 1.7374e6
MU = 4.9028e12
ORBIT = RADIUS + 1e5
CENTRE = np.array([0.0, 0.0, -RADIUS])
SPEED = math.sqrt(MU / ORBIT)
OWN, BRAKING, HOVER = 1, 2, 3
IDLE, HOLD, PROGRAMME, SLOW, CAPTURE, SINK = range(6)


def at(angle, altitude=1e5, speed=SPEED):
    """Estimate at a central angle on the way to smaller ones."""
    place = (RADIUS + altitude) * np.array([math.sin(angle), 0.0, math.cos(angle)]) + CENTRE
    return {
        "estimated_position": place.tolist(),
        "estimated_velocity": [-speed * math.cos(angle), 0.0, speed * math.sin(angle)],
    }


class Flown:
    """A sequencer in flight."""

    def __init__(self, start_phase, **values):
        self.block = LandingSequencer(start_phase=start_phase, mass=values.pop("mass", 600.0))
        self.see(**values)
        self.time = 0.0
        self.block.initialize()

    def see(self, **values):
        for name, value in values.items():
            setattr(self.block, name, value)

    def step(self, count=1, **values):
        """So many steps with these inputs; returns the block."""
        self.see(**values)
        for _ in range(count):
            self.block.step(self.time, H)
            self.time = round(self.time + H, 9)
        return self.block

    def until(self, phase, most, **values):
        """Step until the phase has come; the time of it."""
        self.see(**values)
        for _ in range(round(most / H) + 1):
            if self.block.phase == phase:
                return self.block.phase_time[phase - 1]
            self.step()
        raise AssertionError(f"phase {phase} has not come, but {self.block.phase}")


def hovering(phase, **values):
    """In a hover phase, at its target and at rest."""
    flown = Flown(phase, **values)
    flown.see(estimated_position=flown.block.target_position)
    return flown


def test_no_output_depends_on_an_input_of_its_time():
    outputs = [variable for variable in LandingSequencer.variables.values() if isinstance(variable, Output)]
    assert not any(output.direct for output in outputs)


@pytest.mark.parametrize(
    ("phase", "source", "engine_on", "mode", "height"),
    [
        (1, OWN, False, IDLE, None),
        (2, OWN, False, IDLE, None),
        (3, BRAKING, False, IDLE, None),
        (4, HOVER, True, CAPTURE, 2400.0),
        (5, HOVER, True, PROGRAMME, 100.0),
        (6, HOVER, True, HOLD, 100.0),
        (7, HOVER, True, SLOW, 4.0),
        (8, HOVER, True, HOLD, 4.0),
        (9, OWN, False, IDLE, None),
    ],
)
def test_any_phase_can_be_the_first(phase, source, engine_on, mode, height):
    flown = Flown(phase, mass=523.0, estimated_position=[0.0, 0.0, 4.0])
    block = flown.block
    assert (block.phase, block.source, block.engine_on, block.hover_mode) == (phase, source, engine_on, mode)
    assert (block.braking_active, block.hover_active) == (source == BRAKING, source == HOVER)
    assert block.plan_number == (1 if source == HOVER else 0)
    assert block.thrust_direction == (0.0, 0.0, 0.0)
    if height is not None:
        assert block.target_position == pytest.approx([0.0, 0.0, height], abs=1e-6)
    flown.step(mass=521.0)
    assert block.phase_time[phase - 1] == 0.0
    assert block.phase_mass[phase - 1] == 521.0
    assert block.status == 0
    assert not block.finished


def test_the_deorbit_is_timed_so_that_braking_begins_at_its_range():
    """On the circle: waits, ignites half a burn early, and commands until the ellipse is reached."""
    rate = SPEED / ORBIT
    flown = Flown(1, mass=946.0)
    first = math.pi + 285e3 / RADIUS + 60.0 * rate
    slow = math.sqrt(2.0 * MU * (RADIUS + 15e3) / (ORBIT * (ORBIT + RADIUS + 15e3)))
    burn = (SPEED - slow) / (0.1 * 5099.0 / 946.0)
    for n in range(2000):
        block = flown.step(**at(first - rate * flown.time))
        if block.engine_on:
            break
        assert block.thrust_acceleration == 0.0
        # against the velocity, and turning with it, at the time of the estimate
        angle = first - rate * n * H
        assert block.command_time == pytest.approx(n * H)
        assert block.thrust_direction == pytest.approx([math.cos(angle), 0.0, -math.sin(angle)], abs=1e-9)
        assert block.thrust_direction_rate == pytest.approx(
            [rate * math.sin(angle), 0.0, rate * math.cos(angle)], abs=1e-9
        )
    assert flown.time == pytest.approx(60.0 - burn / 2.0, abs=0.2)
    assert burn == pytest.approx(36.1, abs=0.1)
    assert block.thrust_acceleration == pytest.approx(509.9 / 946.0)
    assert block.burn_duration == pytest.approx(burn + H, abs=1e-6)  # from ignition, a step after the estimate
    ignition = flown.time
    while block.engine_on:
        speed = SPEED - 509.9 / 946.0 * (flown.time - ignition)
        held = block.command_time + block.burn_duration - flown.time
        end = block.command_time + block.burn_duration
        flown.step(**at(first - rate * flown.time, speed=speed))
        if block.engine_on:
            moved = block.command_time + block.burn_duration - end
            assert abs(moved) < 1e-6
            assert block.command_time == pytest.approx(flown.time - H if held > 1.0 + H else block.command_time)
    assert flown.time == pytest.approx(ignition + burn, abs=H)
    assert block.phase == 2
    assert block.status == 0


def test_a_deorbit_that_does_not_slow_down_is_ended():
    flown = Flown(1, **at(math.pi))
    flown.see(mass=946.0)
    ignition = flown.step().phase_time[0] + H
    end = flown.until(2, 100.0)
    slow = math.sqrt(2.0 * MU * (RADIUS + 15e3) / (ORBIT * (ORBIT + RADIUS + 15e3)))
    planned = (SPEED - slow) / (0.1 * 5099.0 / 946.0)
    assert end - ignition == pytest.approx(2.0 * planned, abs=1.5 * H)
    assert flown.block.status == 3
    assert flown.block.status_time[2] == end


def test_who_is_slow_enough_goes_on_to_the_coast_at_once():
    flown = Flown(1, **at(math.pi, speed=1600.0))
    assert flown.until(2, 1.0) <= 2 * H
    assert flown.block.status == 0


@pytest.mark.parametrize(("angle", "comes"), [(math.pi, False), (0.2, False), (284e3 / RADIUS, True)])
def test_the_coast_ends_at_the_range(angle, comes):
    flown = Flown(2, **at(angle, altitude=15e3, speed=1690.0))
    block = flown.step()
    assert block.phase == (3 if comes else 2)
    assert block.status == 0
    assert not block.engine_on


def test_a_coast_that_comes_too_low_is_ended():
    flown = Flown(2, **at(1.0, altitude=12.1e3))
    assert flown.step().phase == 2
    assert flown.step(**at(1.0, altitude=11.9e3)).phase == 3
    assert flown.block.status == 3


def braking(**values):
    flown = Flown(3, **at(0.16, altitude=15e3))
    flown.see(attitude=[1.0, 0.0, 0.0], braking_direction=[1.0, 0.0, 0.0], braking_time_to_go=340.0)
    flown.see(**values)
    return flown


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


NEAR = {"estimated_position": [1700.0, 0.0, 2770.0], "estimated_velocity": [-120.0, 0.0, -45.0]}
FAR = {"estimated_position": [12e3, 500.0, 1500.0], "estimated_velocity": [-40.0, 2.0, -3.0]}


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
    flown = hovering(phase, hover_finished=True, estimated_velocity=[1.0, 0.0, 0.0])
    assert flown.until(phase + 1, 65.0) == pytest.approx(60.0)
    assert flown.block.status == 3


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
    for share, status in ((0.999, 0), (1.001, 1)):
        flown = Flown(phase, **{f"redesignation_{phase // 2 - 1}": [0.6 * share * reach, -0.8 * share * reach]})
        moved = np.array(flown.block.site)[:2]
        assert moved == pytest.approx(min(share, 1.0) * reach * np.array([0.6, -0.8]), abs=0.01)
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


@pytest.mark.parametrize("seen", [{"estimated_position": [0.0, 0.0, 0.49]}, {"ground_contact": True}])
def test_without_a_probe_the_engine_is_cut_off_at_the_ground(seen):
    flown = hovering(8)
    assert flown.step(50).phase == 8
    assert flown.step(**seen).phase == 9
    assert flown.block.status == 6
    assert not flown.block.engine_on


@pytest.mark.parametrize("phase", range(1, 8))
def test_ground_contact_ends_any_flight(phase):
    flown = Flown(phase, **at(1.0))
    assert flown.step(ground_contact=True).phase == 9
    assert flown.block.status == 6
    assert flown.step().finished


@pytest.mark.parametrize("said", [1, 2, 3])
def test_what_the_hover_guidance_says_is_remembered(said):
    flown = hovering(6)
    assert flown.step(hover_status=said).status == 2
    flown = braking()
    assert flown.step(hover_status=said).status == 0


def test_an_empty_tank_is_remembered_and_the_flight_goes_on():
    flown = hovering(6)
    assert flown.step(mass=440.0).status == 7
    assert flown.block.phase == 6
    assert flown.block.status_time[6] == H


def test_flight_is_free_two_seconds_after_the_engine_until_it_burns_again():
    flown = Flown(2, **at(2.0))
    free = []
    for _ in range(40):
        free.append(flown.step().free_flight)
    assert free.index(True) == 19  # holds from 2.0 s on
    flown.step(**at(0.16, altitude=15e3), attitude=[0.0, 0.0, 1.0], braking_direction=[1.0, 0.0, 0.0])
    assert flown.block.phase == 3
    assert flown.step(5).free_flight
    assert not flown.step(attitude=[1.0, 0.0, 0.0]).free_flight
    assert flown.block.engine_on
    for phase in range(4, 10):
        assert not hovering(phase).step(40).free_flight


def test_a_burn_ends_free_flight_and_two_seconds_after_it_flight_is_free():
    flown = Flown(1, **at(math.pi), mass=946.0)
    assert flown.step().engine_on
    assert flown.step(50).phase == 1
    flown.step(**at(math.pi, speed=1600.0))
    assert flown.block.phase == 2
    end = flown.time
    while not flown.step(**at(3.0, speed=1600.0)).free_flight:
        assert flown.time < end + 3.0
    assert flown.time - end == pytest.approx(2.0)


REFUSED = [
    {"start_phase": 0},
    {"start_phase": 10},
    {"start_phase": -3},
    {"minimum_thrust": 5099.0},
    {"minimum_thrust": 645.0},
    {"preliminary_altitude": 100.0},
    {"cutoff_altitude": 100.0},
    {"cutoff_altitude": 1.5},
    {"probe_length": 4.0},
    {"braking_range": math.nan},
    {"dry_mass": math.inf},
    {"preliminary_altitude": math.inf},
    {"hover_time": math.inf},
    {"redesignation_1": [math.nan, 0.0]},
]


@pytest.mark.parametrize("values", REFUSED, ids=lambda values: "".join(f"{k}={v}" for k, v in values.items()))
def test_what_makes_no_landing_is_refused_at_once(values):
    block = LandingSequencer(**({"start_phase": 1} | values))
    block.initialize()
    assert (block.phase, block.status, block.finished, block.source) == (0, 9, True, 0)
    assert block.status_time[8] == 0.0
    block.step(0.0, H)
    assert (block.phase, block.status, block.finished) == (0, 9, True)


def test_least_thrust_just_below_the_weight_is_taken():
    block = LandingSequencer(minimum_thrust=643.0)  # 0.9 of 440 kg times 1.6242 m/s2 is 643.2 N
    block.initialize()
    assert block.status == 0


lengths = st.floats(-4e3, 4e3)
inputs = st.fixed_dictionaries(
    {
        "estimated_position": st.one_of(
            st.sampled_from([0.1, 0.3, 2.0]).map(lambda angle: at(angle, altitude=14e3)["estimated_position"]),
            st.tuples(lengths, lengths, st.floats(-10.0, 5e3)).map(list),
        ),
        "estimated_velocity": st.sampled_from([[0.0] * 3, [-100.0, 0.0, -20.0], [-1690.0, 0.0, 100.0]]),
        "mass": st.floats(430.0, 946.0),
        "attitude": st.sampled_from([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]),
        "braking_direction": st.sampled_from([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]),
        "braking_time_to_go": st.sampled_from([0.0, 27.0, 300.0]),
        "braking_status": st.integers(0, 3),
        "braking_finished": st.booleans(),
        "hover_finished": st.booleans(),
        "hover_status": st.integers(0, 3),
        "predicted_propellant": st.floats(0.0, 60.0),
        "probe_contact": st.sampled_from([False, False, True]),
        "ground_contact": st.sampled_from([False] * 5 + [True]),
        "redesignation_1": st.tuples(lengths, lengths).map(list),
        "redesignation_2": st.tuples(lengths, lengths).map(list),
    }
)
flights = st.lists(st.tuples(inputs, st.sampled_from([1, 2, 210, 700])), min_size=1, max_size=8)


@given(st.integers(1, 9), flights)
def test_what_holds_of_any_flight(start, flight):
    flown = Flown(start)
    block = flown.block
    phase, status, site = block.phase, block.status, np.array(block.site)
    for values, count in flight:
        flown.see(**values)
        for _ in range(count):
            flown.step()
            assert block.phase - phase in (0, 1) or (block.phase == 9 and values["ground_contact"])
            assert block.status >= status
            noted = [number for number, time in enumerate(block.status_time, 1) if time >= 0.0]
            assert block.status == max(noted, default=0)
            times = [time for time in block.phase_time if time >= 0.0]
            assert times == sorted(times)
            assert len(times) <= 10 - start
            moved = np.linalg.norm(np.array(block.site) - site)
            if moved > 0.0 and block.phase in (5, 7) and block.phase != phase:
                assert moved <= {5: 2990.0, 7: 100.0}[block.phase] * (1.0 + 1e-6) + 1.0
            assert np.linalg.norm(block.site - CENTRE) == pytest.approx(RADIUS, abs=1e-6)
            if block.hover_active:
                up, high = np.array(block.site) - CENTRE, np.array(block.target_position) - CENTRE
                assert np.linalg.norm(np.cross(up, high)) <= 1e-9 * RADIUS**2
                assert block.engine_on
            assert block.engine_on or block.phase in (1, 2, 3, 9)
            assert not (block.free_flight and (block.engine_on or block.phase > 3))
            phase, status, site = block.phase, block.status, np.array(block.site)
            if block.finished:
                assert phase == 9
                return
