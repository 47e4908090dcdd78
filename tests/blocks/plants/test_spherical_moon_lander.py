"""Lander over a spherical Moon, compared with closed forms, Kepler's laws and an adaptive integrator.

Truth: scipy's DOP853 at 1e-12 relative for the complete motion, with cross products for the attitude; Kepler's equation
for free flight; the rocket equation; closed forms of the first-order lag and of the slew limit; free fall for ground
contact. Without lag, response time and limit, over a Moon of very large radius, the motion agrees with DOP853 to 1e-11.
The order of convergence is measured, and results may depend on the communication steps by no more than rounding.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from perilune.fmus_src.plants.spherical_moon_lander import SphericalMoonLander
from tests.support.lengths import either

RADIUS = 1.7374e6
MU = 4.9028e12
EXHAUST = 319.0 * 9.80665  # m/s
SLEW = math.radians(10.0)
CENTRE = np.array([0.0, 0.0, -RADIUS])
IDEAL = {"thrust_lag": 0.0, "direction_response": 0.0, "slew_rate_limit": 0.0}
DIRECTION = [-0.8, 0.36, 0.48]
TURNING = [0.0036, 0.0048, 0.0024]  # 1/s, perpendicular to DIRECTION, 6.5e-3 rad/s


def unit(vector):
    return np.asarray(vector) / np.linalg.norm(vector)


def angle_between(a, b):
    return 2.0 * math.atan2(np.linalg.norm(np.subtract(a, b)), np.linalg.norm(np.add(a, b)))


def lander(**settings_):
    plant = SphericalMoonLander(**settings_)
    plant.initialize()
    return plant


def command(plant, thrust, direction=DIRECTION, rate=(0.0, 0.0, 0.0), since=0.0, duration=1e9):
    plant.thrust = thrust
    plant.thrust_direction = direction
    plant.thrust_direction_rate = rate
    plant.command_time = since
    plant.burn_duration = duration
    return plant


def fly(plant, start, end, step=0.1):
    for k in range(round((end - start) / step)):
        plant.step(start + k * step, step)
    return plant


def everything(plant):
    """Return position, velocity, mass, thrust, attitude, sensed velocity."""
    thrust = [plant.mass, plant.delivered_thrust]
    return np.array([*plant.position, *plant.velocity, *thrust, *plant.attitude, *plant.sensed_velocity])


def integrated(y, thrust, direction, rate, since, start, end, lag, response, limit):
    """Integrate the same by DOP853; without lag or response, ``y`` must be on the command already."""

    def commanded(t):
        return unit(np.add(direction, np.multiply(rate, t - since)))

    def slope(t, y):
        force, attitude = (y[7], y[8:11]) if lag else (thrust, y[8:11])
        turning = np.zeros(3)
        if response or limit:
            axis = np.cross(attitude, commanded(t))
            angle = angle_between(unit(attitude), commanded(t))
            speed = min(angle / response if response else math.inf, limit or math.inf)
            if np.linalg.norm(axis) > 0.0:
                turning = speed * np.cross(unit(axis), attitude)
        else:
            attitude = commanded(t)
        centred = y[:3] - CENTRE
        specific = force / y[6] * attitude
        gravity = -MU * centred / np.linalg.norm(centred) ** 3
        lagging = (thrust - y[7]) / lag if lag else 0.0
        return np.concatenate([y[3:6], specific + gravity, [-force / EXHAUST, lagging], turning, specific])

    return solve_ivp(slope, (start, end), y, method="DOP853", rtol=1e-12, atol=1e-12, max_step=0.1).y[:, -1]


COMMANDS = [  # thrust, direction, rate, since, burn duration; 6 s each: a jump of 1 rad, a cut-off between steps
    (4500.0, [-0.8, 0.0, 0.6], [0.003, 0.004, 0.004], -1.0, 1e9),
    (3000.0, [-0.3, 0.6, 0.74], [0.02, -0.01, 0.01], 6.0, 1e9),
    (5000.0, [-0.9, 0.0, 0.436], [0.003, -0.001, 0.005], 12.0, 3.333),
]


def manoeuvre(step, lag, response, limit):
    """Return state at the end of each command, flown with an internal step."""
    plant = lander(internal_step=step, thrust_lag=lag, direction_response=response, slew_rate_limit=limit)
    rows = []
    for k, each in enumerate(COMMANDS):
        fly(command(plant, *each), 6.0 * k, 6.0 * (k + 1), step)
        rows.append(everything(plant))
    return rows


def manoeuvre_integrated(lag, response, limit):
    y = everything(lander())
    rows = []
    for k, (thrust, direction, rate, since, duration) in enumerate(COMMANDS):
        start, end = 6.0 * k, 6.0 * (k + 1)
        if k == 0:
            y[8:11] = unit(np.add(direction, np.multiply(rate, -since)))
        off = min(since + duration, end)
        y = integrated(y, thrust, direction, rate, since, start, off, lag, response, limit)
        if off < end:
            y = integrated(y, 0.0, direction, rate, since, off, end, lag, response, limit)
        rows.append(y)
    return rows


def errors_of(actual, expected):
    """Return lengths of the differences of position, velocity, mass, attitude and sensed velocity."""
    parts = [slice(0, 3), slice(3, 6), slice(6, 7), slice(8, 11), slice(11, 14)]
    return np.array([np.linalg.norm((actual - expected)[part]) for part in parts])


def test_start_is_the_initial_state():
    plant = lander()
    assert plant.position == plant.initial_position
    assert plant.velocity == plant.initial_velocity
    assert (plant.mass, plant.delivered_thrust, plant.ground_contact) == (940.0, 0.0, False)
    assert plant.sensed_velocity == plant.specific_force == [0.0, 0.0, 0.0]


def test_declared_start_is_that_of_braking():
    """18.148 km up, 265 km of ground from the site, 1689 m/s at 1.6 rad from the vertical."""
    plant = lander()
    centred = np.array(plant.position) - CENTRE
    assert plant.altitude == pytest.approx(18148.0, abs=1.0)
    assert RADIUS * angle_between(unit(centred), [0.0, 0.0, 1.0]) == pytest.approx(265e3, abs=10.0)
    assert plant.speed == pytest.approx(1689.0, abs=0.5)
    assert angle_between(unit(plant.velocity), unit(centred)) == pytest.approx(1.6, abs=5e-4)
    assert np.dot(plant.position, plant.velocity) < 0.0  # towards the site


@pytest.mark.parametrize(
    ("lag", "response", "limit", "position", "velocity"),
    [(0.1, 0.5, SLEW, 1e-4, 4e-6), (0.1, 0.5, 0.0, 1e-3, 1e-4), (0.3, 0.2, 0.5, 5e-4, 1e-4)],
    ids=["all effects", "no limit", "other constants"],
)
def test_all_effects_together_follow_dop853(lag, response, limit, position, velocity):
    """A tenth of a millimetre after 18 s with a jump of 1 rad (2 rad/s where nothing limits it) and a cut-off."""
    bounds = [position, velocity, 1e-10, 2e-6, velocity]
    actual, expected = manoeuvre(0.1, lag, response, limit), manoeuvre_integrated(lag, response, limit)
    for row, truth in zip(actual, expected, strict=True):
        assert (errors_of(row, truth) < bounds).all()
        assert row[7] == pytest.approx(truth[7], abs=1e-6)  # thrust


@pytest.mark.parametrize(
    ("lag", "response", "limit", "least"),
    [(0.1, 0.5, 0.0, 3.7), (0.0, 0.5, 0.0, 3.7), (0.1, 0.5, SLEW, 2.7)],
    ids=["lag and response", "response", "with the knee of the limit"],
)
def test_integrator_is_of_fourth_order(lag, response, limit, least):
    """Position and velocity over the first two commands; a knee inside a step costs one order, once."""
    expected = manoeuvre_integrated(lag, response, limit)[1]
    coarse, fine = (errors_of(manoeuvre(step, lag, response, limit)[1], expected)[:2] for step in (0.1, 0.025))
    assert (np.log2(coarse / fine) / 2.0 > least).all()


def test_turning_direction_without_lags_follows_dop853():
    """As the flat lander's test: a command that turns, 20 s, internal steps of 0.1 s, 1e-11."""
    plant = command(lander(**IDEAL), 4500.0, rate=TURNING, since=-3.0)
    expected = integrated(everything(plant), 4500.0, DIRECTION, TURNING, -3.0, 0.0, 20.0, 0.0, 0.0, 0.0)
    fly(plant, 0.0, 20.0, 1.0)
    actual = everything(plant)
    assert np.linalg.norm(actual[:3] - expected[:3]) < 1e-11 * np.linalg.norm(expected[:3])
    assert np.linalg.norm(actual[3:6] - expected[3:6]) < 1e-11 * np.linalg.norm(expected[3:6])
    assert actual[6] == pytest.approx(expected[6], rel=1e-13)
    assert plant.attitude == pytest.approx(unit(np.add(DIRECTION, np.multiply(TURNING, 23.0))), abs=1e-15)


