"""Entry capsule: motion, attitude, atmosphere, pulses.

Truth: a Kepler orbit, conservation of momentum and energy, an independent integration in inertial Cartesian axes with a
quaternion by scipy's DOP853 (tests/support/flights/entry_motion.py), derivatives from another program. Tolerances are
stated at each test.
"""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.entry.motion import body_axes, in_body
from perilune.fmus_src.mathlib.entry.standard_atmosphere import Air, air
from perilune.fmus_src.mathlib.vectors import vector
from perilune.fmus_src.plants.entry_capsule import AXIAL, MACH_NUMBERS, NORMAL, Atmosphere, EntryCapsule
from tests.support.flights.entry_motion import DEGREE, EARTH_RATE, INERTIA, MU, RADIUS, Coefficients, Entry

COEFFICIENTS = Coefficients(MACH_NUMBERS, np.reshape(AXIAL, (10, 13)), np.reshape(NORMAL, (10, 13)))
HIGH = {"initial_height": 81000.0, "initial_speed": 7600.0}
TUMBLING = {"initial_sideslip": 0.06, "initial_attack": -0.3, "initial_angular_velocity": [0.02, -0.03, 0.04]}


def capsule(**parameters):
    block = EntryCapsule(**parameters)
    block.initialize()
    return block


def fly(block, seconds, step=0.2):
    for n in range(round(seconds / step)):
        block.step(n * step, step)
    return block


def state_of(block):
    return np.array(block.state.elements())


def begin(entry, block, w=(0.0, 0.0, 0.0)):
    """Return the block's state in inertial axes."""
    numbers = block.state.elements()
    return entry.start(numbers[0:3], numbers[3:6], numbers[6:9], list(w))


def independent(block, seconds, **options):
    """Simulate the same flight in inertial axes."""
    entry = Entry(COEFFICIENTS, **options)
    begun = begin(entry, block, block.angular_velocity)
    return np.concatenate(entry.read(entry.fly(begun, seconds), seconds))


def inertial(block, time):
    """Return position and velocity in inertial axes."""
    entry = Entry(COEFFICIENTS)
    state = begin(entry, block)
    turn = Rotation.from_rotvec([0.0, 0.0, EARTH_RATE * time])
    return turn.apply(state[:3]), turn.apply(state[3:6])


def test_derivatives():
    """Compare with another program's at 70 km, to its digits."""
    block = capsule(initial_height=70000.0, initial_speed=7500.0, initial_bank=0.9, **TUMBLING)
    rate = block.derivatives(0.0, block.state, vector(10.0, -20.0, 5.0))
    assert rate.speed == pytest.approx(-4.132585, abs=6e-7)
    assert [rate.flight_path_angle, rate.heading] == pytest.approx([3.674721e-5, -1.1370604e-3], abs=6e-11)
    assert [*rate.attitude] == pytest.approx([0.010187065, -0.033536617, 0.039960007], abs=6e-9)
    assert [*rate.angular_velocity] == pytest.approx([0.008517471, -0.136227984, -0.103223840], abs=6e-9)


def kepler(position, velocity, time):
    """Return position after a time on the orbit, by universal variables (Battin 1999, section 4.5), Newton's method."""
    r0, square = np.linalg.norm(position), velocity @ velocity
    radial = position @ velocity / math.sqrt(MU)
    alpha = 2.0 / r0 - square / MU
    x = math.sqrt(MU) * alpha * time
    for _ in range(50):
        z = alpha * x * x
        c = (1.0 - math.cos(math.sqrt(z))) / z
        s = (math.sqrt(z) - math.sin(math.sqrt(z))) / math.sqrt(z) ** 3
        off = radial * x * x * c + (1.0 - alpha * r0) * x**3 * s + r0 * x - math.sqrt(MU) * time
        slope = radial * x * (1.0 - z * s) + (1.0 - alpha * r0) * x * x * c + r0
        x -= off / slope
    f = 1.0 - x * x / r0 * c
    g = time - x**3 / math.sqrt(MU) * s
    return f * position + g * velocity


