"""Terminal guidances: start, held command and end of a flight.

Truth: the contract of the interface: the time to go is counted down while a command is held, and a flight stops within
one cycle of its end or holds the last command for the remaining time.
"""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.guidance.astar import AstarGuidance
from tests.support.flights.linear_thrust import POSITION, VELOCITY
from tests.support.flights.terminal_guidance import (
    ALL,
    CLAMPED,
    EXACT,
    GOOD,
    NO_SOLUTION,
    NOT_CONVERGED,
    STOPPING,
    command_of,
    commanded,
    rootless_state,
    see,
)
from tests.support.lengths import either


@pytest.mark.parametrize("guidance_class", STOPPING)
def test_declared_starts_alone_initialise_and_step(guidance_class):
    """At rest below the target: no approach, so nothing is commanded."""
    guidance = guidance_class()
    guidance.initialize()
    assert guidance.thrust_acceleration == 0.0
    assert guidance.time_to_go == 0.0
    assert not guidance.finished
    guidance.step(0.0, 0.1)
    assert guidance.thrust_acceleration == 0.0
    assert not guidance.finished


@pytest.mark.parametrize("guidance_class", ALL)
@given(
    position=st.lists(st.sampled_from([-2000.0, 0.0, 1e-9, 1.0, 2000.0, 1e5]), min_size=3, max_size=3),
    velocity=st.lists(st.sampled_from([-950.0, -1.0, 0.0, 1e-9, 1.0, 950.0]), min_size=3, max_size=3),
    gravity=st.sampled_from([0.0, 1.62]),
)
@settings(max_examples=either(150, 37), deadline=None)
def test_initialise_and_step_are_total(guidance_class, position, velocity, gravity):
    """Any state, at the target, at rest, receding, vertical: no fault, no value that is not a number."""
    guidance = commanded(guidance_class, position, velocity, gravity=gravity)
    guidance.step(0.0, 0.5)
    assert all(math.isfinite(value) for value in [*command_of(guidance), guidance.time_to_go, guidance.burn_duration])
    assert guidance.status in (GOOD, CLAMPED, NOT_CONVERGED, NO_SOLUTION)


@pytest.mark.parametrize("guidance_class", ALL)
def test_command_time_is_the_end_of_the_step(guidance_class):
    guidance = commanded(guidance_class)
    assert guidance.command_time == 0.0
    guidance.step(0.0, 0.25)
    assert guidance.command_time == 0.25
    guidance.step(12.5, 0.25)
    assert guidance.command_time == 12.75


def test_without_convergence_from_the_start_nothing_is_commanded():
    guidance = commanded(AstarGuidance, *rootless_state())
    assert guidance.status == NOT_CONVERGED
    assert guidance.thrust_acceleration == 0.0
    guidance.step(0.0, 0.5)
    assert guidance.status == NOT_CONVERGED
    assert not guidance.finished


def test_without_convergence_the_last_command_is_held_and_time_counts_down():
    guidance = commanded(AstarGuidance)
    guidance.step(0.0, 0.5)
    held, time = command_of(guidance), guidance.time_to_go
    see(guidance, *rootless_state())
    for k in range(1, 6):
        guidance.step(0.5 * k, 0.5)
        assert guidance.status == NOT_CONVERGED
        assert command_of(guidance) == held
        assert guidance.command_time == 0.5
        assert guidance.time_to_go == pytest.approx(time - 0.5 * k, rel=1e-12)
    see(guidance, POSITION, VELOCITY)
    guidance.step(3.0, 0.5)
    assert guidance.status == GOOD
    assert guidance.command_time == 3.5


def test_a_held_command_finishes_when_its_time_has_run_out():
    guidance = commanded(AstarGuidance)
    time = guidance.time_to_go
    see(guidance, *rootless_state())
    cycles = 0
    while not guidance.finished:
        guidance.step(10.0 * cycles, 10.0)
        cycles += 1
        assert cycles < 30
    assert cycles == math.floor(time / 10.0)
    assert guidance.thrust_acceleration == 0.0


@pytest.mark.parametrize("guidance_class", STOPPING)
def test_stop_finishes_when_less_than_a_cycle_is_left(guidance_class):
    """Cycles just longer and just shorter than the time-to-go of the state seen."""
    time = commanded(guidance_class).time_to_go
    longer, shorter = commanded(guidance_class), commanded(guidance_class)
    longer.step(0.0, 0.999 * time)
    assert not longer.finished
    assert longer.thrust_acceleration > 0.0
    shorter.step(0.0, 1.001 * time)
    assert shorter.finished
    assert shorter.thrust_acceleration == 0.0
    assert shorter.time_to_go == pytest.approx(time, rel=1e-9)
    frozen = command_of(shorter)
    see(shorter, 2.0 * POSITION, VELOCITY)
    shorter.step(1.001 * time, 0.1)
    assert shorter.finished
    assert command_of(shorter) == frozen


@pytest.mark.parametrize("guidance_class", ALL)
def test_cycle_is_the_sample_period_where_one_is_given(guidance_class):
    """Called once a sample period, whatever the communication step that the call is made with."""
    time = commanded(guidance_class).time_to_go
    guidance = commanded(guidance_class, sample_period=1.5 * time)
    guidance.step(1.5 * time - 0.1, 0.1)
    assert guidance.finished  # less than a cycle was left, or the burn timed at the start is over


@pytest.mark.parametrize("guidance_class", EXACT)
def test_exact_times_the_last_burn_and_then_finishes(guidance_class):
    guidance = commanded(guidance_class)
    time = guidance.time_to_go
    guidance.step(0.0, 0.5 * time)
    assert guidance.burn_duration > 1e6  # more than a cycle left: unlimited
    guidance.step(0.5 * time, 1.01 * time)
    assert guidance.burn_duration == guidance.time_to_go == pytest.approx(time, rel=1e-12)
    assert not guidance.finished
    assert guidance.thrust_acceleration > 0.0
    guidance.step(1.51 * time, 1.01 * time)
    assert guidance.finished
    assert command_of(guidance)[0] == 0.0
    assert guidance.burn_duration == 0.0
    assert guidance.time_to_go == 0.0


@pytest.mark.parametrize("guidance_class", STOPPING)
def test_terminal_step_can_be_chosen_for_every_guidance(guidance_class):
    guidance = commanded(guidance_class, terminal_step=1)
    assert guidance.burn_duration == guidance.time_to_go
    time = guidance.time_to_go
    guidance.step(0.0, 0.5 * time)
    assert guidance.burn_duration > 1e6
    guidance.step(0.5 * time, 1.01 * time)
    assert guidance.burn_duration == guidance.time_to_go
    assert not guidance.finished


def test_a_held_command_finishes_when_its_time_is_a_whole_number_of_cycles():
    guidance = commanded(AstarGuidance)
    guidance.time_to_go = 1.0
    see(guidance, *rootless_state())
    for k in range(8):
        guidance.step(0.25 * k, 0.25)
    assert guidance.finished


def test_a_held_command_of_an_exact_flight_ends_its_burn():
    guidance = commanded(AstarGuidance, terminal_step=1)
    guidance.step(0.0, 10.0)
    end = guidance.command_time + guidance.time_to_go
    see(guidance, *rootless_state())
    ends = []
    for k in range(1, 40):
        guidance.step(10.0 * k, 10.0)
        if guidance.burn_duration < 1e6 and not guidance.finished:
            ends.append(guidance.command_time + guidance.burn_duration)
    assert guidance.finished
    assert ends == pytest.approx([end, end], rel=1e-9)  # timed in the last two cycles
