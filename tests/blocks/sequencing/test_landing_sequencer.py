"""Landing sequencer in all phases: permitted start phases, ends of a flight, status history, refusals.

Truth: the rules in docs/systems/landing_mission.md; and, for random inputs, invariants of every flight: phases only
advance, one at a time, the status is the highest so far, a re-designation stays within its reach, and targets are above
the site.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.block import Output
from perilune.fmus_src.sequencing.landing_sequencer import LandingSequencer
from tests.support.flights.sequenced import (
    BRAKING,
    CENTRE,
    HOLD,
    HOVER,
    IDLE,
    OWN,
    PROGRAMME,
    RADIUS,
    SLOW,
    Flown,
    H,
    at,
    braking,
    hovering,
)


def test_no_output_depends_on_an_input_of_its_time():
    outputs = [variable for variable in LandingSequencer.variables.values() if isinstance(variable, Output)]
    assert not any(output.direct for output in outputs)


@pytest.mark.parametrize(
    ("phase", "source", "engine_on", "mode", "height"),
    [
        (1, OWN, False, IDLE, None),
        (2, OWN, False, IDLE, None),
        (3, BRAKING, False, IDLE, None),
        (4, HOVER, True, HOLD, 2400.0),
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
            assert block.status_flags == sum(1 << (number - 1) for number in noted)
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


def test_a_divert_of_the_braking_moves_the_site_and_one_before_does_not():
    """The site is where the sphere meets the line from its centre to the target diverted to."""
    target = np.array([300.0, -400.0, 2400.0])
    flown = Flown(3, **at(0.1, 15e3), divert_count=1, divert_position=target.tolist())
    assert flown.step(5).site == [0.0, 0.0, 0.0]
    block = flown.step(3, divert_count=2)
    from_centre = target - CENTRE
    expected = RADIUS / np.linalg.norm(from_centre) * from_centre + CENTRE
    assert block.site == pytest.approx(expected.tolist(), abs=1e-6)
    assert flown.step(3, divert_position=[0.0, 0.0, 0.0]).site == pytest.approx(expected.tolist(), abs=1e-6)