def test_without_air_it_flies_kepler_s_arc():
    """1e-7 m over 60 s; 100 km high the arc is 460 km long."""
    block = capsule()
    block.density_factor = 0.0
    begun = inertial(block, 0.0)
    fly(block, 60.0)
    assert inertial(block, 60.0)[0] == pytest.approx(kepler(*begun, 60.0), abs=1e-7)


def test_without_moments_angular_momentum_stays():
    """In inertial axes, 1e-13 of itself over 60 s at a few deg/s."""
    block = capsule(**TUMBLING)
    block.density_factor = 0.0

    def momentum(time):
        state = begin(Entry(COEFFICIENTS), block)
        body = Rotation.from_rotvec([0.0, 0.0, EARTH_RATE * time]) * Rotation.from_quat(state[6:10])
        return body.apply(INERTIA @ [*block.angular_velocity])

    begun = momentum(0.0)
    fly(block, 60.0)
    assert np.linalg.norm(momentum(60.0) - begun) < 1e-13 * np.linalg.norm(begun) * 50.0


def test_energy_is_lost_to_the_air_alone():
    """Over the turning Earth V^2/2 - mu/r - (We r cos lat)^2/2 falls by the work of the air: 1e-11 of it over 20 s."""
    block = capsule(initial_height=80000.0, initial_path_angle=-3.0 * DEGREE, internal_step=0.0125)

    def energy():
        around = EARTH_RATE * block.state.radius * math.cos(block.state.latitude)
        return 0.5 * block.speed**2 - MU / block.state.radius - 0.5 * around**2

    def power():
        v = in_body(body_axes(block.state.attitude), vector(block.speed, 0.0, 0.0))
        gas = air(block.height)
        force = block.air_force(v, gas)
        return (force.x * v.x + force.y * v.y + force.z * v.z) / block.mass

    begun, rows, step = energy(), [power()], 0.0125
    for n in range(1600):
        block.step(n * step, step)
        rows.append(power())
    # Boole's rule
    weights = np.zeros(1601)
    for k in range(0, 1600, 4):
        weights[k : k + 5] += np.array([7.0, 32.0, 12.0, 32.0, 7.0]) * 2.0 * step / 45.0
    work = float(weights @ rows)
    assert energy() - begun == pytest.approx(work, abs=1e-11 * abs(begun))
    assert work < -1e5


@pytest.mark.parametrize("torque", [(0.0, 0.0, 0.0), (10.0, -20.0, 5.0)])
def test_it_flies_as_in_inertial_axes(torque):
    """10 s above 80 km: 1e-9 rad, 1e-6 m, 1e-9 m/s of 7600."""
    block = capsule(**HIGH, **TUMBLING)
    block.mean_torque = torque
    expected = independent(block, 10.0, torque=torque)
    actual = state_of(fly(block, 10.0))
    assert actual[[1, 2, 4, 5]] == pytest.approx(expected[[1, 2, 4, 5]], abs=1e-11)
    assert actual[0] == pytest.approx(expected[0], abs=1e-6)
    assert actual[3] == pytest.approx(expected[3], abs=1e-7)
    assert actual[6:] == pytest.approx(expected[6:], abs=1e-9)


def test_it_converges_with_the_fourth_power_of_its_step():
    """At 50 km, where attitude swings quickly: half the step, a sixteenth of the error, within a fifth of that."""
    start = {"initial_height": 50000.0, "initial_speed": 5300.0, **TUMBLING}
    expected = independent(capsule(**start), 2.0)
    errors = [
        np.abs(state_of(fly(capsule(internal_step=step, **start), 2.0)) - expected)[6:].max() for step in (0.1, 0.05)
    ]
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.25)


