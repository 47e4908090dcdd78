"""Stability of robot_rendezvous and lunar_landing by both methods, compared with the same loops in closed form.

Truth: support/loops/exact_robot.py and exact_lunar.py, which are independent of the FMUs, with margins by
python-control; the robot's published designs with sample means as interpolated delays; the double integrator under
6/T^2 and 4/T, by hand.
"""

import numpy as np
import pytest

import perilune
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.stability.point.point_study import PointStudy
from perilune.analysis.stability.request.request import Subject, read_request
from tests.support.lengths import either
from tests.support.loops.exact_lunar import STEP, HoverLoop
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.loops.exact_robot import attitude_loop, translation_loop
from tests.support.loops.sampled_loops import outside, response_of

pytestmark = pytest.mark.usefixtures("fmus")
DECIBEL = 20.0 / np.log(10.0)
AXES = (1, 2, 3)
ROBOT = {
    "translation_8s": translation_loop(8.0),
    "translation_4s": translation_loop(4.0),
    "attitude": attitude_loop(),
}
# With means as interpolated delays: phase margin and how near (deg), gain margin and how near (dB).
WINDOWS = {"translation_8s": (44, 2, 12.6, 1), "translation_4s": (45, 2, 13.1, 1), "attitude": (49, 2, 16.5, 1)}
STUDIED = either(list(ROBOT), ["translation_4s"])
each_loop = pytest.mark.parametrize("name", STUDIED)
each_axis = pytest.mark.parametrize("axis", "xyz")
each_time = pytest.mark.parametrize("time_to_go", either([100, 10], [10]))


@pytest.fixture(scope="module")
def robot(fmus):
    return perilune.stability("robot_rendezvous", parameters=("paper.ssv",), loops=STUDIED)


@pytest.fixture(scope="module")
def channels(robot):
    """Return the three channels of each loop."""
    actual = {name: [loop for loop in robot.loops if loop.loop == name] for name in STUDIED}
    for name, loops in actual.items():
        assert [loop.name for loop in loops] == [f"{name}[{axis}]" for axis in AXES]
    return actual


@pytest.fixture(scope="module")
def hover(fmus):
    """Return the loops of the lunar landing by axis, and all at once, at the point with a time-to-go, studied once."""
    request = read_request("lunar_landing", SystemOptions())
    subject, limits = Subject(request.system, request.options), request.declaration.limits
    actual = {}

    def reports(time_to_go):
        if time_to_go not in actual:
            point = request.point(f"time_to_go_{time_to_go}")
            loops = request.loops_at(point)
            with PointStudy(subject, point, loops) as here:
                here.linearise()
                studies = {channel.name: here.loop_study(channel, limits) for channel in here.channels}
                for loop in studies.values():
                    loop.measure()
                axes = {name.rpartition(".")[2]: loop.report(()) for name, loop in studies.items()}
                actual[time_to_go] = axes, here.joint(loops[0], limits)
        return actual[time_to_go]

    return reports


def gain_margin(loop):
    return DECIBEL * np.log(loop.classical.gain_margin.value)


def phase_margin(loop):
    return np.degrees(loop.classical.phase_margin.value)


def assert_routes_agree(loop):
    assert loop.not_applicable == {}
    assert loop.agreement.agrees
    assert DECIBEL * np.log(loop.agreement.gain) < 1e-3
    assert np.degrees(loop.agreement.phase) < 1e-2
    assert loop.linearised.plateau < 1e-3
    assert loop.measured_response.half_amplitude_change < 1e-6
    assert loop.measured_response.unexcited < 1e-5


def relative_error(curve, response, lowest, highest):
    """Return the largest relative error of a curve between two frequencies (rad/s), with frequencies and errors
    there."""
    retained = (curve.frequency > lowest) & (curve.frequency < highest)
    assert np.sum(retained) > 10
    frequency = curve.frequency[retained]
    return frequency, abs(curve.value[retained] / response(frequency) - 1.0)


