"""System entry_attitude: every control block in all cases, reversals, gusts, and margins along the trajectory.

Truth: simulations of the same capsule and cases by another program, to the digits printed if sensors have no errors;
the bang-coast-bang bound of a reversal in closed form; margins from another program. `make long` covers all cases.
"""

import math

import numpy as np
import pytest

import perilune
from tests.support.lengths import either

SYSTEM = "entry_attitude"
IDEAL = ["ideal.ssv"]
DEGREE = math.pi / 180.0
pytestmark = pytest.mark.usefixtures("fmus")

# Largest deviation (deg): attack, sideslip, bank at high altitude; mean jet-seconds. 24 cases without sensor errors.
CASES_IDEAL = {
    "robust_control": (1.817, 1.793, 0.347, 12.863),
    "standard_control": (5.006, 6.877, 2.137, 31.625),
}
# Jet-seconds of case 0.
CASE_0 = {
    "robust_control": 12.363,
    "standard_control": 30.4,
    "output_feedback_direct1": 24.124,
    "output_feedback_direct0": 77.810,
    "output_feedback_dual_a": 47.064,
    "output_feedback_dual_b": 71.638,
    "output_feedback_scheduled": 16.766,
}
# With sensor errors: attack, sideslip, bank, mean jet-seconds, and how far other noise may move them.
CASES = {
    "robust_control": ((1.8, 1.7, 0.6, 12.9), (0.2, 0.4, 0.1, 0.4)),
    "standard_control": ((5.0, 6.8, 2.2, 32.0), (0.3, 0.4, 0.3, 1.5)),
    "output_feedback_direct1": ((1.7, 3.5, 1.1, 23.0), (0.3, 0.6, 0.3, 1.5)),
    "output_feedback_direct0": ((1.6, 7.0, 1.3, 71.0), (0.3, 1.0, 0.4, 7.0)),
    "output_feedback_dual_a": ((1.7, 4.8, 2.1, 45.0), (0.3, 0.8, 0.5, 4.0)),
    "output_feedback_dual_b": ((1.7, 5.8, 4.2, 69.0), (0.3, 1.0, 1.0, 7.0)),
    "output_feedback_scheduled": ((1.6, 2.8, 1.2, 15.7), (0.3, 0.5, 0.3, 1.5)),
}
UPPER = ("upper_attack", "upper_sideslip", "upper_bank")


def fly(campaign, configurations, **options):
    """Return trials by configuration of a campaign."""
    trials = {}
    for name in configurations:
        (trials[name],) = perilune.batch(SYSTEM, campaign, configuration=name, **options).trials.values()
    return trials


def largest(trials):
    return [float(trials.metrics[name].max()) for name in UPPER]


@pytest.fixture(scope="module")
def ideal(fmus):
    return fly("cases_ideal", either(list(CASE_0), ["robust_control"]))


def test_the_nominal_flight():
    """Without reversal and sensor errors: height, speed, path angle, course, pressure to the digits printed."""
    flight = perilune.simulate(SYSTEM, parameters=[*IDEAL, "no_reversal.ssv"])
    rows = {
        100: (81182.0, 7617.93, -1.3680, 33.498, 443.9),
        200: (64547.8, 7283.64, -1.1185, 24.983, 4594.3),
        300: (53242.1, 5783.90, -1.0028, 13.229, 11675.7),
        400: (39527.2, 3040.34, -3.2723, -3.071, 19789.0),
    }
    for time, (height, speed, angle, course, pressure) in rows.items():
        k = int(np.searchsorted(flight.time, time - 1e-6))
        assert flight["plant.height"][k] == pytest.approx(height, abs=0.06)
        assert flight["plant.speed"][k] == pytest.approx(speed, abs=0.006)
        assert flight["plant.path_angle"][k] / DEGREE == pytest.approx(angle, abs=6e-5)
        assert flight["plant.course"][k] / DEGREE == pytest.approx(course, abs=6e-4)
        assert flight["plant.dynamic_pressure"][k] == pytest.approx(pressure, abs=0.06)
    assert flight.status == "finished"
    assert not flight["plant.status"].any()


