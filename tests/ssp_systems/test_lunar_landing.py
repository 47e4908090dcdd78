"""System lunar_landing: all guidances and navigations, with and without limits and errors.

Truth: the target itself (terminal errors), the chi-square distribution (consistency of the filter), the rocket equation
(propellant and velocity gained), filterpy (the reference filter), the planar plant with curvature (the network operator
in space), and the cost of the engine's lag in closed form.
"""

import numpy as np
import pytest
from scipy import stats

import perilune
from tests.support.lengths import either

SYSTEM = "lunar_landing"
EXHAUST_SPEED = 9.80665 * 319.0  # m/s
GUIDANCES = [
    "analytic_guidance",
    "analytic_exact_guidance",
    "astar_guidance",
    "astar_robust_guidance",
    "astar_modified_guidance",
    "network_operator_guidance",
]
pytestmark = pytest.mark.usefixtures("fmus")


def fly(campaign, guidances, trials, **options):
    """Return trials of each guidance by name."""
    return perilune.batch(SYSTEM, campaign, compare={"guidance": guidances}, trials=trials, **options).trials


def last(result, name, size=3):
    """Return the final values of a vector."""
    return np.array([result[f"{name}[{i + 1}]"][-1] for i in range(size)])


@pytest.mark.parametrize("campaign", either(["compare", "terminal_box"], ["terminal_box"]))
def test_exact_guidances_meet_the_target_without_limits_and_errors(campaign):
    exact = ["analytic_exact_guidance", "astar_robust_guidance"]
    for actual in fly(campaign, exact, either(40, 4), parameters=["ideal.ssv", "without_limits.ssv"]).values():
        assert actual.success.all()
        assert np.max(actual.metrics["position_error"]) < 0.01
        assert np.max(actual.metrics["velocity_error"]) < 0.002


def test_every_guidance_hands_over_and_all_but_one_hit_the_point():
    for name, actual in fly("compare", GUIDANCES, either(25, 1), parameters=["ideal.ssv"]).items():
        assert actual.success.all(), name
        assert np.all(actual.metrics["pinpoint"] == (name != "network_operator_guidance")), name


def test_noisy_flights_hit_the_point_and_the_filter_knows_its_errors():
    guidances = ["analytic_exact_guidance", "network_operator_guidance"]
    for name, actual in fly("compare", guidances, either(200, 50), parameters=["noisy.ssv"]).items():
        assert actual.success.mean() >= 0.99
        if name == "analytic_exact_guidance":
            assert actual.metrics["pinpoint"].mean() >= 0.99
        for axis in ("x", "y", "z", "vx", "vy", "vz"):
            assert 0.8 < np.std(actual.metrics[f"{axis}_error_over_sigma"], ddof=1) < 1.3, (name, axis)


@pytest.mark.slow
def test_the_filter_is_consistent_at_five_epochs():
    batch = perilune.batch(SYSTEM, "consistency")
    actual = batch.trials["default"]
    flights = len(actual.trial)
    assert flights == 200
    degrees = {"nees": 6, "altitude_nis": 1, "velocity_nis": 3, "position_nis": 3}
    outside, looked_at = [], 0
    for name, values in actual.metrics.items():
        kind = next((kind for kind in degrees if name.startswith(kind)), None)
        if kind is not None:
            looked_at += 1
            low, high = stats.chi2.interval(0.95, degrees[kind] * flights)
            if not low <= np.sum(values) <= high:
                outside.append(name)
    assert looked_at == 17
    # of 17 sums one in twenty may lie outside of its 95 % interval
    assert len(outside) <= stats.binom.ppf(0.99, 17, 0.05), outside


@pytest.mark.slow
def test_the_filterpy_filter_gives_the_same_flight():
    ours = perilune.simulate(SYSTEM)
    theirs = perilune.simulate(SYSTEM, use={"navigation": "kalman_navigation_filterpy"})
    assert ours.time.size == theirs.time.size > 2500
    for name in ("estimated_position", "estimated_velocity", "position_estimate_sigma", "velocity_estimate_sigma"):
        for i in (1, 2, 3):
            signal = f"navigation.{name}[{i}]"
            assert np.max(np.abs(ours[signal] - theirs[signal])) < 1e-9 * (1.0 + np.max(np.abs(ours[signal])))


