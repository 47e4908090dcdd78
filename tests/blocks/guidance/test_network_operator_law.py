"""Network operator law of Diveev, Pupkov and Sofronova (2013), in the plane and in space.

Truth: the law that the published matrix encodes, written out in independent_descent.py with both values of the
saturated exponential, and the published basic solution, at 1000 random points each (1e-9 relative); the force of the
planar law rotated into space by vector algebra (1e-9); a planar descent with rotating vertical, compared with a descent
in space integrated here by a Runge-Kutta method (0.1 s and 0.1 m at the hand-over).
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.guidance.network_operator import NetworkOperatorGuidance
from perilune.fmus_src.guidance.planar_network_operator import PlanarNetworkOperator
from perilune.fmus_src.plants.planar_moon_lander import PlanarMoonLander
from tests.support.flights.independent_descent import H0, HF, LEGACY, Q3, TRUE, encoded_law
from tests.support.lengths import either

KGF = 9.80665
P0, DP = 440.0 * KGF, 80.0 * KGF
RADIUS = 1.7384e6
GRAVITY = 1.623
MODES = {TRUE: 0, LEGACY: 1}
# (row, column): operation, counted from 1
BASIC = {
    (1, 7): 1, (2, 7): 1, (3, 8): 1, (3, 11): 9, (4, 8): 1, (5, 9): 1, (5, 12): 11, (6, 9): 1, (7, 7): 1, (7, 10): 1,
    (8, 8): 1, (8, 11): 1, (9, 9): 1, (9, 12): 3, (10, 15): 1, (11, 11): 1, (11, 14): 1, (12, 12): 1, (12, 13): 1,
    (13, 16): 1, (14, 15): 1,
}  # fmt: skip


def row_order(entries):
    matrix = [0] * 256
    for (row, column), operation in entries.items():
        matrix[16 * (row - 1) + column - 1] = operation
    return matrix


def commanded(u1, u2):
    """Return thrust angle (rad) and thrust (N) within their limits."""
    return np.clip(u1, 0.0, np.pi), P0 + np.clip(KGF * u2, -DP, DP)


def planar(path_angle, altitude, **parameters):
    block = PlanarNetworkOperator(measured_path_angle=path_angle, measured_altitude=altitude, **parameters)
    block.initialize()
    return block


def points(count, seed):
    """Return path angles and altitudes of a descent and far around it."""
    generator = np.random.default_rng(seed)
    wide = np.column_stack([generator.uniform(-6.0, 3.0, count // 2), generator.uniform(-2e4, 4e4, count // 2)])
    near = np.column_stack([generator.uniform(-1.8, -1.5, count // 2), generator.uniform(1.4e3, 2.5e4, count // 2)])
    return np.concatenate([wide, near])


# ---- in the plane ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("saturation", MODES)
def test_the_published_matrix_is_the_published_law(saturation):
    switched = set()
    for path_angle, altitude in points(1000, 1):
        block = planar(float(path_angle), float(altitude), exp_saturation=MODES[saturation])
        law = encoded_law(float(path_angle), float(altitude), saturation)
        assert block.nodes[14:] == pytest.approx(law, rel=1e-9, abs=1e-9)
        angle, thrust = commanded(*law)
        assert block.thrust_angle == pytest.approx(angle, abs=1e-9)
        assert block.thrust == pytest.approx(thrust, abs=1e-6)
        assert block.status == 0
        switched.add(thrust)
    assert len(switched) > 50


def test_the_slip_acts_as_a_throttle_switch():
    """High up exp B saturates: at ln 1e8 = 18.42 kgf by the slip, at the limit of 80 kgf without; low down at 80."""
    for saturation, mode in MODES.items():
        u1, u2 = encoded_law(-1.66, 1.8e4, saturation)
        assert u2 == pytest.approx(math.cbrt(u1) - Q3 * 1.66 * math.cos(1.66) + saturation, rel=1e-12)
        thrust = P0 + KGF * min(u2, 80.0)
        assert planar(-1.66, 1.8e4, exp_saturation=mode).thrust == pytest.approx(thrust, abs=1e-3)
        assert planar(-1.6, 2e3, exp_saturation=mode).thrust == pytest.approx(P0 + DP, abs=1e-3)
    assert planar(-1.66, 1.8e4, exp_saturation=MODES[LEGACY]).thrust < P0 + 25.0 * KGF


def test_the_basic_matrix_is_the_basic_solution():
    for path_angle, altitude in points(1000, 2):
        block = planar(float(path_angle), float(altitude), matrix=row_order(BASIC), q=[1.0, 1.0, 1.0])
        d = (HF - altitude) / H0
        expected = [np.pi + path_angle + d * (d >= 0), -path_angle * np.cos(path_angle)]
        assert block.nodes[14:] == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_parameters_of_the_law_are_used():
    block = planar(-1.0, 500.0, matrix=row_order(BASIC), q=[2.0, 3.0, 5.0], reference_altitude=1e3, final_altitude=7e2)
    assert block.nodes[14] == pytest.approx(2.0 * (math.pi - 1.0) + 3.0 * 0.2, rel=1e-12)
    assert block.nodes[15] == pytest.approx(5.0 * math.cos(1.0), rel=1e-12)
    assert block.thrust == pytest.approx(P0 + KGF * 5.0 * math.cos(1.0), rel=1e-6)


@given(angle=st.floats(-10.0, 10.0), altitude=st.floats(-1e5, 1e6))
@settings(max_examples=either(100, 25), deadline=None)
def test_commands_stay_within_their_limits(angle, altitude):
    block = planar(angle, altitude)
    assert 0.0 <= block.thrust_angle <= math.pi
    assert P0 - DP - 1e-2 <= block.thrust <= P0 + DP + 1e-2


def test_thrust_is_never_negative():
    assert planar(-1.6, 1.8e4, nominal_thrust=100.0, matrix=row_order({(5, 16): 14})).thrust >= 0.0
    assert planar(-6.0, 1.8e4, nominal_thrust=100.0, matrix=row_order({(5, 16): 14})).thrust == 0.0


@pytest.mark.parametrize("entry", [(1, 2, 22), (3, 1, 1), (7, 7, 9)])
def test_a_matrix_that_is_no_network_operator_gives_no_thrust(entry):
    row, column, operation = entry
    flat = planar(-1.6, 1.8e4, matrix=row_order({**BASIC, (row, column): operation}))
    flat.step(0.0, 0.1)
    assert (flat.status, flat.thrust) == (1, 0.0)
    space = guidance([0.0, 0.0, 1.8e4], [1000.0, 0.0, 0.0], matrix=row_order({**BASIC, (row, column): operation}))
    space.step(0.0, 0.1)
    assert (space.status, space.thrust_acceleration, space.finished) == (3, 0.0, False)


# ---- in space ----------------------------------------------------------------------------------------------


def guidance(position, velocity, mass=940.0, **parameters):
    block = NetworkOperatorGuidance(
        position=np.asarray(position, float).tolist(),
        velocity=np.asarray(velocity, float).tolist(),
        mass=mass,
        **({"moon_radius": RADIUS} | parameters),
    )
    block.initialize()
    return block


def see(block, position, velocity, mass):
    block.position, block.velocity, block.mass = position.tolist(), velocity.tolist(), mass


def random_basis(generator):
    """Return local vertical and a horizontal direction anywhere on the Moon."""
    basis, _ = np.linalg.qr(generator.normal(size=(3, 3)))
    return basis[:, 0], basis[:, 1]


def landing_site(radius_vector):
    """Return position from the site, which is straight above the Moon's centre."""
    return radius_vector - [0.0, 0.0, RADIUS]


