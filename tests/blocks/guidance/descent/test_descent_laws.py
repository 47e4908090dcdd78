"""Descent laws that respect engine limits: times to go, limits and descents.

Truth: times and impulses computed by a separate program; scipy's minimiser over profiles solved by numpy; the exact
analytic guidance with an equal time to go; arrival at the target (descents over a spherical Moon).
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from perilune.fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from perilune.fmus_src.guidance.fractional import GainChoice
from perilune.fmus_src.guidance.polynomial_guidance import TimeChoice
from perilune.fmus_src.interfaces.ports.landing import TerminalStatus
from tests.support.descent.laws import (
    A1,
    C1,
    C2,
    DESCENT_LAWS,
    POLYNOMIAL,
    TO_A_PLACE,
    ApolloGuidance,
    FractionalGuidance,
    GravityTurnGuidance,
    PoweredGuidance,
    ZemZevGuidance,
    fly,
    start,
)
from tests.support.descent.polynomial_laws import EXHAUST, Leg, Limits
from tests.support.lengths import either

G = 1.624219  # m/s2
ZEM_ZEV = (1.0, 6.0, np.zeros(3))
GLIDE, TILT = np.radians(15.0), np.radians(60.0)
CONSTRAINED = {"glide_slope": GLIDE, "largest_tilt": TILT}


@pytest.mark.parametrize(
    ("leg", "time", "impulse"),
    [
        (C1, 192.9635022559421, 1008.8936032160651),
        (C2, 283.52007448486216, 1750.2327939260706),
        (A1, 45.02479230484734, 125.30875845488315),
    ],
)
def test_the_time_of_minimum_propellant(leg, time, impulse):
    """As printed, and close to what scipy finds: the largest thrust bounds it, or the impulse is flat there."""
    guidance = start(ZemZevGuidance, leg)
    assert guidance.time_to_go == pytest.approx(time, abs=1e-3)
    assert guidance.predicted_propellant == pytest.approx(-guidance.mass * np.expm1(-impulse / EXHAUST), rel=1e-6)
    limits = Limits(mass=guidance.mass)
    best = minimize_scalar(
        lambda t: limits.price(leg, t, ZEM_ZEV, False), bounds=(0.9 * time, 1.2 * time), method="bounded"
    )
    assert limits.price(leg, guidance.time_to_go, ZEM_ZEV, False) < best.fun + 0.05
    assert limits.measure(leg, guidance.time_to_go, ZEM_ZEV)[0] == pytest.approx(impulse, abs=1e-6)


@pytest.mark.parametrize(
    ("leg", "weight", "time"),
    [
        (C1, 0.0, 266.2239578966139),
        (C1, 1.0, 251.75924965971313),
        (C2, 0.0, 450.37743269536827),
        (C2, 1.0, 402.95228146777936),
        (A1, 0.0, 66.13100644125973),
        (A1, 1.0, 59.69401286779201),
    ],
)
def test_the_time_of_minimum_effort(leg, weight, time):
    """As printed; and the integral of |a|^2/2 + weight over profiles by numpy is least there, to its curvature."""
    guidance = start(ZemZevGuidance, leg, time_choice=TimeChoice.EFFORT, time_weight=weight)
    assert guidance.time_to_go == pytest.approx(time, abs=1e-6)
    assert guidance.choices == 1
    plain = Leg(leg.position, leg.velocity, leg.target, leg.gravity, round_moon=False)
    way, gain = leg.errors(time)
    fixed = Leg(plain.target - way, leg.velocity, plain.target, leg.gravity, round_moon=False)
    if np.linalg.norm(leg.velocity + gain) < 1e-3 or leg is A1:  # arrives at rest also without the correction
        nodes, weights = np.polynomial.legendre.leggauss(8)

        def effort(t):
            thrust = fixed.thrust(t, ZEM_ZEV, (nodes + 1.0) / 2.0)
            return t * (weights / 2.0 @ np.sum(thrust**2, axis=1) / 2.0 + weight)

        best = minimize_scalar(effort, bounds=(0.5 * time, 1.5 * time), method="bounded", options={"xatol": 1e-6})
        assert best.x == pytest.approx(time, rel=2e-3)


def test_hovering_above_the_target_takes_the_time_of_minimum_effort():
    height = 500.0
    hover = Leg(np.array([0.0, 0.0, 2000.0]), np.zeros(3), np.array([0.0, 0.0, 1500.0]))
    guidance = start(ZemZevGuidance, hover, time_choice=TimeChoice.EFFORT, gravity_correction=False)
    assert guidance.time_to_go == pytest.approx(np.sqrt(6.0 * height / 1.624219), rel=1e-12)


@given(
    position=st.tuples(st.floats(-2e4, 2e4), st.floats(-2e4, 2e4), st.floats(500.0, 9e3)),
    speed=st.tuples(*[st.floats(-300.0, 300.0)] * 3),
    time=st.floats(4.0, 300.0),
    correction=st.booleans(),
)
@settings(max_examples=either(50, 16), deadline=None)
def test_with_a_fixed_time_zem_zev_is_the_exact_analytic_guidance(position, speed, time, correction):
    """Both command a0 + a1 t: the first Simpson's mean of the profile, the second the value in the middle."""
    leg = Leg(np.array(position), np.array(speed), np.array([0.0, 0.0, 1500.0]))
    commands = []
    for law in (ZemZevGuidance, AnalyticExactGuidance):
        guidance = start(law, leg, frozen_time_to_go=time, gravity_correction=correction)
        guidance.step(0.0, 0.5)
        commands.append(
            [
                guidance.thrust_acceleration * np.array(guidance.thrust_direction),
                np.array(guidance.thrust_direction_rate),
            ]
        )
        assert guidance.time_to_go == time
    assert commands[0][0] == pytest.approx(commands[1][0], rel=1e-9, abs=1e-9)
    assert commands[0][1] == pytest.approx(commands[1][1], rel=1e-6, abs=1e-9)