@each_loop
def test_robot_margins(channels, name):
    exact = ROBOT[name].margins
    near_phase, off_phase, near_gain, off_gain = WINDOWS[name]
    for loop in channels[name]:
        assert loop.sample_period == pytest.approx(ROBOT[name].period)
        assert gain_margin(loop) == pytest.approx(exact.gain, abs=1e-3)
        assert phase_margin(loop) == pytest.approx(exact.phase, abs=1e-3)
        assert loop.robust.modulus_margin == pytest.approx(exact.modulus, abs=1e-5)
        assert loop.classical.gain_margin.frequency == pytest.approx(exact.gain_frequency, rel=1e-5)
        assert loop.classical.phase_margin.frequency == pytest.approx(exact.phase_frequency, rel=1e-5)
        assert loop.classical.delay_margin == pytest.approx(np.radians(exact.phase) / exact.phase_frequency, rel=1e-4)
        assert phase_margin(loop) == pytest.approx(near_phase, abs=off_phase)
        assert gain_margin(loop) == pytest.approx(near_gain, abs=off_gain)
        assert loop.verdict == "pass"


@each_loop
def test_robot_has_no_other_crossings(channels, name):
    for loop in channels[name]:
        assert len(loop.classical.gain) == len(loop.classical.phase) == 1


@each_loop
def test_robot_responses_by_both_routes(channels, name):
    exact = ROBOT[name]
    for loop in channels[name]:
        assert_routes_agree(loop)
        lowest, highest = 0.1 * exact.margins.phase_frequency, 0.5 * np.pi / exact.period
        for curve, tolerance in ((loop.curve, 1e-4), (loop.measured_response.curve, 1e-7)):
            assert max(relative_error(curve, exact.response, lowest, highest)[1]) < tolerance


@each_loop
def test_robot_poles_and_encirclements(channels, name):
    """No field of gravity, so the open loop is stable but for two poles at 1; fast multipliers are too small to see."""
    exact = ROBOT[name]
    for loop in channels[name]:
        assert loop.stable
        assert loop.classical.encirclements == loop.unstable_open == 0
        periods = round(loop.linearised.period / exact.period)
        for pole in exact.poles**periods:
            if abs(pole) > 1e-4:
                assert np.min(abs(loop.poles_z - pole)) < 1e-5


@each_loop
def test_robot_axes_at_once_are_no_nearer_to_instability_than_one(robot, name):
    """The axes do not reach each other, so that the joint disk margin is that of any."""
    (joint,) = (joint for joint in robot.joint if joint.name == name)
    assert joint.disk_margin == pytest.approx(disk_margin(ROBOT[name].transfer_function), rel=1e-4)


@pytest.mark.parametrize("name", [name for name in STUDIED if name != "attitude"])
def test_levels_of_the_jets_make_no_limit_cycle(channels, name):
    """N of a quantiser is 4/pi at most (Gelb and Vander Velde 1968), less than 1/|L| where L is real and negative."""
    assert 4.0 / np.pi < 10.0 ** (ROBOT[name].margins.gain / 20.0)
    for loop in channels[name]:
        (element,) = loop.nonlinearities
        assert (element.kind, element.cycles) == ("quantiser", ())
        assert "oscillates" not in element.note


@each_loop
def test_robot_samples_at_its_own_period_whatever_the_communication_step(channels, name):
    exact = ROBOT[name].margins
    for loop in channels[name]:
        half, same, twice = loop.sampling
        assert [half.step, same.step, twice.step] == [0.0625, 0.125, 0.25]
        for item in (half, same):
            assert DECIBEL * np.log(item.margins.gain) == pytest.approx(exact.gain, abs=0.01)
            assert np.degrees(item.margins.phase) == pytest.approx(exact.phase, abs=0.01)
        assert twice.margins is None
        assert "star.sample_period: 0.125 s is shorter" in twice.note