def test_raw_navigation_costs_the_point_and_ideal_navigation_does_not():
    rates = {}
    for navigation in ("ideal_navigation", "raw_navigation", "kalman_navigation"):
        actual = fly("compare", ["analytic_exact_guidance"], either(40, 8), use={"navigation": navigation})
        rates[navigation] = actual["analytic_exact_guidance"].metrics["pinpoint"].mean()
    assert rates["ideal_navigation"] == rates["kalman_navigation"] == 1.0
    assert rates["raw_navigation"] < 0.5


def test_propellant_obeys_the_rocket_equation_where_attitude_is_free_of_lag():
    flight = perilune.simulate(SYSTEM, parameters=["ideal.ssv", "without_limits.ssv"])
    increments = np.diff([flight[f"plant.sensed_velocity[{i}]"] for i in (1, 2, 3)], axis=1)
    gained = np.sum(np.linalg.norm(increments, axis=0))  # a chord is shorter than its arc
    spent = EXHAUST_SPEED * np.log(flight["plant.mass"][0] / flight["plant.mass"][-1])
    assert gained == pytest.approx(spent, rel=1e-5)


def test_the_engine_s_lag_costs_its_impulse_unless_it_is_led():
    def left(lead):
        actual = fly("lag", ["analytic_exact_guidance"], either(10, 2), set={"allocation.thrust_lead": lead})
        return actual["analytic_exact_guidance"].metrics["settled_velocity_error"]

    # what an engine of first order gives behind its cut-off: thrust acceleration times lag, here about 5.5 m/s2 0.1 s
    flight = perilune.simulate(SYSTEM, parameters=["ideal.ssv"], use={"guidance": "analytic_exact_guidance"})
    tail = flight["guidance.thrust_acceleration"][-30] * 0.1
    assert left(0.0) == pytest.approx(tail, rel=0.1)
    assert np.max(left(0.1)) < 0.02 * tail


def test_the_gravity_correction_asks_for_less_at_the_end_of_the_braking():
    """With constant gravity the guidance finds out only on the way that the Moon is round."""

    def largest(correction):
        flight = perilune.simulate(
            SYSTEM,
            parameters=["ideal.ssv", "without_limits.ssv"],
            use={"guidance": "analytic_exact_guidance"},
            set={"guidance.gravity_correction": correction},
        )
        return np.max(flight["guidance.thrust_acceleration"])

    assert 0.1 < largest(False) - largest(True) < 0.3


def test_the_network_operator_in_space_brakes_as_in_its_plane():
    space = perilune.simulate(
        SYSTEM,
        use={"guidance": "network_operator_guidance"},
        parameters=["ideal.ssv", "without_limits.ssv"],
        set={"guidance.handover_speed": 6.0},
    )
    plane = perilune.simulate(
        "lunar_descent_2d",
        set={
            "plant.curvature": True,
            "plant.surface_gravity": 4.9028e12 / 1.7374e6**2,
            "plant.moon_radius": 1.7374e6,
            "sensor.sample_period": 0,
        },
        step=0.1,
        stop_time=400,
    )
    assert space.time[-1] == pytest.approx(plane.time[-1], abs=0.11)
    assert space["plant.mass"][-1] == pytest.approx(plane["plant.mass"][-1], abs=0.5)


def test_inputs_for_longer_missions_change_no_bit_where_they_say_nothing():
    """A guidance activated, a navigation informed of thrust: the flight without these inputs."""
    reported = {"guidance.active": True, "navigation.free_flight": False, "navigation.gravity_gradient": False}
    plain, other = perilune.simulate(SYSTEM), perilune.simulate(SYSTEM, set=reported)
    assert plain.time.size == other.time.size
    for name, values in plain.signals.items():
        assert np.array_equal(values, other[name]), name