def test_free_flight_is_an_ellipse():
    """Kepler's equation, energy and angular momentum over most of an orbit of 1.9 x 3 Mm, in 3 dimensions."""
    turn = Rotation.from_rotvec([0.3, -0.5, 0.9])
    a, e = 2.45e6, 0.22
    b, n = a * math.sqrt(1.0 - e * e), math.sqrt(MU / a**3)

    def kepler(time):
        anomaly = brentq(lambda x: x - e * math.sin(x) - n * time, -10.0, 20.0, xtol=1e-14)
        c, s = math.cos(anomaly), math.sin(anomaly)
        velocity = np.array([-a * s, b * c, 0.0]) * n / (1.0 - e * c)
        return turn.apply([a * (c - e), b * s, 0.0]) + CENTRE, turn.apply(velocity)

    position, velocity = kepler(0.0)
    plant = lander(initial_position=position.tolist(), initial_velocity=velocity.tolist(), internal_step=5.0, **IDEAL)
    energy = 0.5 * velocity @ velocity - MU / np.linalg.norm(position - CENTRE)
    momentum = np.cross(position - CENTRE, velocity)
    for k in range(30):
        fly(plant, 300.0 * k, 300.0 * (k + 1), 100.0)
        expected, speed = kepler(300.0 * (k + 1))
        assert plant.position == pytest.approx(expected, abs=1e-3)
        assert plant.velocity == pytest.approx(speed, abs=1e-6)
        actual = np.array(plant.position) - CENTRE
        assert plant.altitude == pytest.approx(np.linalg.norm(actual) - RADIUS, abs=1e-8)
        assert plant.speed == pytest.approx(np.linalg.norm(plant.velocity), rel=1e-15)
        assert 0.5 * plant.speed**2 - MU / np.linalg.norm(actual) == pytest.approx(energy, rel=1e-10)
        assert np.cross(actual, plant.velocity) == pytest.approx(momentum, abs=1e-10 * np.linalg.norm(momentum))
    assert plant.sensed_velocity == plant.specific_force == [0.0, 0.0, 0.0]
    assert plant.mass == 940.0