def test_a_search_keeps_glide_slope_and_tilt():
    """The approach start, as printed; without the limits it leaves both."""
    searched = start(FractionalGuidance, A1, gain_choice=GainChoice.SEARCHED, **CONSTRAINED)
    assert searched.flown_kr == 6.0
    assert searched.time_to_go == pytest.approx(60.4904, abs=1e-3)
    assert searched.predicted_propellant == pytest.approx(-560.0 * np.expm1(-142.3371 / EXHAUST), abs=1e-3)
    assert searched.limit == 0
    limits = Limits(mass=560.0, glide_slope=GLIDE, largest_tilt=TILT)
    shape = (1.0, 6.0, np.array([0.0, 0.0, 2.0]))
    _, load, depth, tilt = limits.measure(A1, searched.time_to_go, shape)
    assert load < 0.92
    assert depth < 0.5
    assert tilt < 1e-2


@pytest.mark.parametrize("law", POLYNOMIAL)
def test_what_a_plan_breaks(law):
    """`limit` is the sum of what the profile leaves, measured with numpy at the law's own time."""
    for leg, mass, parameters in (
        (C1, 940.0, {}),
        (C1, 1400.0, {}),
        (A1, 560.0, CONSTRAINED),
        (A1, 560.0, {"minimum_thrust": 4000.0}),
    ):
        if law is ApolloGuidance and leg is A1:
            continue  # its jerk is that of a braking
        guidance = start(law, leg, mass=mass, **parameters)
        known = {"glide_slope": GLIDE, "largest_tilt": TILT} if "glide_slope" in parameters else {}
        limits = Limits(mass=mass, minimum=guidance.minimum_thrust, **known)
        shape = guidance.shape(guidance.flown_kr)
        expected = limits.broken(leg, guidance.time_to_go, (shape.gamma, shape.kr, np.array(shape.final)))
        assert guidance.limit == expected
        assert guidance.status == (TerminalStatus.CLAMPED if expected else TerminalStatus.GOOD)


@pytest.mark.parametrize(("gamma", "kr"), [(1.0, 5.0), (1.0, 9.0), (2.0, 16.0)])
def test_exponents_without_a_profile_are_no_solution(gamma, kr):
    guidance = start(FractionalGuidance, C1, gamma=gamma, kr=kr)
    assert guidance.status == TerminalStatus.NO_SOLUTION
    assert guidance.thrust_acceleration == 0.0


def test_a_jerk_of_the_wrong_sign_is_no_solution():
    guidance = start(ApolloGuidance, C1, target_jerk=-0.5)
    assert guidance.status == TerminalStatus.NO_SOLUTION
    assert guidance.time_to_go == 0.0


def test_apollo_s_time_settles_with_the_gravity_over_it():
    """The jerk's time with gravity corrected over itself, as printed."""
    assert start(ApolloGuidance, C1).forward == pytest.approx([-1.0, 0.0, 0.0])
    for leg, time in ((C1, 192.53931), (C2, 297.84364)):
        guidance = start(ApolloGuidance, leg)
        for _ in range(3):
            guidance.expected_time = guidance.time_from_jerk(guidance.time_to_go)
            guidance.time_to_go = guidance.expected_time
        assert guidance.time_to_go == pytest.approx(time, abs=1e-4)


def test_hovering_starts_are_no_solution_for_powered_guidance():
    hover = Leg(np.array([0.0, 0.0, 2000.0]), np.zeros(3), np.array([0.0, 0.0, 1500.0]))
    guidance = start(PoweredGuidance, hover)
    assert guidance.status == TerminalStatus.NO_SOLUTION
    assert guidance.thrust_acceleration == 0.0


