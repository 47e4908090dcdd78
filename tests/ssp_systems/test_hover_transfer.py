"""System hover_transfer: plan, tracking, errors of all kinds, every direction, margins.

Truth: simulations of the same vehicle and law by another program (RMS of 200 transfers per row, 1000 for noisy rows);
the paper's programme solved by this program; the rocket equation; python-control's margins of the attitude loop. `make
long` repeats every row with the full number of transfers.
"""

import math

import control
import numpy as np
import pytest

import perilune
from tests.support.lengths import LONG, either

SYSTEM = "hover_transfer"
EXHAUST = 300.0 * 9.80665  # m/s
TARGET = np.array([1600.0, 0.0, 100.0])
DEGREE = math.pi / 180.0
PLACES = ("along", "across", "vertical")
pytestmark = pytest.mark.usefixtures("fmus")

# Along, across, vertical: m, m/s at the end of the plan; tilt, deg; m, m/s 30 s later on the worst axis.
ROWS = {
    1: ((0.03, 0.0, 0.06), (0.0, 0.0, 0.19), 0.0, 0.03, 0.002),
    2: ((3.0, 0.0, 6.2), (0.22, 0.0, 0.10), 0.6, 3.7, 0.05),
    3: ((2.2, 0.0, 7.3), (0.06, 0.0, 0.43), 0.5, 3.9, 0.06),
    4: ((0.10, 0.04, 0.16), (0.02, 0.01, 0.15), 0.02, 0.02, 0.001),
    5: ((1.5, 1.4, 1.6), (0.44, 0.22, 0.22), 0.5, 0.15, 0.05),
    6: ((2.8, 2.2, 1.9), (0.24, 0.19, 0.18), 1.1, 1.8, 0.14),
    7: ((2.8, 2.2, 2.0), (0.25, 0.19, 0.18), 1.1, 1.8, 0.14),
    8: ((2.8, 2.2, 2.0), (0.25, 0.19, 0.18), 1.1, 1.8, 0.14),
}
REACHED = {"m": 0.1, "m/s": 0.03, "deg": 0.1}  # below which there is nothing to be won
# 0.15, and the scatter of the RMS of a few flights
MARGIN = either(1.15, 1.5)


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def beyond(metrics, chosen, row, margin=MARGIN):
    """Return the excess of a row's RMS over its limits, as texts."""
    positions, speeds, tilt, held, held_speed = row
    actual = [(rms(metrics[name][chosen]), limit, "m", name) for name, limit in zip(PLACES, positions, strict=True)]
    actual += [(rms(metrics[f"{n}_speed"][chosen]), limit, "m/s", n) for n, limit in zip(PLACES, speeds, strict=True)]
    actual.append((rms(metrics["tilt"][chosen]), tilt, "deg", "tilt"))
    actual.append((max(rms(metrics[f"held_{n}"][chosen]) for n in PLACES), held, "m", "held"))
    actual.append((max(rms(metrics[f"held_{n}_speed"][chosen]) for n in PLACES), held_speed, "m/s", "held"))
    return [
        f"{name}: {value:.3f} {unit} for {limit}"
        for value, limit, unit, name in actual
        if value > max(margin * limit, REACHED[unit])
    ]


def miss(flight, row):
    position = np.array([flight[f"plant.position[{i}]"][row] for i in (1, 2, 3)]) - TARGET
    return position, np.array([flight[f"plant.velocity[{i}]"][row] for i in (1, 2, 3)])


@pytest.fixture(scope="module")
def ideal(fmus):
    return perilune.simulate(SYSTEM, parameters=["ideal.ssv"])


@pytest.fixture(scope="module")
def tracking(fmus):
    return perilune.batch(SYSTEM, "tracking", trials=either(8000, 320)).trials["default"]


@pytest.fixture(scope="module")
def directions(fmus):
    return perilune.batch(SYSTEM, "directions", trials=either(6000, 120)).trials["default"]


def programme_of(flight):
    return [flight[f"hover.programme[{i}]"][5] for i in range(1, 6)]


def test_the_plan_is_the_programme_with_margins(ideal):
    assert programme_of(ideal) == pytest.approx([18.430, 64.428, 1.5178, 11.309, 82.186], abs=2e-3)
    assert ideal["hover.predicted_propellant"][5] / 600.0 == pytest.approx(0.052518, abs=1e-6)
    assert set(ideal["hover.plan_kind"]) == {3}
    assert not ideal["hover.status"].any()
    assert not ideal["hover.saturated"][ideal.time < 82.0].any()


def test_without_margins_it_is_the_paper_s_at_the_best_time():
    whole = {"planned_maximum": 1.0, "planned_minimum": 1.0 / 15.0, "planned_angular_acceleration": DEGREE}
    flight = perilune.simulate(
        SYSTEM, parameters=["ideal.ssv"], set={f"hover.{k}": v for k, v in whole.items()}, stop_time=1.0
    )
    assert programme_of(flight) == pytest.approx([15.2696, 63.6422, 1.6968, 10.9894, 77.157], abs=6e-4)
    assert flight["hover.predicted_propellant"][5] / 600.0 == pytest.approx(0.049514, abs=1e-6)