def test_pulses_are_cut_where_they_end():
    """Whatever the communication step: 1e-10 over 2 s of pulses; and each jet has a separate level and factor."""
    actual = []
    for parts in (1, 4):
        block = capsule(jet_torque=[100.0, 90.0, 80.0, 70.0, 60.0, 50.0])
        block.jet_factor = [1.0, 0.5, 1.0, 0.0, 1.0, 1.0]
        for k in range(10):
            block.pulse_lengths, block.pulse_count = [0.13, -0.07, 0.03 * (-1) ** k], k + 1
            for part in range(parts):
                block.step(0.2 * (k + part / parts), 0.2 / parts)
        actual.append(state_of(block))
    assert np.abs(actual[0] - actual[1])[1:].max() < 1e-10
    assert [*block.jet_seconds] == pytest.approx([1.3, 0.7, 0.3])
    torque = [block.jet(2 * k, 2 * k + 1, length, 0.0) for k in range(3) for length in (0.1, -0.1, 0.0)]
    assert torque == [100.0, -45.0, 0.0, 80.0, 0.0, 0.0, 60.0, -50.0, 0.0]
    assert math.copysign(1.0, block.jet(0, 1, 0.1, 0.05)) == 1.0
    assert block.jet(0, 1, 0.1, 0.1) == 0.0


def test_the_standard_of_the_air_is_a_choice():
    """At 100 km, rows of both printed tables."""
    for atmosphere, density in ((Atmosphere.US_1976, 5.604e-7), (Atmosphere.GOST_4401_81, 5.54951e-7)):
        block = capsule(atmosphere=atmosphere)
        assert block.dynamic_pressure == pytest.approx(0.5 * density * block.speed**2, rel=1e-9)
        slowing = block.derivatives(0.0, block.state, vector(0.0, 0.0, 0.0)).speed
        if atmosphere == Atmosphere.US_1976:
            first = slowing
    without = capsule(density_factor=0.0)
    free = without.derivatives(0.0, without.state, vector(0.0, 0.0, 0.0)).speed
    assert (slowing - free) / (first - free) == pytest.approx(5.54951 / 5.604, rel=5e-6)


def test_wind_moves_the_air():
    """A head wind acts as speed would: the force at V with -u along x is that at V + u without."""
    faster, windy = capsule(initial_speed=7000.0), capsule(initial_speed=6900.0)
    windy.wind = [-100.0, 0.0, 0.0]
    forces = []
    for block in (faster, windy):
        axes = body_axes(block.state.attitude)
        v = in_body(axes, vector(block.speed, 0.0, 0.0) - block.wind)
        forces.append([*block.air_force(v, air(block.height))])
    assert forces[1] == pytest.approx(forces[0], rel=1e-12)


def test_it_says_when_it_leaves_its_tables_and_when_it_is_low():
    assert capsule().status == 0
    assert capsule(initial_attack=-1.2).status == 1
    assert capsule(initial_speed=100.0).status == 1
    assert capsule(inertia=[0.0] * 9).status == 2
    assert not capsule().finished
    assert capsule(initial_height=24000.0).finished


def test_the_pressure_trims_at_twenty_degrees_with_lift():
    """Moment about z 0 at -20 deg; lift over drag 0.309."""
    block = capsule(initial_bank=0.0)
    axes = body_axes(block.state.attitude)
    v = in_body(axes, vector(7000.0, 0.0, 0.0))
    force = np.array([*block.air_force(v, Air(density=1e-5, speed_of_sound=290.0))])
    moment = np.cross([*block.pressure_arm], force)
    assert abs(moment[2]) < 1e-4 * np.linalg.norm(force)
    in_velocity = force @ np.array([[*axis] for axis in (axes.x, axes.y, axes.z)])
    assert in_velocity[1] / -in_velocity[0] == pytest.approx(0.309, abs=5e-4)
    assert block.earth_radius == RADIUS