@pytest.mark.parametrize("lag", [0.0, 0.1, 2.0])
@pytest.mark.parametrize("impulse", [200.0, 319.0])
def test_sensed_velocity_is_that_of_the_rocket_equation(lag, impulse):
    plant = command(lander(thrust_lag=lag, specific_impulse=impulse), 5000.0, duration=37.77)
    for k in range(60):
        plant.step(1.0 * k, 1.0)
        gained = impulse * 9.80665 * math.log(940.0 / plant.mass)
        assert plant.sensed_velocity == pytest.approx(gained * np.array(DIRECTION), abs=1e-9)
    if lag == 0.0:
        assert plant.mass == pytest.approx(940.0 - 5000.0 * 37.77 / (impulse * 9.80665), rel=1e-13)


def test_thrust_and_mass_are_exact_for_a_lag():
    """On, down and off, the last within a step: a sum of exponentials, and its integral for the mass."""
    lag = 0.37
    plant = lander(thrust_lag=lag)
    commands = [(0.0, 4000.0), (1.2, 2500.0), (2.3456, 0.0)]
    for k in range(40):
        time = 0.1 * k
        command(plant, 4000.0 if k < 12 else 2500.0, duration=1e9 if k < 12 else 2.3456)
        plant.step(time, 0.1)
        thrust, impulse, before = 0.0, 0.0, 0.0
        for since, level in commands:
            past = time + 0.1 - since
            if past > 0.0:
                thrust += (level - before) * (1.0 - math.exp(-past / lag))
                impulse += (level - before) * (past - lag * (1.0 - math.exp(-past / lag)))
            before = level
        assert plant.delivered_thrust == pytest.approx(thrust, abs=1e-8)
        assert plant.mass == pytest.approx(940.0 - impulse / EXHAUST, abs=1e-11)


def test_lag_leaves_the_impulse_of_a_whole_burn_as_it_is():
    """Thrust rises late and ends late: the impulse is the commanded one."""
    plant = fly(command(lander(thrust_lag=0.4), 3000.0, duration=5.25), 0.0, 25.0)
    assert 940.0 - plant.mass == pytest.approx(3000.0 * 5.25 / EXHAUST, rel=1e-12)