def test_the_flight_follows_its_plan(ideal):
    """Undisturbed: a decimetre, but for what an engine that starts at 0 loses in height; then upright and at rest."""
    away = [ideal[f"plant.position[{i}]"] - ideal[f"hover.reference_position[{i}]"] for i in (1, 2, 3)]
    assert np.abs(away[:2]).max() < 0.1
    assert np.abs(away[2]).max() < 0.6
    assert np.abs(away[2][ideal.time > 70.0]).max() < 0.1
    assert np.degrees(ideal["attitude_control.direction_error"]).max() < 0.1
    end = int(np.argmax(ideal["hover.finished"]))
    assert ideal.time[end] == pytest.approx(82.2)
    position, velocity = miss(ideal, end + 300)
    assert np.abs(position).max() < 0.03
    assert np.abs(velocity).max() < 0.002
    assert (600.0 - ideal["plant.mass"][end]) / 600.0 == pytest.approx(0.0525, abs=1e-4)
    thrust = ideal["plant.delivered_thrust"][5:]
    assert 0.099 * 4707.192 < thrust.min() < thrust.max() < 0.901 * 4707.192


def test_propellant_is_that_of_the_rocket_equation(ideal):
    """Its speed is the sum of the specific force, whose direction turns by little in a step."""
    gained = np.diff([ideal[f"plant.sensed_velocity[{i}]"] for i in (1, 2, 3)], axis=1)
    spent = EXHAUST * math.log(600.0 / ideal["plant.mass"][-1])
    assert np.linalg.norm(gained, axis=0).sum() == pytest.approx(spent, rel=1e-5)


@pytest.mark.parametrize("row", ROWS)
def test_tracking(tracking, row):
    chosen = tracking.trial % len(ROWS) + 1 == row
    assert beyond(tracking.metrics, chosen, ROWS[row]) == []
    assert not tracking.metrics["guidance_status"][chosen].any()


def test_flights_end_in_a_hover_from_which_the_next_phase_can_begin(tracking):
    assert tracking.success.mean() > 0.98


def test_every_direction(directions):
    """At 45 deg, 500 m, 100 m, 0.3 m, 0 m and 2.9 km: undisturbed within 0.15 m, noisy within the row of the table."""
    case = directions.trial % 12 + 1
    for name in PLACES:
        assert np.abs(directions.metrics[name][case <= 6]).max() < 0.15
        assert np.abs(directions.metrics[f"held_{name}"][case <= 6]).max() < 0.03
    for number in range(7, 13) if LONG else ():
        # up to 1.2 in the speed upwards of the near targets, where the engine's tail at the end is longer
        assert beyond(directions.metrics, case == number, ROWS[7], 1.3) == [], number
    if not LONG:
        assert beyond(directions.metrics, case > 6, ROWS[7]) == []
    assert not directions.metrics["guidance_status"].any()
    kinds = [set(directions.final["hover.plan_kind"][case == number]) for number in range(1, 7)]
    assert kinds == [{3}, {2}, {2}, {1}, {1}, {3}]


def test_the_estimate_of_thrust_takes_its_error_out():
    """3 % too much thrust: what is left after the hold is a hundredth of what is left without the estimate."""

    def held(estimate):
        settings = {"plant.thrust_factor": 1.03, "hover.estimate_thrust": estimate}
        flight = perilune.simulate(SYSTEM, parameters=["ideal.ssv"], set=settings)
        return abs(flight["plant.position[3]"][-1] - 100.0), flight["hover.thrust_factor"][-1]

    without, factor = held(False)
    assert (without > 3.0, factor) == (True, 1.0)
    left, factor = held(True)
    assert left < 0.05 * without
    assert factor == pytest.approx(1.03, abs=1e-3)


def test_too_heavy_to_hover_is_said():
    flight = perilune.simulate(SYSTEM, parameters=["ideal.ssv"], set={"plant.initial_mass": 3000.0}, stop_time=2.0)
    assert set(flight["hover.status"]) == {3}
    assert set(flight["hover.plan_kind"]) == {0}


@pytest.mark.slow
def test_margins_of_the_hold():
    """The attitude loop is a double integrator under 1.2 and 1.5, sampled; the loop around it moves it by little."""
    loops = {loop.name: loop for loop in perilune.stability(SYSTEM).loops}
    plant = control.c2d(control.ss([[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0]], np.eye(2), np.zeros((2, 1))), 0.1, "zoh")
    opened = control.ss(plant.A, plant.B, [[1.5 * 0.8, 1.5]], [[0.0]], 0.1)
    _, phase, modulus, *_ = control.stability_margins(opened)
    for name in ("attitude_x", "attitude_y"):
        assert math.degrees(loops[name].classical.phase_margin.value) == pytest.approx(phase, abs=0.5)
        assert loops[name].robust.modulus_margin == pytest.approx(modulus, abs=0.005)
    assert len(loops) == 5
    for loop in loops.values():
        assert loop.stable, loop.name
        assert abs(20.0 * math.log10(loop.classical.gain_margin.value)) > 6.0
        assert math.degrees(loop.classical.phase_margin.value) > 45.0