def test_the_command_in_space_is_the_planar_one():
    generator = np.random.default_rng(3)
    for _ in range(500):
        up, forward = random_basis(generator)
        path_angle, altitude = -generator.uniform(0.02, 3.12), generator.uniform(500.0, 3e4)
        speed, mass = generator.uniform(50.0, 1700.0), generator.uniform(300.0, 1000.0)
        velocity = speed * (math.cos(path_angle) * up - math.sin(path_angle) * forward)
        actual = guidance(landing_site((RADIUS + altitude) * up), velocity, mass)
        flat = planar(path_angle, altitude)
        force = flat.thrust * (math.cos(flat.thrust_angle) * up - math.sin(flat.thrust_angle) * forward)
        # the law's gain on the altitude is up to 1e3/m near the final altitude, rounding 1e-9 m
        assert mass * actual.thrust_acceleration == pytest.approx(flat.thrust, rel=1e-9)
        assert mass * actual.thrust_acceleration * np.array(actual.thrust_direction) == pytest.approx(force, abs=1e-4)
        assert np.linalg.norm(actual.thrust_direction) == pytest.approx(1.0, abs=1e-14)
        assert (actual.status, actual.thrust_direction_rate, actual.burn_duration) == (0, [0.0] * 3, 1e9)


def test_only_the_targets_altitude_is_used():
    position, velocity = [-2e5, 3e4, 6e3], [1200.0, -100.0, -80.0]
    plain = guidance(position, velocity)
    other = guidance(
        position,
        velocity,
        target_position=(np.array([0.6, 0.0, 0.8]) * (RADIUS + HF) - [0.0, 0.0, RADIUS]).tolist(),
        target_velocity=[3.0, -2.0, 1.0],
        gravity=9.0,
        gravity_correction=True,
        gravitational_parameter=1e12,
        terminal_step=1,
    )
    for k in range(3):
        assert other.thrust_direction == pytest.approx(plain.thrust_direction, abs=1e-9)
        assert other.thrust_acceleration == pytest.approx(plain.thrust_acceleration, rel=1e-9)
        assert (other.time_to_go, other.burn_duration) == (plain.time_to_go, plain.burn_duration)
        plain.step(0.1 * k, 0.1)
        other.step(0.1 * k, 0.1)


