"""Published descents of Diveev, Pupkov and Sofronova (2013), simulated by the FMUs.

Truth: tables 1 and 2 of the paper, as data below, and `independent_descent.py`, which shares no code with the
components (0.02 s and 0.01 m at the hand-over). Times of table 1 within 0.25 s and altitudes within 0.1 m; means of
table 2 over 20 descents within 1.5 s and 10 m, with one exception. Claims of robustness are simulated over their full
ranges; if a claim does not hold, the region in which it holds is asserted.
"""

import statistics
from collections import defaultdict

import numpy as np
import pytest
from scipy import stats

import perilune
from tests.support.flights.independent_descent import LEGACY, TRUE, encoded_law, fly, printed_law
from tests.support.lengths import LONG

SYSTEM = "lunar_descent_2d"
NINE = [(altitude, angle) for altitude in (16648.0, 18148.0, 19648.0) for angle in (-1.65, -1.6, -1.55)]
NOMINAL = (18148.0, -1.6)
pytestmark = pytest.mark.usefixtures("fmus")

# Start (m, rad): final speed (m/s), altitude (m), time (s).
TABLE_1 = {
    (16648.0, -1.65): (5.59, 1500.0, 270.1),
    (18148.0, -1.65): (5.52, 1500.0, 270.9),
    (19648.0, -1.65): (5.48, 1500.0, 271.7),
    (16648.0, -1.6): (5.2, 1500.0, 272.7),
    (18148.0, -1.6): (5.1, 1500.0, 273.6),
    (19648.0, -1.6): (5.2, 1500.0, 274.5),
    (16648.0, -1.55): (5.94, 1500.0, 275.6),
    (18148.0, -1.55): (5.1, 1500.0, 276.7),
    (19648.0, -1.55): (5.48, 1500.0, 277.7),
}
TABLE_2 = {
    (18148.0, -1.6): (5.78, 1615.0, 302.2),
    (16648.0, -1.6): (5.35, 1607.0, 300.6),
    (19648.0, -1.6): (5.50, 1612.0, 303.0),
    (18148.0, -1.65): (5.10, 1619.0, 301.9),
    (16648.0, -1.65): (5.34, 1615.0, 300.9),
    (19648.0, -1.65): (5.36, 1609.0, 302.9),
    (18148.0, -1.55): (5.02, 1612.0, 303.1),
    (16648.0, -1.55): (5.19, 1617.0, 302.0),
    (19648.0, -1.55): (5.11, 1611.0, 306.0),
    (18148.0, -1.7): (5.47, 1613.0, 302.1),
    (18148.0, -1.5): (5.49, 1624.0, 306.4),
}
# What each claim of robustness varies, from the nominal value, and how far.
CLAIMS = {
    "altitude": ("plant.initial_altitude", 18148.0, 0.4),
    "angle": ("plant.initial_path_angle", -1.6, 0.08),
    "mass": ("plant.initial_mass", 940.0, 0.1),
    "speed": ("plant.initial_speed", 1689.0, 0.07),
    "thrust": ("plant.thrust_factor", 1.0, 0.1),
}
# A single flight, 3 to 4 standard deviations of such flights from their mean.
APART = (18148.0, -1.5)


def flown(campaign, **options):
    """Return rows of a campaign."""
    return perilune.batch(SYSTEM, campaign, workers=1, **options).table().to_pylist()


def start_of(row):
    return row["draw.plant.initial_altitude"], row["draw.plant.initial_path_angle"]


@pytest.fixture(scope="module")
def table_1():
    return {start_of(row): row for row in flown("table1")}


@pytest.fixture(scope="module")
def table_2():
    actual = defaultdict(list)
    for row in flown("table2"):
        assert row["success"]
        actual[start_of(row)].append(row)
    return actual


# ---- table 1 -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("start", NINE)
def test_table_1(table_1, start):
    _, altitude, time = TABLE_1[start]
    row = table_1[start]
    assert row["success"]
    assert row["metric.final_time"] == pytest.approx(time, abs=0.25)
    assert row["metric.final_altitude"] == pytest.approx(altitude, abs=0.1)
    assert 6.0 - 0.12 < row["metric.final_speed"] < 6.0  # braking at 10 m/s2, the hand-over is noticed within a step


@pytest.mark.parametrize("start", [NOMINAL, (16648.0, -1.65), (19648.0, -1.55)])
def test_descents_are_those_of_the_independent_flight(table_1, start):
    time, speed, altitude = fly(encoded_law, *start)
    row = table_1[start]
    assert row["metric.final_time"] == pytest.approx(time, abs=0.021)
    assert row["metric.final_speed"] == pytest.approx(speed, abs=0.12)
    assert row["metric.final_altitude"] == pytest.approx(altitude, abs=0.01)