def test_slew_limit_turns_for_angle_over_limit():
    """1.2 rad at 10 deg/s, without response: 6.875 s, linear in time."""
    plant = fly(command(lander(direction_response=0.0), 0.0), 0.0, 0.5)
    assert plant.attitude == DIRECTION  # started on the first command
    axis = unit(np.cross(DIRECTION, [0.0, 0.0, 1.0]))
    goal = Rotation.from_rotvec(1.2 * axis).apply(DIRECTION)
    command(plant, 0.0, goal.tolist())
    for k in range(90):
        plant.step(0.5 + 0.1 * k, 0.1)
        turned = min(1.2, SLEW * 0.1 * (k + 1))
        assert plant.attitude == pytest.approx(Rotation.from_rotvec(turned * axis).apply(DIRECTION), abs=1e-10)
    assert plant.attitude == pytest.approx(goal, abs=1e-15)


def test_response_and_limit_are_a_line_and_then_an_exponential():
    plant = fly(command(lander(), 0.0), 0.0, 0.1)
    goal = Rotation.from_rotvec(1.2 * unit(np.cross(DIRECTION, [0.0, 0.0, 1.0]))).apply(DIRECTION)
    command(plant, 0.0, goal.tolist())
    knee = 0.5 * SLEW
    straight = (1.2 - knee) / SLEW
    for k in range(120):
        plant.step(0.1 + 0.1 * k, 0.1)
        past = 0.1 * (k + 1)
        left = 1.2 - SLEW * past if past < straight else knee * math.exp(-(past - straight) / 0.5)
        assert angle_between(plant.attitude, goal) == pytest.approx(left, abs=1e-7)


@pytest.mark.parametrize(("off", "others"), [("direction_response", {}), ("slew_rate_limit", {"thrust_lag": 0.3})])
def test_short_constants_are_taken_in_shorter_steps(off, others):
    """Constants below the internal step stay stable and reach the result of a fine step."""
    short = {"direction_response": 0.02, "slew_rate_limit": 0.5, "thrust_lag": 0.02} | others | {off: 0.0}
    ends = []
    for internal in (0.1, 0.005):
        plant = lander(internal_step=internal, **short)
        for k, each in enumerate(COMMANDS):
            fly(command(plant, *each), 6.0 * k, 6.0 * (k + 1))
        ends.append(everything(plant))
    assert (errors_of(*ends) < [2e-3, 2e-4, 1e-9, 1e-8, 2e-4]).all()


def test_responses_too_short_to_count_are_none():
    plant = lander(direction_response=1e-9, slew_rate_limit=0.0)
    for k in range(5):
        command(plant, 4000.0, COMMANDS[k % 3][1])
        plant.step(0.1 * k, 0.1)
        assert plant.attitude == pytest.approx(unit(COMMANDS[k % 3][1]), abs=1e-15)


@given(st.lists(st.integers(1, 60), min_size=1, max_size=8), st.integers(1, 5999), st.booleans())
@settings(max_examples=either(25, 8), deadline=None)
def test_results_do_not_depend_on_how_communication_cuts_them(cuts, thousandths, effects):
    """Communication points at whole multiples of the internal step; thrust ends anywhere."""
    effect = {} if effects else IDEAL
    points = sorted({0, 60, *(int(value) % 60 for value in np.cumsum(cuts))})
    ends = []
    for some in ([0, 60], points):
        plant = fly(command(lander(**effect), 0.0, [0.0, 0.6, 0.8]), 0.0, 0.1)
        command(plant, 4500.0, rate=TURNING, since=0.1, duration=thousandths / 1000.0)
        for first, second in itertools.pairwise(some):
            plant.step(0.1 + 0.1 * first, 0.1 * (second - first))
        ends.append(everything(plant))
    assert errors_of(*ends)[:2] == pytest.approx([0.0, 0.0], abs=1e-8)
    assert ends[0][6:] == pytest.approx(ends[1][6:], abs=1e-9)


def test_specific_force_is_the_mean_over_the_last_step():
    plant = command(lander(), 4500.0, rate=TURNING, duration=2.22)
    for k in range(8):
        before = np.array(plant.sensed_velocity)
        plant.step(0.5 * k, 0.5)
        assert plant.specific_force == pytest.approx((plant.sensed_velocity - before) / 0.5, abs=1e-12)
    assert np.linalg.norm(plant.specific_force) < 1e-4