@pytest.mark.slow
def test_cases_without_sensor_errors(ideal):
    for regulator, trials in ideal.items():
        assert trials.metrics["propellant"][0] == pytest.approx(CASE_0[regulator], abs=0.0016), regulator
        if regulator in CASES_IDEAL:
            *deviations, propellant = CASES_IDEAL[regulator]
            assert largest(trials) == pytest.approx(deviations, abs=0.0011)
            assert trials.metrics["propellant"].mean() == pytest.approx(propellant, abs=0.002)


def test_case_0_of_the_robust_regulator(ideal):
    trials = ideal["robust_control"]
    actual = [trials.metrics[name][0] for name in UPPER]
    assert actual == pytest.approx([0.758, 0.744, 0.205], abs=6e-4)
    assert trials.end_time[0] == pytest.approx(472.8)  # the tick after the last one above 25 km


@pytest.fixture(scope="module")
def noisy(fmus):
    return fly("cases", either(list(CASES), ["robust_control"]))


def test_cases_with_sensor_errors(noisy):
    for regulator, trials in noisy.items():
        expected, tolerance = CASES[regulator]
        actual = [*largest(trials), float(trials.metrics["propellant"].mean())]
        for value, desired, within in zip(actual, expected, tolerance, strict=True):
            assert value < desired + within, (regulator, actual)
        assert not trials.metrics["beyond_tables"].any()


def test_robust_control_is_within_3_degrees_for_half_the_propellant(noisy):
    robust = noisy["robust_control"]
    assert robust.success.all()
    assert robust.metrics["propellant"].max() < 15.0


@pytest.mark.parametrize(("degrees", "method"), [(60.0, 2), (15.0, 2), (85.0, 2)])
def test_reversals_take_what_their_bound_allows(degrees, method):
    """Two times the bank: 120 deg, 30 (triangular) and 170; within 3 deg of the target within 5 % of the bound."""
    speed, acceleration, way = 12.0 * DEGREE, 0.06, 2.0 * degrees * DEGREE
    turn = min(speed, math.sqrt(way * acceleration))
    total = way / turn + turn / acceleration
    bound = total - math.sqrt(2.0 * 3.0 * DEGREE / acceleration)
    settings = {"programme.first_target": degrees * DEGREE, "plant.initial_bank": degrees * DEGREE}
    flight = perilune.simulate(SYSTEM, parameters=IDEAL, set={**settings, "programme.method": method}, stop_time=250.0)
    away = np.abs(flight["plant.bank"] + degrees * DEGREE)
    after = flight.time >= 200.0
    late = flight.time[after][away[after] > 3.0 * DEGREE][-1] + 0.2 - 200.0
    assert bound - 0.2 < late < max(1.05 * bound, bound + 0.4)


@pytest.mark.slow
def test_a_reversal_at_81_km_needs_yaw_co_ordinated():
    """Rolling about the velocity keeps sideslip at 1.4 deg; about the axis of symmetry (trim_attack 0) it is 8."""
    rolled = fly("reversal_100", ["robust_control"])["robust_control"]
    assert rolled.metrics["reversal_sideslip"].max() < 1.8
    assert rolled.metrics["reversal_time"].mean() == pytest.approx(12.17, rel=0.03)
    assert rolled.metrics["reversal_time"].max() < 1.05 * 12.17
    plain = fly("reversal_100", ["robust_control"], set={"regulator.trim_attack": 0.0})["robust_control"]
    assert plain.metrics["reversal_sideslip"].max() > 6.0


def test_a_gust_and_a_change_of_density():
    gust = {"air.gust[3]": 100.0, "air.gust_time": 370.0}
    quiet, gusty, dense = (
        perilune.simulate(SYSTEM, parameters=IDEAL, set=settings)
        for settings in ({}, gust, {"air.density_time": 120.0, "air.later_density": 1.5})
    )

    def deviation(flight, name, target, since=365.0):
        late = (flight.time > since) & (flight.time < 395.0)
        return np.abs(flight[f"plant.{name}"][late] / DEGREE - target).max()

    assert deviation(quiet, "sideslip", 0.0) < 0.7 < deviation(gusty, "sideslip", 0.0) < 1.5
    assert deviation(dense, "attack", -20.0, 130.0) < 3.0