def test_horizontal_direction_is_held_at_low_horizontal_speed():
    block = guidance([0.0, 0.0, 2000.0], [0.3, 0.4, -20.0])
    assert block.forward == pytest.approx([0.6, 0.8, 0.0], abs=1e-12)
    see(block, np.array([0.0, 0.0, 2000.0]), np.array([0.1, -0.48, -20.0]), 940.0)
    block.step(0.0, 0.1)
    assert block.forward == pytest.approx([0.6, 0.8, 0.0], abs=1e-12)
    see(block, np.array([0.0, 0.0, 2000.0]), np.array([0.0, -0.51, -20.0]), 940.0)
    block.step(0.1, 0.1)
    assert block.forward == pytest.approx([0.0, -1.0, 0.0], abs=1e-12)


@pytest.mark.parametrize(
    ("altitude", "speed", "finished"),
    [
        (1500.0, 5.89, True),
        (1500.0, 6.01, False),
        (1199.0, 5.0, False),
        (1201.0, 5.0, True),
        (1799.0, 5.0, True),
        (1801.0, 5.0, False),
    ],
)
def test_hand_over_is_slow_and_inside_the_band_and_kept(altitude, speed, finished):
    block = guidance([0.0, 0.0, 1e4], [500.0, 0.0, 0.0])
    see(block, np.array([0.0, 0.0, altitude]), np.array([speed, 0.0, 0.0]), 500.0)
    block.step(7.0, 0.1)
    assert (block.finished, block.command_time) == (finished, 7.1)
    assert (block.thrust_acceleration == 0.0) == finished
    see(block, np.array([0.0, 0.0, 1e4]), np.array([500.0, 0.0, 0.0]), 500.0)
    block.step(7.1, 0.1)
    assert block.finished == finished
    assert block.command_time == pytest.approx(7.1 if finished else 7.2)


def test_declared_starts_and_degenerate_states_are_harmless():
    block = NetworkOperatorGuidance()
    block.initialize()
    block.step(0.0, 0.1)
    assert not block.finished
    for position, velocity, mass in [([0, 0, -RADIUS], [1, 0, 0], 900.0), ([0, 0, 1e4], [1, 0, 0], 0.0)]:
        assert guidance(position, velocity, mass).status == 3
    straight_down = guidance([0.0, 0.0, 1e4], [0.0, 0.0, -100.0])
    assert straight_down.status == 0
    assert np.linalg.norm(straight_down.thrust_direction) == pytest.approx(1.0, abs=1e-14)


# ---- a descent in space ------------------------------------------------------------------------------------


def descent_in_space(up, forward, step):
    """Yield rows of time, altitude, speed and time_to_go under the guidance block, with numpy's Runge-Kutta between."""
    mu = GRAVITY * RADIUS**2
    r = (RADIUS + 18148.0) * up
    v = 1689.0 * (math.cos(-1.6) * up - math.sin(-1.6) * forward)
    m, rows = 940.0, []
    block = guidance(landing_site(r), v, m)

    def slope(y, force):
        return np.concatenate(
            [y[3:6], force / y[6] - mu * y[:3] / np.linalg.norm(y[:3]) ** 3, [-np.linalg.norm(force) / (KGF * 319.0)]]
        )

    for k in range(round(400.0 / step)):
        rows.append([k * step, np.linalg.norm(r) - RADIUS, np.linalg.norm(v), block.time_to_go])
        if block.finished:
            return np.array(rows)
        force = m * block.thrust_acceleration * np.array(block.thrust_direction)
        y = np.concatenate([r, v, [m]])
        k1 = slope(y, force)
        k2 = slope(y + step / 2 * k1, force)
        k3 = slope(y + step / 2 * k2, force)
        k4 = slope(y + step * k3, force)
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        r, v, m = y[:3], y[3:6], y[6]
        see(block, landing_site(r), v, m)
        block.step(k * step, step)
    raise AssertionError("no hand-over")


def planar_descent(step):
    """Return time, altitude and speed at the hand-over of the planar blocks, with the vertical turning."""
    plant = PlanarMoonLander(curvature=True, surface_gravity=GRAVITY, moon_radius=RADIUS)
    plant.initialize()
    law = planar(plant.path_angle, plant.altitude)
    for k in range(round(400.0 / step)):
        if plant.speed < 6.0 and 1200.0 <= plant.altitude <= 1800.0:
            return k * step, plant.altitude, plant.speed
        plant.thrust_angle, plant.thrust = law.thrust_angle, law.thrust
        plant.step(k * step, step)
        law.measured_path_angle, law.measured_altitude = plant.path_angle, plant.altitude
        law.step(k * step, step)
    raise AssertionError("no hand-over")


def test_descent_in_space_is_the_planar_one_with_the_vertical_turning():
    """The force turns with the vertical within a step in the plane and not in space: 1e-3 rad/s times 0.05 s."""
    step = 0.05
    rows = descent_in_space(*random_basis(np.random.default_rng(4)), step)
    time, altitude, speed = planar_descent(step)
    assert rows[-1, 0] == pytest.approx(time, abs=0.1)
    assert rows[-1, 1] == pytest.approx(altitude, abs=0.1)
    assert rows[-1, 2] == pytest.approx(speed, abs=1.0)
    left = rows[-1, 0] - rows[:-20, 0]
    assert np.abs(rows[:-20, 3] / left - 1.0).max() < 0.1  # the bound that the block states
