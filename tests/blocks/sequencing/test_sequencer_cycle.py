"""Decision cycle of the landing sequencer and its handshake with the guidances: which inputs are used, and when.

Truth: the same history of inputs with different communication steps must give the same decisions; the rules in
docs/systems/landing_mission.md.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.block import Output
from perilune.fmus_src.sequencing.landing_sequencer import LandingSequencer
from tests.support.flights.sequenced import BRAKING, HOLD, PROGRAMME, Flown, braking, hovering

OUTPUTS = [name for name, variable in LandingSequencer.variables.items() if isinstance(variable, Output)]


def outputs(block):
    return {name: np.array(getattr(block, name)).tolist() for name in OUTPUTS}


def descended(parts, probe, ground, cycle=0.1):
    """Return outputs at every tenth of a second of a descent in steps of 0.1 s/parts: contacts at their times (s)."""
    flown = hovering(8)
    block, history = flown.block, []
    block.cycle = cycle
    for n in range(60 * parts):
        time = n / (10 * parts)
        flown.see(probe_contact=time >= probe, ground_contact=time >= ground, mass=480.0 - 0.3 * time)
        flown.see(estimated_velocity=[0.0, 0.0, -0.01 * time], hover_plan=block.plan_number)
        block.step(time, 0.1 / parts)
        if (n + 1) % parts == 0:
            history.append(outputs(block))
    return history


@given(st.sampled_from([2, 5, 10]), st.floats(0.0, 5.0), st.floats(0.0, 1.0))
def test_decisions_do_not_depend_on_the_communication_step(parts, probe, fall):
    """Events of a flight in 0.1 s steps act at the same time in one of finer steps, to the bit."""
    coarse, fine = descended(1, probe, probe + fall), descended(parts, probe, probe + fall)
    for before, after in zip(coarse, fine, strict=True):
        for name in OUTPUTS:
            assert after[name] == pytest.approx(before[name], abs=1e-9), name
    assert coarse[-1]["phase"] == 9


def test_outputs_change_at_the_end_of_a_cycle_only():
    """A contact at 0.16 s is read at 0.2 s and acts at 0.32 s; without a cycle it acts at the next step."""
    flown = hovering(8)
    for n in range(6):  # of 0.04 s: cycles end at 0.12 and 0.2 s
        flown.see(probe_contact=n >= 4)
        flown.block.step(0.04 * n, 0.04)
        assert flown.block.phase == 8
    flown.block.step(0.24, 0.04)
    flown.block.step(0.28, 0.04)
    assert (flown.block.phase, flown.block.phase_time[8]) == (9, pytest.approx(0.32))
    at_once = Flown(8, probe_contact=True)
    at_once.block.cycle = 0.0
    at_once.block.step(0.0, 0.04)
    assert at_once.block.phase == 9


@pytest.mark.parametrize("phase", [4, 5, 7])
def test_nothing_of_an_earlier_plan_is_acted_on(phase):
    """The old plan is over, bad and dear: the new one is flown to its own end nevertheless."""
    flown = hovering(phase, mass=490.0)
    said = {"hover_finished": True, "hover_status": 2, "predicted_propellant": 100.0}
    flown.step(300, answers=False, hover_plan=0, **said)
    block = flown.block
    assert (block.phase, block.status, block.plan_number) == (phase, 0, 1)
    flown.step(20, answers=True, hover_finished=False, hover_status=0, predicted_propellant=10.0)
    assert (block.phase, block.status) == (phase, 0)
    after = flown.until(phase + 1, 21.0, hover_finished=True)
    assert after >= 32.0
    assert block.status == 0


def test_a_guidance_may_take_its_time_to_answer():
    """The transfer's propellant is looked at with the answer, and a plan that replaces it waits for its own."""
    flown = Flown(5, redesignation_1=[500.0, 300.0], mass=490.0)
    block = flown.step(7, answers=False, hover_finished=True, predicted_propellant=0.0)
    assert (block.phase, block.status, block.plan_number) == (5, 0, 1)
    block = flown.step(hover_plan=1, hover_finished=False, predicted_propellant=30.0)
    assert (block.status, block.plan_number, block.hover_mode) == (5, 2, PROGRAMME)
    assert flown.step(5, hover_finished=True).phase == 5
    assert flown.step(hover_plan=2).phase == 6
    assert (block.hover_mode, block.plan_number) == (HOLD, 3)


def test_braking_waits_for_a_command_of_its_own_time():
    """Before its first sample a braking guidance says no time to go, which is not the end of the braking."""
    flown = braking(braking_time_to_go=0.0, estimated_position=[0.0, 0.0, 2400.0])
    flown.block.phase_time[2] = 0.05
    block = flown.step(40, answers=False, braking_command_time=0.0, braking_finished=True)
    assert (block.phase, block.source, block.engine_on, block.status) == (3, BRAKING, False, 0)
    block = flown.step(braking_command_time=4.0, braking_time_to_go=300.0, braking_finished=False)
    assert (block.phase, block.engine_on, block.status) == (3, True, 0)
    assert flown.step(braking_time_to_go=28.0).phase == 4


@pytest.mark.parametrize("phase", range(3, 9))
def test_the_mass_of_a_phase_is_that_of_its_time(phase):
    """In steps during which the mass falls: what the vehicle weighs when the phase begins."""
    flown = hovering(phase) if phase > 3 else braking()
    flown.see(hover_finished=True, probe_contact=True, braking_finished=phase == 3)
    for n in range(700):
        flown.step(mass=600.0 - 0.1 * n)
    for begun, weighed in zip(flown.block.phase_time, flown.block.phase_mass, strict=True):
        if begun >= 0.0:
            assert weighed == pytest.approx(600.0 - begun, abs=1e-6)
    assert sum(time >= 0.0 for time in flown.block.phase_time) > 1


def test_no_status_hides_another():
    flown = hovering(6, hover_finished=True, estimated_velocity=[1.0, 0.0, 0.0])
    flown.until(7, 65.0)
    assert (flown.block.status, flown.block.status_flags) == (3, 0b100)
    flown.step(hover_status=1)
    assert (flown.block.status, flown.block.status_flags) == (3, 0b110)
    flown.step(ground_contact=True)
    assert (flown.block.status, flown.block.status_flags) == (6, 0b100110)