@pytest.mark.slow
def test_cases_in_the_air_of_gost():
    """The row of the page: deviations (deg), on-time mean and max (s)."""
    flown = fly("cases", ["robust_control"], set={"plant.atmosphere": 1})["robust_control"]
    fuel = flown.metrics["propellant"]
    assert [*largest(flown), fuel.mean(), fuel.max()] == pytest.approx([1.9, 1.7, 0.6, 12.8, 14.6], abs=0.051)


@pytest.mark.slow
def test_disturbed_air_over_the_cases():
    """Another program: a gust takes attack to 2.3 and sideslip to 1.5 deg, else 1.0 and 0.9; density does nothing."""
    flown = perilune.batch(SYSTEM, "disturbed_air")
    actual, air = flown.trials["default"], flown.plan.draws.columns["air"]
    attack, sideslip = actual.metrics["gust_attack"], actual.metrics["gust_sideslip"]
    assert [attack[air == 1].max(), sideslip[air == 1].max()] == pytest.approx([2.3, 1.5], abs=0.15)
    for calm in (0, 2):
        assert [attack[air == calm].max(), sideslip[air == calm].max()] == pytest.approx([1.0, 0.9], abs=0.1)
    assert actual.success.all()


@pytest.mark.slow
def test_dead_jets():
    """Another program: any can be missed without a reversal (bank 2.3 deg); with one at 100 s those about x cannot."""
    calm = perilune.batch(SYSTEM, "jet_failures", parameters=["no_reversal.ssv"]).trials["default"]
    assert calm.success.all()
    assert calm.metrics["upper_bank"].max() == pytest.approx(2.3, abs=0.1)
    flown = perilune.batch(SYSTEM, "jet_failures", set={"programme.reversal_times[1]": 100.0})
    rolled, jet = flown.trials["default"], flown.plan.draws.columns["jet"]
    assert rolled.metrics["largest_rate"][jet == 1].max() > 40.0  # it cannot stop, deg/s
    assert rolled.metrics["largest_rate"][jet == 2].max() < 4.0  # it does not turn
    assert rolled.metrics["reversal_sideslip"][(jet == 3) | (jet == 4)].max() == pytest.approx(5.5, abs=0.2)
    assert rolled.metrics["reversal_sideslip"][jet >= 5].max() < 1.4


@pytest.mark.slow
@pytest.mark.parametrize(
    ("campaign", "robust", "standard"),
    # standard with tripled noise has no figure elsewhere; it holds 216, since noise makes its relays switch sooner
    [("thousand", 0.997, 0.2), ("thousand_tripled_noise", 0.99, 0.25), ("thousand_doubled", 0.9, 0.1)],
)
def test_a_thousand_cases(campaign, robust, standard):
    actual = fly(campaign, ["robust_control", "standard_control"])
    assert actual["robust_control"].success.mean() >= robust
    assert actual["standard_control"].success.mean() <= standard


# Gain (dB), phase (deg), modulus and disk margin of the sampled loops along the flight: least and largest of 18.
MARGINS = {"gain": (13.8, 30.5), "phase": (58.7, 90.0), "modulus": (0.75, 0.97), "disk": (1.08, 1.88)}


@pytest.mark.slow
def test_margins_along_the_way():
    """Three axes at 95 to 45 km: the range of another program to 0.5 dB and 2 deg."""
    loops = perilune.stability(SYSTEM).loops
    assert len(loops) == 18
    gains = [abs(20.0 * np.log10(loop.classical.gain_margin.value)) for loop in loops]
    phases = [abs(np.degrees(loop.classical.phase_margin.value)) for loop in loops]
    moduli = [loop.robust.modulus_margin for loop in loops]
    disks = [loop.robust.disk_margin for loop in loops]
    for values, (minimum, maximum), within in zip(
        (gains, phases, moduli, disks), MARGINS.values(), (0.5, 2.0, 0.02, 0.03), strict=True
    ):
        assert min(values) == pytest.approx(minimum, abs=within)
        assert max(values) == pytest.approx(maximum, abs=within)
    assert all(loop.stable for loop in loops)