@pytest.mark.parametrize("start", NINE)
def test_gravity_of_1_61_reaches_the_printed_speeds_at_the_printed_times(start):
    """An inference: with it all nine are within 0.05 s, and with the printed 1.623 none is."""
    speed, _, time = TABLE_1[start]
    error = {}
    for gravity in (1.61, 1.623):
        settings = {
            "plant.initial_altitude": start[0],
            "plant.initial_path_angle": start[1],
            "plant.surface_gravity": gravity,
            "monitor.handover_speed": 5.0,
        }
        flight = perilune.simulate(SYSTEM, set=settings)
        error[gravity] = flight.time[np.argmax(flight["plant.speed"] <= speed)] - time
    assert abs(error[1.61]) < 0.05 < error[1.623]


def test_without_the_slip_the_descents_are_12_to_18_s_shorter(table_1):
    for row in flown("table1", set={"guidance.exp_saturation": 0}):
        earlier = table_1[start_of(row)]["metric.final_time"] - row["metric.final_time"]
        assert row["success"]
        assert 12.0 < earlier < 18.0


@pytest.mark.parametrize("saturation", [LEGACY, TRUE])
def test_the_printed_formulas_crash(saturation):
    for start in NINE:
        time, speed, altitude = fly(printed_law, *start, saturation=saturation)
        assert altitude <= 0.0
        assert time < 89.0
        assert speed > 1440.0


def test_the_basic_solution_crashes():
    flight = perilune.simulate(SYSTEM, parameters=["basic.ssv"])
    assert flight["monitor.ground_contact"][-1]
    assert flight["plant.speed"][-1] > 1000.0


# ---- table 2 -----------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("start", TABLE_2)
def test_table_2(table_2, start):
    _, altitude, time = TABLE_2[start]
    rows = table_2[start]
    assert len(rows) == 20
    assert statistics.mean(row["metric.final_time"] for row in rows) == pytest.approx(time, abs=1.5)
    bound = 12.0 if start == APART else 10.0
    assert statistics.mean(row["metric.final_altitude"] for row in rows) == pytest.approx(altitude, abs=bound)


@pytest.mark.slow
def test_mean_altitude_of_table_2(table_2):
    """The effect of the errors on the altitude does not depend on the start; the eleven rows
    together have less scatter."""
    here = statistics.mean(row["metric.final_altitude"] for start in TABLE_2 for row in table_2[start])
    printed = [altitude for _, altitude, _ in TABLE_2.values()]
    error = statistics.stdev(printed) / len(printed) ** 0.5
    assert here == pytest.approx(statistics.mean(printed), abs=3.0 * error)


@pytest.mark.slow
def test_flights_of_a_start_differ_in_their_errors(table_2):
    for rows in table_2.values():
        assert len({row["metric.final_altitude"] for row in rows}) == len(rows)


# ---- robustness --------------------------------------------------------------------------------------------


def nominal(row, claim):
    """Return True if the flight is one of the nominal start, apart from the variation of the claim."""
    altitude = row["draw.altitude" if claim == "altitude" else "draw.plant.initial_altitude"]
    angle = row["draw.path_angle" if claim == "angle" else "draw.plant.initial_path_angle"]
    return (altitude, angle) == NOMINAL


@pytest.mark.skipif(not LONG, reason="369 flights each, under make long")
@pytest.mark.parametrize("claim", CLAIMS)
def test_every_claim_holds_at_the_nominal_start(claim):
    rows = flown(f"robustness_{claim}")
    assert len(rows) == 369
    chosen = [row for row in rows if nominal(row, claim)]
    name, value, spread = CLAIMS[claim]
    factors = sorted(row[f"draw.{name}"] / value for row in chosen)
    assert factors == pytest.approx(np.linspace(1.0 - spread, 1.0 + spread, 41), rel=1e-12)
    assert all(row["success"] for row in chosen)
    failed = [row for row in rows if not row["success"]]
    if claim == "angle":  # at the other starts the angle leaves what the law can fly
        assert failed
        angles = [row["draw.plant.initial_path_angle"] for row in failed]
        assert all(angle > -1.47 or angle < -1.765 for angle in angles)
    elif claim == "altitude":
        assert [(row["draw.factor"], row["draw.altitude"]) for row in failed] == [(1.4, 19648.0)]
    else:
        assert not failed


@pytest.mark.slow
def test_the_claims_do_not_hold_together():
    """Uniform over all five ranges at once, a success rate of 99 % is out of the question."""
    rows = flown("robustness_joint", trials=300)
    for name, value, spread in CLAIMS.values():
        factors = [row[f"draw.{name}"] / value for row in rows]
        assert stats.kstest(factors, stats.uniform(1.0 - spread, 2.0 * spread).cdf).pvalue > 1e-3
    reached = sum(row["success"] for row in rows)
    assert stats.binomtest(reached, len(rows), 0.99, alternative="less").pvalue < 1e-4
