"""Comparison of descent laws: campaigns `laws_*` of the lunar landing, with fewer trials.

Truth: the current target (terminal errors); the stored bound of each trial, which no landing can undercut; the same
system without a divert (equal bits).
"""

import numpy as np
import pytest

import perilune
from tests.support.lengths import either

SYSTEM = "lunar_landing"
BRAKING = ["zem_zev_guidance", "fractional_guidance", "apollo_guidance", "powered_guidance"]
pytestmark = pytest.mark.usefixtures("fmus")


def fly(campaign, laws, trials):
    return perilune.batch(SYSTEM, campaign, compare={"guidance": laws}, trials=trials).trials


@pytest.mark.parametrize("campaign", either(["laws_terminal", "laws_braking"], ["laws_braking"]))
def test_laws_of_a_braking_hit_the_point(campaign):
    for law, actual in fly(campaign, BRAKING, either(60, 2)).items():
        assert actual.success.all(), law
        assert np.mean(actual.metrics["pinpoint"]) > 0.97, law
        assert np.min(actual.metrics["excess"]) > 0.0, law
        assert np.max(actual.metrics["largest_demand"]) < 5400.0, law


@pytest.mark.slow
def test_zem_zev_takes_less_propellant_than_the_exact_analytic_law():
    for campaign, gain in (("laws_terminal", 1.0), ("laws_braking", 2.5)):
        flown = fly(campaign, ["analytic_exact_guidance", "zem_zev_guidance"], either(60, 2))
        exact, zem_zev = (actual.metrics["propellant"] for actual in flown.values())
        assert np.all(exact - zem_zev > 0.0)
        assert np.mean(exact - zem_zev) > gain


def test_a_gravity_turn_has_no_place():
    (actual,) = fly("laws_braking", ["gravity_turn_guidance"], 2).values()
    assert not actual.success.any()


def test_diverts_of_the_braking_end_at_the_new_place():
    laws = ["analytic_exact_guidance", *BRAKING]
    for law, actual in fly("laws_divert_braking", laws, either(30, 1)).items():
        assert actual.success.all(), law
        assert np.all(actual.metrics["pinpoint"] == 1.0), law
        # the first target is 2121 m aside
        assert actual.metrics["position_error"] == pytest.approx(np.full(len(actual.trial), 2121.0), abs=15.0)


@pytest.mark.parametrize("campaign", either(["laws_approach", "laws_divert"], ["laws_approach"]))
def test_laws_near_the_ground(campaign):
    """The search keeps the cone where it is not moved; all that have a place hit it."""
    flown = perilune.batch(SYSTEM, campaign, trials=either(60, 2)).trials
    for law in ("analytic_exact_guidance", "zem_zev_guidance", "zem_zev_least_effort", "fractional_searched"):
        actual = flown[law]
        assert np.mean(actual.metrics["pinpoint"]) >= 0.9, law
        if campaign == "laws_approach":
            assert np.min(actual.metrics["glide_margin"]) > 0.0, law
    assert np.all(flown["gravity_turn_guidance"].metrics["pinpoint"] == 0.0)


def test_three_percent_less_thrust_than_known_fails_no_law():
    """At most one in a hundred of the laws that know the engine."""
    for law, actual in fly("laws_thrust", [*BRAKING, "convex_guidance"], either(300, 1)).items():
        assert np.mean(actual.success) >= 0.99, law
        assert np.max(actual.metrics["aim_error"]) < 20.0, law


def test_bad_knowledge_and_a_dead_band_of_thrust():
    """A law that ends with a thrust above the band gets the whole thrust then, and is too fast."""
    laws = ["analytic_exact_guidance", "zem_zev_guidance", "convex_guidance"]
    for law, actual in fly("laws_robust", laws, either(60, 1)).items():
        assert np.max(actual.metrics["aim_error"]) < 20.0, law
        assert np.max(actual.metrics["velocity_error"]) < 6.0, law
        assert (np.mean(actual.metrics["pinpoint"]) > 0.9) == (law == "analytic_exact_guidance")


@pytest.mark.parametrize("law", ["analytic_exact_guidance", "astar_robust_guidance", "network_operator_guidance"])
def test_without_a_divert_a_flight_has_the_bits_of_one_that_knows_none(law):
    """Another place to divert to, and a count that was there from the start, are no divert."""
    plain = perilune.simulate(SYSTEM, use={"guidance": law})
    said = {"divert_count": 4, "divert_position[1]": 3e3, "divert_position[2]": -1e3}
    other = perilune.simulate(SYSTEM, use={"guidance": law}, set=said)
    assert plain.time.size == other.time.size
    for name, values in plain.signals.items():
        if not name.startswith(("divert_", "guidance.divert_")):
            assert np.array_equal(values, other[name]), name


def test_a_divert_to_the_target_itself_is_the_same_flight():
    """A law without memory but its time, which it solves for again."""
    exact = {"parameters": ["ideal.ssv"], "use": {"guidance": "analytic_exact_guidance"}}
    plain = perilune.simulate(SYSTEM, **exact)
    other = perilune.simulate(SYSTEM, **exact, faults=["guidance.divert_count=override:1@60"])
    assert plain.time.size == other.time.size
    for i in (1, 2, 3):
        signal = f"plant.position[{i}]"
        assert other[signal] == pytest.approx(plain[signal], abs=1e-3)


def test_a_dead_band_is_left_out():
    """Between 57 and 63 % of the thrust the engine gives all of it, or stays below."""
    band = {"allocation.dead_band_low": 0.57, "allocation.dead_band_high": 0.63}
    flight = perilune.simulate(SYSTEM, parameters=["ideal.ssv"], set={**band, "plant.thrust_lag": 0.0})
    thrust = flight["allocation.thrust"][:-25] / 5099.0
    assert np.count_nonzero(thrust == 1.0) > 100
    assert np.all((thrust < 0.63 + 1e-9) | (thrust > 1.0 - 1e-9))


def test_a_replay_has_the_metrics_that_read_a_state():
    """The target in force is a state of the guidance, which no connection carries."""
    (actual,) = fly("laws_divert_braking", ["zem_zev_guidance"], 1).values()
    replayed = perilune.replay(
        SYSTEM, 0, campaign="laws_divert_braking", trials=1, compare={"guidance": ["zem_zev_guidance"]}
    )
    expected = {name: values[0] for name, values in actual.metrics.items()}
    assert replayed.replayed.outcome.metrics == expected