def test_more_thrust_than_there_is_is_flown_at_the_maximum():
    guidance = start(PoweredGuidance, C1, maximum_thrust=3500.0)
    assert guidance.status == TerminalStatus.CLAMPED
    assert guidance.limit == 1
    assert guidance.thrust_acceleration * guidance.mass == pytest.approx(3500.0)


@pytest.mark.parametrize("law", TO_A_PLACE)
@pytest.mark.parametrize("loss", [0.0, 0.03])
def test_flights_meet_the_target(law, loss):
    """Over a round Moon with cycles of 0.5 s; also with 3 % less thrust than guidance knows."""
    guidance = start(law, C1, last_burn=2.0)
    plant, rows = fly(guidance, C1, loss=loss)
    assert guidance.finished
    assert np.linalg.norm(np.subtract(plant.position, C1.target)) < (5.0 if loss else 0.5)
    assert np.linalg.norm(plant.velocity) < (2.0 if loss else 0.3)
    spent = 940.0 - plant.mass
    assert 255.0 < spent < 280.0  # the least for a point mass is 257.006
    assert rows[:, 0].max() <= 5099.0


def test_less_thrust_than_known_makes_the_law_choose_anew():
    guidance = start(ZemZevGuidance, C1, thrust_margin=1.0)
    fly(guidance, C1, loss=0.06)
    assert guidance.choices > 1


def test_a_gravity_turn_predicts_its_miss_and_propellant():
    """From 2500 m aside at 100 m/s, 60 deg and 2000 m above: 1780.183 m along (DOP853 of the hodograph has it)."""
    guidance = GravityTurnGuidance(gravity=G, mass=560.0, position=[2500.0, 0.0, 2100.0])
    guidance.velocity = [-100.0 * math.sin(math.pi / 3.0), 0.0, -50.0]
    guidance.target_position = [0.0, 0.0, 100.0]
    guidance.initialize()

    def fall(_, y):
        size = np.hypot(y[2], y[3])
        thrust = guidance.thrust_acceleration / size
        return [y[2], y[3], -thrust * y[2], -thrust * y[3] - G]

    start_of_turn = [2500.0, 2100.0, *guidance.velocity[::2]]
    flown = solve_ivp(fall, (0.0, 0.999 * guidance.time_to_go), start_of_turn, rtol=1e-10, atol=1e-8)
    assert guidance.predicted_miss == pytest.approx(abs(flown.y[0, -1]), abs=0.1)
    spent = 1.0 - math.exp(-guidance.thrust_acceleration * guidance.time_to_go / (9.80665 * 319.0))
    assert guidance.predicted_propellant == pytest.approx(560.0 * spent, rel=1e-12)


def test_a_gravity_turn_has_a_height_and_no_place():
    guidance = start(GravityTurnGuidance, A1)
    plant, _ = fly(guidance, A1, step=0.1)
    assert guidance.finished
    assert plant.position[2] == pytest.approx(100.0, abs=2.0)
    assert np.linalg.norm(plant.velocity) < 0.5
    assert np.linalg.norm(np.subtract(plant.position, A1.target)) > 100.0


@pytest.mark.parametrize("fraction", [0.0, 0.75])
def test_ignition_waits_for_its_fraction_of_thrust(fraction):
    guidance = start(GravityTurnGuidance, A1, ignition_fraction=fraction)
    _, rows = fly(guidance, A1, step=0.1)
    thrust = rows[:, 0]
    first = np.argmax(thrust > 0.0)
    assert thrust[first] >= fraction * 5099.0
    assert np.all(thrust[first:-1] > 0.0)
    assert (first > 0) == (fraction > 0.0)


@pytest.mark.parametrize("law", DESCENT_LAWS)
@given(
    position=st.tuples(*[st.floats(-3e5, 3e5)] * 3),
    speed=st.tuples(*[st.floats(-2e3, 2e3)] * 3),
    mass=st.sampled_from([0.0, 1.0, 560.0, 940.0, 1e6]),
    flat=st.booleans(),
)
@settings(max_examples=either(15, 5), deadline=None)
def test_any_start_gives_a_finite_command(law, position, speed, mass, flat):
    leg = Leg(np.array(position), np.array(speed), np.array([0.0, 0.0, 1500.0]))
    guidance = start(law, leg, mass=mass, gravity_correction=not flat, **CONSTRAINED)
    for k in range(2):
        guidance.step(0.5 * k, 0.5)
        numbers = [guidance.thrust_acceleration, guidance.time_to_go, *guidance.thrust_direction_rate]
        assert np.all(np.isfinite(numbers))
        assert np.linalg.norm(guidance.thrust_direction) == pytest.approx(1.0)