def test_a_moon_without_curvature_or_mass_flow_is_the_flat_one():
    """A parabola: the radius so large, the exhaust so fast, that gravity and mass are constant."""
    radius, gravity = 1e13, 1.62
    plant = lander(
        initial_position=[1e5, -2e4, 1e4],
        initial_velocity=[-930.0, 180.0, -40.0],
        moon_radius=radius,
        gravitational_parameter=gravity * radius**2,
        specific_impulse=1e12,
        **IDEAL,
    )
    fly(command(plant, 4500.0), 0.0, 10.0)
    acceleration = 4500.0 / 940.0 * np.array(DIRECTION) - [0.0, 0.0, gravity]
    assert plant.velocity == pytest.approx([-930.0, 180.0, -40.0] + 10.0 * acceleration, abs=1e-6)
    expected = [1e5 - 9300.0, -2e4 + 1800.0, 1e4 - 400.0] + 50.0 * acceleration
    assert plant.position == pytest.approx(expected, abs=1e-5)


@given(st.floats(-math.pi, math.pi))
@settings(max_examples=either(20, 6), deadline=None)
def test_motion_turns_with_the_frame_about_the_vertical(azimuth):
    turn = Rotation.from_rotvec([0.0, 0.0, azimuth])
    plain = lander()
    turned = lander(
        initial_position=turn.apply(plain.position).tolist(), initial_velocity=turn.apply(plain.velocity).tolist()
    )
    for k, (thrust, direction, rate, _, _) in enumerate(COMMANDS):
        fly(command(plain, thrust, direction, rate, 1.0 * k), 1.0 * k, k + 1.0, 0.5)
        command(turned, thrust, turn.apply(direction).tolist(), turn.apply(rate).tolist(), 1.0 * k)
        fly(turned, 1.0 * k, k + 1.0, 0.5)
    assert turned.position == pytest.approx(turn.apply(plain.position), abs=1e-8)
    assert turned.velocity == pytest.approx(turn.apply(plain.velocity), abs=1e-10)
    assert turned.attitude == pytest.approx(turn.apply(plain.attitude), abs=1e-12)
    assert turned.altitude == pytest.approx(plain.altitude, abs=1e-8)


def test_everything_stops_at_the_ground_and_is_kept():
    """Dropped from 20 m at the site: a parabola of 4.96 s, then what was there at the end of that internal step."""
    gravity = MU / RADIUS**2
    contact = math.ceil(math.sqrt(40.0 / gravity) * 10.0) / 10.0
    for step in (0.1, 0.5, 2.5):
        plant = lander(initial_position=[0.0, 0.0, 20.0], initial_velocity=[0.0, 0.0, 0.0])
        for k in range(round(10.0 / step)):
            plant.step(k * step, step)
            assert plant.ground_contact == ((k + 1) * step > contact - 1e-9)
            if plant.ground_contact:
                command(plant, 4000.0)
        assert plant.altitude == pytest.approx(20.0 - 0.5 * gravity * contact**2, abs=6e-4)  # gravity grows by 2e-5
        assert plant.velocity == pytest.approx([0.0, 0.0, -gravity * contact], abs=2e-4)
        assert plant.position[2] == pytest.approx(plant.altitude, abs=1e-9)
        assert plant.specific_force == [0.0, 0.0, 0.0]
        assert (plant.delivered_thrust, plant.mass) == (0.0, 940.0)


def test_a_start_on_the_ground_stays_there():
    plant = command(lander(initial_position=[0.0, 0.0, 0.0]), 4000.0)
    assert plant.ground_contact
    plant.step(0.0, 0.1)
    assert plant.position == [0.0, 0.0, 0.0]
    assert plant.mass == 940.0


def test_thrust_ends_where_the_mass_does():
    plant = fly(command(lander(initial_mass=1.0), 4000.0), 0.0, 2.0)
    assert 0.0 < plant.mass < 0.2
    retained = list(plant.sensed_velocity)
    fly(plant, 2.0, 3.0)
    assert plant.delivered_thrust == 0.0
    assert plant.sensed_velocity == retained


def test_direction_need_not_be_a_unit_vector_nor_be_there():
    plant = fly(command(lander(**IDEAL), 4500.0, [5.0 * x for x in DIRECTION]), 0.0, 0.1)
    assert plant.attitude == pytest.approx(DIRECTION, abs=1e-15)
    fly(command(plant, 4500.0, [0.0, 0.0, 0.0]), 0.1, 0.2)
    assert plant.attitude == pytest.approx(DIRECTION, abs=1e-15)


def test_an_engine_does_not_pull():
    plant = fly(command(lander(), -4500.0), 0.0, 1.0)
    assert (plant.mass, plant.delivered_thrust) == (940.0, 0.0)


def test_declared_starts_alone_run():
    plant = lander()
    plant.step(0.0, 0.1)
    assert plant.altitude < 18148.5
    assert plant.attitude == [0.0, 0.0, 1.0]
