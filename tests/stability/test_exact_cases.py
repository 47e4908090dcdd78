"""Complete studies of systems of FMUs with exactly known loops, with control at every step and at every fourth step.

Truth: python-control on state spaces written without the FMUs (zero-order hold of the continuous plant). The required
agreement is 0.1 dB and 0.5 deg, far above rounding errors.
"""

from dataclasses import replace

import numpy as np
import pytest

import perilune
from tests.support.loops.exact_margins import crossings, disk_margin, opened
from tests.support.loops.exact_systems import coupled_pair, late_double_integrator, pendulum, resonance
from tests.support.loops.sampled_loops import outside, response_of

DECIBEL = 20.0 / np.log(10.0)
SYSTEMS = {
    f"{make.__name__}, control at every {every}": (make, every)
    for make in (late_double_integrator, resonance, pendulum, coupled_pair)
    for every in (1, 4)
}
SINGLE = [name for name in SYSTEMS if "pair" not in name]
PAIRS = [name for name in SYSTEMS if "pair" in name]
UNSTABLE = {"pendulum": 1}
GAIN_CROSSOVERS = {"late_double_integrator": 1, "resonance": 2, "pendulum": 1}


@pytest.fixture(scope="module")
def studied(exact_fmus, tmp_path_factory):
    """Study each system once; return it with its report."""
    actual = {}

    def study(name):
        if name not in actual:
            make, every = SYSTEMS[name]
            exact = make(every)
            actual[name] = exact, perilune.stability(exact.packed(tmp_path_factory.mktemp("systems"), exact_fmus))
        return actual[name]

    return study


def assert_classical(actual, loop):
    """Assert every crossing to 1e-3 dB and 1e-3 deg."""
    gain, phase, frequency = crossings(loop)
    assert len(actual.gain) == len(gain)
    ratio = np.array([crossing.value for crossing in actual.gain]) / gain
    assert abs(DECIBEL * np.log(ratio)).max() < 1e-3
    assert len(actual.phase) == len(phase)
    assert np.degrees([crossing.value for crossing in actual.phase]) == pytest.approx(np.degrees(phase), abs=1e-3)
    assert [crossing.frequency for crossing in actual.phase] == pytest.approx(frequency.tolist(), rel=1e-5)
    assert actual.delay_margin == pytest.approx(min(phase % (2.0 * np.pi) / frequency), rel=1e-4)


def assert_poles(report, exact):
    poles = report.poles_z[abs(report.poles_z) > 1e-6]
    assert len(poles) == len(exact.closed)
    nearest = np.argmin(abs(poles[:, None] - exact.closed[None]), axis=1)
    assert sorted(nearest) == list(range(len(poles)))
    assert abs(poles - exact.closed[nearest]).max() < 1e-8


@pytest.mark.parametrize("name", SINGLE)
def test_every_margin_of_one_loop(studied, name):
    exact, report = studied(name)
    (loop,) = report.loops
    assert loop.sample_period == pytest.approx(exact.period)
    assert_classical(loop.classical, exact.loop)
    assert len(loop.classical.phase) == GAIN_CROSSOVERS[exact.name]
    assert loop.robust.disk_margin == pytest.approx(disk_margin(exact.loop), rel=1e-5)
    assert report.joint == ()


@pytest.mark.parametrize("name", SINGLE)
def test_poles_and_encirclements(studied, name):
    exact, report = studied(name)
    (loop,) = report.loops
    assert_poles(loop, exact)
    assert loop.stable
    assert all(mode.kind == "loop" for mode in loop.modes)
    assert loop.structure.order == loop.structure.controllable == loop.structure.observable == len(exact.closed)
    unstable = UNSTABLE.get(exact.name, 0)
    assert loop.unstable_open == outside(exact.loop, 0.0) == unstable
    assert loop.classical.encirclements == unstable


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_routes_agree(studied, name):
    exact, report = studied(name)
    for index, loop in enumerate(report.loops):
        assert loop.agreement.agrees
        assert DECIBEL * np.log(loop.agreement.gain) < 1e-3
        assert np.degrees(loop.agreement.phase) < 1e-2
        assert loop.linearised.plateau < 1e-6
        assert loop.linearised.periodicity < 1e-9
        assert loop.measured_response.half_amplitude_change < 1e-9
        truth = response_of(exact.loop if len(report.loops) == 1 else opened(exact.loop, index))
        exactly = truth(loop.curve.frequency)
        assert (abs(loop.curve.value - exactly) < 1e-6 * abs(exactly) + 1e-9).all()
        low = loop.measured_response.curve.frequency < 0.5 * np.pi / exact.period
        measured = loop.measured_response.curve.value / truth(loop.measured_response.curve.frequency)
        assert abs(measured[low] - 1.0).max() < 2e-4


@pytest.mark.parametrize("name", PAIRS)
def test_two_coupled_loops(studied, name):
    exact, report = studied(name)
    assert [loop.cut for loop in report.loops] == ["control.y[1]", "control.y[2]"]
    for index, loop in enumerate(report.loops):
        alone = opened(exact.loop, index)
        assert_classical(loop.classical, alone)
        assert_poles(loop, exact)
        assert loop.robust.disk_margin == pytest.approx(disk_margin(alone), rel=1e-5)
        assert loop.unstable_open == outside(alone, 0.0) == loop.classical.encirclements
        assert loop.closed == (report.loops[1 - index].name,)
    (joint,) = report.joint
    assert joint.channels == tuple(loop.name for loop in report.loops)
    assert joint.disk_margin == pytest.approx(disk_margin(exact.loop), rel=1e-3)
    assert joint.disk_margin < min(loop.robust.disk_margin for loop in report.loops)


def test_half_and_twice_the_communication_step(studied):
    _, report = studied("late_double_integrator, control at every 1")
    assert [item.step for item in report.loops[0].sampling] == [0.125, 0.25, 0.5]
    for item in report.loops[0].sampling:
        gain, phase, _ = crossings(late_double_integrator(step=item.step).loop)
        assert item.margins.gain == pytest.approx(gain[np.argmin(abs(np.log(gain)))], rel=1e-4)
        assert item.margins.phase == pytest.approx(np.min(abs(phase)), rel=1e-4)


def test_a_pendulum_that_falls(exact_fmus, tmp_path):
    """Less proportional gain than the square of its rate: the loop does not go round -1."""
    path = pendulum().packed(tmp_path, exact_fmus)
    report = perilune.stability(path, set={"control.proportional": 1.0})
    (loop,) = report.loops
    assert loop.stable is False
    assert loop.verdict == report.verdict == "fail"
    assert loop.unstable_open == 1
    assert loop.classical.encirclements == 0
    assert np.sum(abs(loop.poles_z) > 1.0) == 1


def test_routes_that_differ_do_not_pass(studied):
    """The same loop, whose linearised and measured responses agree, with a difference of 6 dB written into it."""
    _, report = studied("resonance, control at every 1")
    (loop,) = report.loops
    doubted = replace(loop, agreement=replace(loop.agreement, gain=2.0, agrees=False))
    assert (doubted.is_contradicted, loop.is_contradicted) == (True, False)
    assert {item.passed for item in doubted.judged} == {item.passed for item in loop.judged}
    passing = replace(loop, requirements=tuple(item for item in loop.requirements if item.passed))
    assert (passing.verdict, replace(report, loops=(passing,)).verdict) == ("pass", "pass")
    passing = replace(passing, agreement=doubted.agreement)
    assert (passing.verdict, replace(report, loops=(passing,)).verdict) == ("not applicable", "not applicable")