@each_time
@each_axis
def test_hover_margins(hover, time_to_go, axis):
    """To 1e-3 dB and deg, but for the gain margin at a high frequency, on which the filter's reckoning has a say."""
    exact, loop = HoverLoop(time_to_go, axis == "z"), hover(time_to_go)[0][axis]
    gain, phase, frequency = crossings(exact.state_space)
    upwards = gain[gain > 1.0]
    assert gain_margin(loop) == pytest.approx(DECIBEL * np.log(np.min(upwards)), abs=0.03 if axis == "z" else 5e-3)
    assert len(loop.classical.phase) == len(phase) == 1
    assert phase_margin(loop) == pytest.approx(np.degrees(phase[0]), abs=1e-3)
    assert loop.classical.phase_margin.frequency == pytest.approx(frequency[0], rel=1e-5)
    assert loop.classical.delay_margin == pytest.approx(phase[0] / frequency[0], rel=1e-4)
    assert loop.robust.disk_margin == pytest.approx(disk_margin(exact.state_space, 1e-4), rel=1e-3)
    assert loop.verdict == "pass"


@each_time
@each_axis
def test_hover_responses_by_both_routes(hover, time_to_go, axis):
    """From a tenth of the crossover on, above the resonance of gravity across.

    The filter reckons the position as if thrust were linear in time: off by h^3/24 of the change of acceleration, w a,
    where that is smooth, and by less than a fifth of h^3 with lags. 6/T^2 of it stand against 4/T of the velocity a/w.
    Differences of the flight round the slowest responses in z by up to 1.4e-5.
    """
    loop = hover(time_to_go)[0][axis]
    assert_routes_agree(loop)
    response = response_of(HoverLoop(time_to_go, axis == "z").state_space)
    for curve in (loop.curve, loop.measured_response.curve):
        frequency, error = relative_error(curve, response, 0.42 / time_to_go, 0.5 * np.pi / STEP)
        assert np.all(error < 2e-5 + 0.3 * STEP**3 * frequency**2 / time_to_go)


@each_time
@each_axis
def test_hover_poles_and_encirclements(hover, time_to_go, axis):
    """Gravity falls with height, so that hovering is unstable along the vertical and a slow pendulum across."""
    exact, loop = HoverLoop(time_to_go, axis == "z"), hover(time_to_go)[0][axis]
    assert loop.stable
    unstable = outside(exact.state_space, 0.0)
    assert loop.classical.encirclements == loop.unstable_open == unstable == (1 if axis == "z" else 0)
    periods = round(loop.linearised.period / STEP)
    for pole in exact.poles[:2] ** periods:
        assert np.min(abs(loop.poles_z - pole)) < 2e-6


@each_time
def test_hover_axes_at_once(hover, time_to_go):
    """The effect of one axis on another is of second order: the joint disk margin is the least of them."""
    joint = hover(time_to_go)[1]
    minimum = min(disk_margin(HoverLoop(time_to_go, vertical).state_space, 1e-4) for vertical in (False, True))
    assert joint.disk_margin == pytest.approx(minimum, rel=1e-3)


@pytest.mark.slow
@each_axis
def test_a_long_plan_is_a_double_integrator_under_its_gains(hover, axis):
    """(6/T^2 + 4 s/T)/s^2 is 1 at w T = sqrt(18), with a phase margin of atan(2 sqrt(2)).

    What is left at 100 s are lags: the phase lost is the crossover times some tenths of a second, less than the cycle,
    the lag and the lead together.
    """
    loop = hover(100)[0][axis]
    crossover = loop.classical.phase_margin.frequency
    assert crossover == pytest.approx(np.sqrt(18.0) / 100.0, rel=0.01)
    lost = np.arctan(2.0 * np.sqrt(2.0)) - loop.classical.phase_margin.value
    assert 0.0 < lost < crossover * (STEP + 0.5 + 0.5)


@pytest.mark.slow
def test_hover_margins_shrink_with_the_time_to_go(hover):
    long, short = hover(100)[0], hover(10)[0]
    for axis in "xyz":
        assert gain_margin(short[axis]) < gain_margin(long[axis])
        assert phase_margin(short[axis]) < phase_margin(long[axis])
    # regression
    assert (gain_margin(short["x"]), phase_margin(short["x"])) == pytest.approx((28.489, 56.211), abs=1e-3)
    assert (gain_margin(short["z"]), phase_margin(short["z"])) == pytest.approx((35.448, 66.815), abs=1e-3)
