"""The five terminal guidances against the published formulas, their own truth and the flights they make.

Truth: the printed test state, to half a unit of the last digit; the linear thrust acceleration
a(t) = a0 + a1 t that meets all six boundary conditions, solved here by numpy as a linear system, of which
every command is the value (and, per method, the rate) at the start; times-to-go by `numpy.roots`; and whole
flights by `tests/independent_lander.py`. Tolerance 1e-9 relative for commands, 1e-8 m and 1e-9 m/s for flights.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from fmus_src.guidance.analytic import AnalyticGuidance
from fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from fmus_src.guidance.astar import AstarGuidance
from fmus_src.guidance.astar_modified import AstarModifiedGuidance
from fmus_src.guidance.astar_robust import AstarRobustGuidance
from fmus_src.plants.flat_moon_lander import FlatMoonLander
from tests.independent_lander import fly

ALL = [AnalyticGuidance, AnalyticExactGuidance, AstarGuidance, AstarRobustGuidance, AstarModifiedGuidance]
EXACT = [AnalyticExactGuidance, AstarRobustGuidance]
STOPPING = [AnalyticGuidance, AstarGuidance, AstarModifiedGuidance]
GOOD, CLAMPED, NOT_CONVERGED, NO_SOLUTION = range(4)
GRAVITY = 1.62
EXHAUST_SPEED = 3100.0
TARGET = np.array([0.0, 0.0, 2000.0])
UP = np.array([0.0, 0.0, 1.0])
POSITION = np.array([1e5, 0.0, 10500.0])
VELOCITY = 950.0 * np.array([-math.cos(0.05), 0.0, -math.sin(0.05)])


def declared_state(fractions):
    """A state of the published box from six numbers in [0, 1]."""
    u = list(fractions)
    ground = 0.95e5 + 1e4 * u[0]
    azimuth = -math.pi / 4 + math.pi / 2 * u[1]
    height = 0.95e4 + 2e3 * u[2]
    speed = 940.0 + 20.0 * u[3]
    climb = -math.atan2(height, ground) * u[4]
    course = azimuth + math.pi + math.pi / 18 * (2.0 * u[5] - 1.0)
    position = np.array([ground * math.cos(azimuth), ground * math.sin(azimuth), height])
    velocity = speed * np.array(
        [math.cos(climb) * math.cos(course), math.cos(climb) * math.sin(course), math.sin(climb)]
    )
    return position, velocity


millionths = st.integers(0, 10**6).map(lambda number: number / 10**6)
box = st.lists(millionths, min_size=6, max_size=6).map(declared_state)


def states_of_the_box(count, seed):
    generator = np.random.default_rng(seed)
    return [declared_state(generator.uniform(size=6)) for _ in range(count)]


def commanded(guidance_class, position=POSITION, velocity=VELOCITY, **parameters):
    guidance = guidance_class(position=np.asarray(position).tolist(), velocity=np.asarray(velocity).tolist())
    for name, value in parameters.items():
        if isinstance(value, list):
            getattr(guidance, name)[:] = value
        else:
            setattr(guidance, name, value)
    guidance.initialize()
    return guidance


def see(guidance, position, velocity):
    guidance.position[:] = np.asarray(position).tolist()
    guidance.velocity[:] = np.asarray(velocity).tolist()


def command_of(guidance):
    return [
        guidance.thrust_acceleration,
        *guidance.thrust_direction,
        *guidance.thrust_direction_rate,
    ]


def linear_thrust(position, velocity, time):
    """a0 and a1 of the thrust acceleration that arrives at rest at the target after ``time``."""
    conditions = np.array([[time, time**2 / 2.0], [time**2 / 2.0, time**3 / 6.0]])
    gain = -velocity + GRAVITY * time * UP
    way = TARGET - position - velocity * time + GRAVITY * time**2 / 2.0 * UP
    return np.linalg.solve(conditions, np.array([gain, way]))


def impulse_and_miss(position, velocity, time):
    a = -velocity + GRAVITY * time * UP
    return a, TARGET - position - velocity * time + 0.5 * GRAVITY * time**2 * UP


def polynomials(position, velocity):
    """A T, B as polynomials of T, component by component."""
    impulses = [Polynomial([0.0, -velocity[i], GRAVITY * UP[i]]) for i in range(3)]
    misses = [Polynomial([TARGET[i] - position[i], -velocity[i], 0.5 * GRAVITY * UP[i]]) for i in range(3)]
    return impulses, misses


def positive_roots(polynomial, degree):
    found = np.roots(polynomial.coef[: degree + 1][::-1])
    real = found[abs(found.imag) < 1e-9 * abs(found)].real
    real = real - polynomial(real) / polynomial.deriv()(real)
    return sorted(real[real > 0.0])


def astar_roots(position, velocity):
    """Positive roots of (A T - 3 B).(A T - 2 B) = 0, whose fourth power cancels."""
    impulses, misses = polynomials(position, velocity)
    pairs = zip(impulses, misses, strict=True)
    return positive_roots(sum(((a - 3.0 * b) * (a - 2.0 * b) for a, b in pairs), Polynomial([0.0])), 3)


def balance_roots(position, velocity, degree):
    """Positive roots of |A|^2 T^2 = 4 |B|^2: degree 3, or 2 for the published quadratic."""
    impulses, misses = polynomials(position, velocity)
    whole = sum((a * a for a in impulses), Polynomial([0.0])) - 4.0 * sum((b * b for b in misses), Polynomial([0.0]))
    return positive_roots(Polynomial(whole.coef[: degree + 1]), degree)


def modified_time(position, velocity):
    """Published closed formula, in the method's axes (y up)."""
    distance = np.linalg.norm(TARGET - position)
    speed = np.linalg.norm(velocity)
    lift = -velocity[2] + 2.0 * GRAVITY * distance / speed
    e = math.sqrt(velocity[0] ** 2 + lift**2 + velocity[1] ** 2)
    return distance / (speed + (position[2] - TARGET[2]) * GRAVITY / speed - e / 2.0 + e**2 / (12.0 * EXHAUST_SPEED))


def assert_points_along(guidance, direction, rate, tolerance=1e-9):
    assert guidance.thrust_direction == pytest.approx(direction, abs=tolerance)
    assert guidance.thrust_direction_rate == pytest.approx(rate, abs=1e-2 * tolerance)


# ---- the printed test state --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("guidance_class", "time"),
    [
        (AnalyticGuidance, 217.578132),
        (AnalyticExactGuidance, 213.645917),
        (AstarRobustGuidance, 213.645917),
        (AstarGuidance, 212.982772),
        (AstarModifiedGuidance, 209.126308),
    ],
)
def test_time_to_go_of_the_test_state(guidance_class, time):
    guidance = commanded(guidance_class)
    assert guidance.status == GOOD
    assert guidance.time_to_go == pytest.approx(time, abs=5e-7)


@pytest.mark.parametrize(
    ("guidance_class", "acceleration", "pitch", "pitch_rate"),
    [
        (AnalyticGuidance, 4.7323943, 0.2885476, 8.14639e-4),
        (AnalyticExactGuidance, 4.8079921, 0.2926228, 9.36934e-4),
    ],
)
def test_pitch_programme_of_the_test_state(guidance_class, acceleration, pitch, pitch_rate):
    guidance = commanded(guidance_class)
    assert guidance.thrust_acceleration == pytest.approx(acceleration, abs=5e-8)
    assert math.asin(guidance.thrust_direction[2]) == pytest.approx(pitch, abs=5e-8)
    assert guidance.thrust_direction_rate[2] / math.cos(pitch) == pytest.approx(pitch_rate, abs=6e-10)
    assert guidance.thrust_direction[1] == 0.0
    assert guidance.thrust_direction_rate[1] == 0.0


@pytest.mark.parametrize("guidance_class", [AstarGuidance, AstarModifiedGuidance, AstarRobustGuidance])
def test_astar_pitch_programme_of_the_test_state(guidance_class):
    """In the plane of motion psi = 0: th0 = asin(w/W), thd = w'/(W cos th0), w the vertical acceleration."""
    guidance = commanded(guidance_class)
    a, b = impulse_and_miss(POSITION, VELOCITY, guidance.time_to_go)
    t = guidance.time_to_go
    w = guidance.thrust_acceleration
    pitch = math.asin((-2.0 * a[2] / t + 6.0 * b[2] / t**2) / w)
    pitch_rate = (6.0 * a[2] / t**2 - 12.0 * b[2] / t**3) / (w * math.cos(pitch))
    assert_points_along(
        guidance,
        [math.cos(pitch), 0.0, math.sin(pitch)],
        [-math.sin(pitch) * pitch_rate, 0.0, math.cos(pitch) * pitch_rate],
    )


# ---- commands over the whole box -----------------------------------------------------------------------------


@given(box)
@settings(max_examples=60, deadline=None)
def test_analytic_command_is_the_linear_thrust_without_the_growth_of_its_horizontal_part(state):
    """Time from the quadratic; exact direction and yaw rate; the pitch rate holds cos(pitch) at its start."""
    position, velocity = state
    guidance = commanded(AnalyticGuidance, position, velocity)
    time = guidance.time_to_go
    assert guidance.status == GOOD
    assert min(abs(time - root) for root in balance_roots(position, velocity, 2)) < 1e-9 * time
    a, _ = impulse_and_miss(position, velocity, time)
    assert guidance.thrust_acceleration == pytest.approx(np.linalg.norm(a) / time, rel=1e-9)
    a0, a1 = linear_thrust(position, velocity, time)
    flat = math.hypot(a0[0], a0[1])
    direction = a0 / np.linalg.norm(a0)
    upward = (UP - direction[2] * direction) / math.hypot(direction[0], direction[1])
    turning = (a0[0] * a1[1] - a0[1] * a1[0]) / flat**2 * np.cross(UP, direction)
    assert_points_along(guidance, direction, a1[2] / flat * upward + turning)


@given(box)
@settings(max_examples=60, deadline=None)
def test_exact_analytic_command_is_the_linear_thrust_and_its_rate(state):
    position, velocity = state
    guidance = commanded(AnalyticExactGuidance, position, velocity)
    time = guidance.time_to_go
    assert guidance.status == GOOD
    assert min(abs(time - root) for root in balance_roots(position, velocity, 3)) < 1e-9 * time
    a, b = impulse_and_miss(position, velocity, time)
    assert guidance.thrust_acceleration == pytest.approx(2.0 * np.linalg.norm(b) / time**2, rel=1e-9)
    assert guidance.thrust_acceleration == pytest.approx(np.linalg.norm(a) / time, rel=1e-9)
    a0, a1 = linear_thrust(position, velocity, time)
    size = np.linalg.norm(a0)
    direction = a0 / size
    assert_points_along(guidance, direction, (a1 - (a1 @ direction) * direction) / size)


@pytest.mark.parametrize("guidance_class", [AstarGuidance, AstarModifiedGuidance, AstarRobustGuidance])
@given(state=box)
@settings(max_examples=60, deadline=None)
def test_astar_command_keeps_the_lateral_and_vertical_linear_thrust(guidance_class, state):
    """W d_y = a_y and W d_z = a_z with their rates; d_x completes the unit vector (braking: positive)."""
    position, velocity = state
    guidance = commanded(guidance_class, position, velocity)
    time = guidance.time_to_go
    if guidance_class is AstarGuidance:
        roots = astar_roots(position, velocity)
        assert guidance.status == (GOOD if roots else NOT_CONVERGED)
        if not roots:
            assert (guidance.thrust_acceleration, time) == (0.0, 0.0)
            return
        assert min(abs(time - root) for root in roots) < 1e-9 * time
    elif guidance_class is AstarRobustGuidance:
        assert min(abs(time - root) for root in balance_roots(position, velocity, 3)) < 1e-9 * time
    else:
        assert time == pytest.approx(modified_time(position, velocity), rel=1e-12)
    a0, a1 = linear_thrust(position, velocity, time)
    _, b = impulse_and_miss(position, velocity, time)
    w = np.linalg.norm(a0) if guidance_class is AstarRobustGuidance else 2.0 * np.linalg.norm(b) / time**2
    assert guidance.thrust_acceleration == pytest.approx(w, rel=1e-9)
    y, z = a0[1] / w, a0[2] / w
    inside = y * y + z * z
    if inside > 1.0:
        assert guidance.status == CLAMPED
        assert guidance.clamp_count > 0
        assert np.linalg.norm(guidance.thrust_direction) == pytest.approx(1.0, abs=1e-12)
    elif inside < 0.999:
        assert guidance.status == GOOD
        assert guidance.clamp_count == 0
        x = math.sqrt(1.0 - inside)
        y_rate, z_rate = a1[1] / w, a1[2] / w
        assert_points_along(guidance, [x, y, z], [-(y * y_rate + z * z_rate) / x, y_rate, z_rate])


def test_robust_astar_flies_the_exact_direction_without_clamping():
    for position, velocity in states_of_the_box(200, 5):
        robust = commanded(AstarRobustGuidance, position, velocity)
        exact = commanded(AnalyticExactGuidance, position, velocity)
        assert robust.status == GOOD
        assert robust.thrust_direction == pytest.approx(exact.thrust_direction, abs=1e-9)


def test_share_of_the_box_without_a_root_is_about_fifteen_percent():
    states = states_of_the_box(600, 6)
    rootless = sum(not astar_roots(*state) for state in states)
    assert sum(commanded(AstarGuidance, *state).status == NOT_CONVERGED for state in states) == rootless
    assert 0.10 < rootless / len(states) < 0.21


def test_astar_converges_quadratically_to_its_root():
    """A last change below 1e-6 s leaves an error near rounding, roots that almost coincide left out."""
    compared = 0
    for state in states_of_the_box(100, 11):
        roots = astar_roots(*state)
        if roots and all(abs(first / second - 1.0) > 0.05 for first, second in itertools.pairwise(roots)):
            time = commanded(AstarGuidance, *state).time_to_go
            assert min(abs(time - root) for root in roots) < 1e-12 * time
            compared += 1
    assert compared > 50


def test_clamped_states_of_the_modified_method_exist_and_are_counted():
    found = [commanded(AstarModifiedGuidance, *state) for state in states_of_the_box(600, 7)]
    clamped = [guidance for guidance in found if guidance.status == CLAMPED]
    assert clamped
    assert all(guidance.clamp_count in (1, 2) for guidance in clamped)
    assert all(guidance.clamp_count == 0 for guidance in found if guidance.status == GOOD)


@pytest.mark.parametrize("guidance_class", ALL)
@given(state=box)
@settings(max_examples=40, deadline=None)
def test_direction_is_a_unit_vector_and_its_rate_perpendicular(guidance_class, state):
    guidance = commanded(guidance_class, *state)
    assert np.linalg.norm(guidance.thrust_direction) == pytest.approx(1.0, abs=1e-12)
    assert np.dot(guidance.thrust_direction, guidance.thrust_direction_rate) == pytest.approx(0.0, abs=1e-13)


# ---- symmetries --------------------------------------------------------------------------------------------


def turned(vector, azimuth):
    c, s = math.cos(azimuth), math.sin(azimuth)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2]])


@pytest.mark.parametrize("guidance_class", [AnalyticGuidance, AnalyticExactGuidance])
@given(state=box, azimuth=st.integers(-3141, 3141).map(lambda number: number / 1000.0))
@settings(max_examples=60, deadline=None)
def test_analytic_commands_turn_with_the_frame_about_the_vertical(guidance_class, state, azimuth):
    position, velocity = state
    plain = commanded(guidance_class, position, velocity)
    other = commanded(guidance_class, turned(position, azimuth), turned(velocity, azimuth))
    assert other.time_to_go == pytest.approx(plain.time_to_go, rel=1e-12)
    assert other.thrust_acceleration == pytest.approx(plain.thrust_acceleration, rel=1e-12)
    assert_points_along(
        other, turned(plain.thrust_direction, azimuth), turned(plain.thrust_direction_rate, azimuth), 1e-11
    )


@pytest.mark.parametrize("guidance_class", [AnalyticGuidance, AnalyticExactGuidance])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_analytic_command_along_the_y_axis_exactly(guidance_class, side):
    """No x component at all, where the published cos(yaw)/x is 0/0."""
    plain = commanded(guidance_class)
    other = commanded(guidance_class, [0.0, side * POSITION[0], POSITION[2]], [0.0, side * VELOCITY[0], VELOCITY[2]])
    assert other.thrust_direction == pytest.approx(
        [0.0, side * plain.thrust_direction[0], plain.thrust_direction[2]], abs=1e-12
    )
    assert other.thrust_direction_rate == pytest.approx(
        [0.0, side * plain.thrust_direction_rate[0], plain.thrust_direction_rate[2]], abs=1e-15
    )


@pytest.mark.parametrize("guidance_class", ALL)
@given(state=box)
@settings(max_examples=40, deadline=None)
def test_commands_mirror_with_the_frame(guidance_class, state):
    position, velocity = state
    mirror = np.array([1.0, -1.0, 1.0])
    plain = commanded(guidance_class, position, velocity)
    other = commanded(guidance_class, mirror * position, mirror * velocity)
    assert other.status == plain.status
    assert other.time_to_go == plain.time_to_go
    assert_points_along(other, mirror * plain.thrust_direction, mirror * plain.thrust_direction_rate, 1e-12)


@pytest.mark.parametrize("guidance_class", ALL)
@given(state=box, shift=st.lists(st.integers(-5000, 5000).map(float), min_size=3, max_size=3))
@settings(max_examples=40, deadline=None)
def test_commands_move_with_the_target(guidance_class, state, shift):
    position, velocity = state
    plain = commanded(guidance_class, position, velocity)
    other = commanded(guidance_class, position + shift, velocity, target_position=(TARGET + shift).tolist())
    assert other.status == plain.status
    assert other.time_to_go == pytest.approx(plain.time_to_go, rel=1e-9)
    if plain.status == GOOD and plain.thrust_direction[0] > 0.1:
        assert command_of(other) == pytest.approx(command_of(plain), rel=1e-7, abs=1e-10)


@pytest.mark.parametrize("guidance_class", ALL)
@given(
    state=box,
    length=st.integers(1, 100).map(lambda number: number / 10.0),
    duration=st.integers(1, 100).map(lambda number: number / 10.0),
)
@settings(max_examples=40, deadline=None)
def test_commands_scale_with_the_units_of_length_and_time(guidance_class, state, length, duration):
    position, velocity = state
    speed, acceleration = length / duration, length / duration**2
    plain = commanded(guidance_class, position, velocity)
    extra = {"exhaust_speed": speed * EXHAUST_SPEED} if guidance_class is AstarModifiedGuidance else {}
    other = commanded(
        guidance_class,
        length * position,
        speed * velocity,
        target_position=(length * TARGET).tolist(),
        gravity=acceleration * GRAVITY,
        **extra,
    )
    if plain.status == GOOD and plain.thrust_direction[0] > 0.1:
        assert other.status == GOOD
        assert other.time_to_go == pytest.approx(duration * plain.time_to_go, rel=1e-9)
        assert other.thrust_acceleration == pytest.approx(acceleration * plain.thrust_acceleration, rel=1e-7)
        assert other.thrust_direction == pytest.approx(plain.thrust_direction, abs=1e-7)
        assert np.multiply(duration, other.thrust_direction_rate) == pytest.approx(
            np.array(plain.thrust_direction_rate), abs=1e-9
        )


# ---- life cycle --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("guidance_class", ALL)
def test_declared_starts_alone_initialise_and_step(guidance_class):
    guidance = guidance_class()
    guidance.initialize()
    assert guidance.thrust_acceleration == 0.0
    assert guidance.time_to_go == 0.0
    assert not guidance.finished
    guidance.step(0.0, 0.1)
    assert guidance.thrust_acceleration == 0.0
    assert not guidance.finished


@pytest.mark.parametrize("guidance_class", ALL)
@given(
    position=st.lists(st.sampled_from([-2000.0, 0.0, 1e-9, 1.0, 2000.0, 1e5]), min_size=3, max_size=3),
    velocity=st.lists(st.sampled_from([-950.0, -1.0, 0.0, 1e-9, 1.0, 950.0]), min_size=3, max_size=3),
    gravity=st.sampled_from([0.0, 1.62]),
)
@settings(max_examples=150, deadline=None)
def test_initialise_and_step_are_total(guidance_class, position, velocity, gravity):
    """Any state, at the target, at rest, receding, vertical: no fault, no value that is not a number."""
    guidance = commanded(guidance_class, position, velocity, gravity=gravity)
    guidance.step(0.0, 0.5)
    assert all(math.isfinite(value) for value in [*command_of(guidance), guidance.time_to_go, guidance.burn_duration])
    assert guidance.status in (GOOD, CLAMPED, NOT_CONVERGED, NO_SOLUTION)


@pytest.mark.parametrize("guidance_class", ALL)
def test_command_time_is_the_end_of_the_step(guidance_class):
    guidance = commanded(guidance_class)
    assert guidance.command_time == 0.0
    guidance.step(0.0, 0.25)
    assert guidance.command_time == 0.25
    guidance.step(12.5, 0.25)
    assert guidance.command_time == 12.75


def rootless_state():
    return next(state for state in states_of_the_box(100, 8) if not astar_roots(*state))


def test_without_convergence_from_the_start_nothing_is_commanded():
    guidance = commanded(AstarGuidance, *rootless_state())
    assert guidance.status == NOT_CONVERGED
    assert guidance.thrust_acceleration == 0.0
    guidance.step(0.0, 0.5)
    assert guidance.status == NOT_CONVERGED
    assert not guidance.finished


def test_without_convergence_the_last_command_is_held_and_time_counts_down():
    guidance = commanded(AstarGuidance)
    guidance.step(0.0, 0.5)
    held, time = command_of(guidance), guidance.time_to_go
    see(guidance, *rootless_state())
    for k in range(1, 6):
        guidance.step(0.5 * k, 0.5)
        assert guidance.status == NOT_CONVERGED
        assert command_of(guidance) == held
        assert guidance.command_time == 0.5
        assert guidance.time_to_go == pytest.approx(time - 0.5 * k, rel=1e-12)
    see(guidance, POSITION, VELOCITY)
    guidance.step(3.0, 0.5)
    assert guidance.status == GOOD
    assert guidance.command_time == 3.5


def test_a_held_command_finishes_when_its_time_has_run_out():
    guidance = commanded(AstarGuidance)
    time = guidance.time_to_go
    see(guidance, *rootless_state())
    cycles = 0
    while not guidance.finished:
        guidance.step(10.0 * cycles, 10.0)
        cycles += 1
        assert cycles < 30
    assert cycles == math.floor(time / 10.0)
    assert guidance.thrust_acceleration == 0.0


@pytest.mark.parametrize("guidance_class", STOPPING)
def test_stop_finishes_when_less_than_a_cycle_is_left(guidance_class):
    """Cycles just longer and just shorter than the time-to-go of the state seen."""
    time = commanded(guidance_class).time_to_go
    longer, shorter = commanded(guidance_class), commanded(guidance_class)
    longer.step(0.0, 0.999 * time)
    assert not longer.finished
    assert longer.thrust_acceleration > 0.0
    shorter.step(0.0, 1.001 * time)
    assert shorter.finished
    assert shorter.thrust_acceleration == 0.0
    assert shorter.time_to_go == pytest.approx(time, rel=1e-9)
    frozen = command_of(shorter)
    see(shorter, 2.0 * POSITION, VELOCITY)
    shorter.step(1.001 * time, 0.1)
    assert shorter.finished
    assert command_of(shorter) == frozen


@pytest.mark.parametrize("guidance_class", ALL)
def test_cycle_is_the_sample_period_where_one_is_given(guidance_class):
    """Called once a sample period, whatever the communication step that the call is made with."""
    time = commanded(guidance_class).time_to_go
    guidance = commanded(guidance_class, sample_period=1.5 * time)
    guidance.step(1.5 * time - 0.1, 0.1)
    assert guidance.finished  # less than a cycle was left, or the burn timed at the start is over


@pytest.mark.parametrize("guidance_class", EXACT)
def test_exact_times_the_last_burn_and_then_finishes(guidance_class):
    guidance = commanded(guidance_class)
    time = guidance.time_to_go
    guidance.step(0.0, 0.5 * time)
    assert guidance.burn_duration > 1e6  # more than a cycle left: unlimited
    guidance.step(0.5 * time, 1.01 * time)
    assert guidance.burn_duration == guidance.time_to_go == pytest.approx(time, rel=1e-12)
    assert not guidance.finished
    assert guidance.thrust_acceleration > 0.0
    guidance.step(1.51 * time, 1.01 * time)
    assert guidance.finished
    assert command_of(guidance)[0] == 0.0
    assert guidance.burn_duration == 0.0
    assert guidance.time_to_go == 0.0


@pytest.mark.parametrize("guidance_class", STOPPING)
def test_terminal_step_can_be_chosen_for_every_guidance(guidance_class):
    guidance = commanded(guidance_class, terminal_step=1)
    assert guidance.burn_duration == guidance.time_to_go
    time = guidance.time_to_go
    guidance.step(0.0, 0.5 * time)
    assert guidance.burn_duration > 1e6
    guidance.step(0.5 * time, 1.01 * time)
    assert guidance.burn_duration == guidance.time_to_go
    assert not guidance.finished


# ---- flights -----------------------------------------------------------------------------------------------


def flight(guidance_class, position, velocity, step, latch=True, most=5000):
    """Plant and guidance in turn, as the co-simulation schedules them: rows of time, position, velocity."""
    plant = FlatMoonLander(
        initial_position=position.tolist(), initial_velocity=velocity.tolist(), latch_at_burn_end=latch
    )
    plant.initialize()
    guidance = commanded(guidance_class, position, velocity)
    rows = [[0.0, *plant.position, *plant.velocity]]
    for k in range(most):
        if guidance.finished:
            break
        plant.thrust = guidance.thrust_acceleration * plant.mass
        plant.thrust_direction[:] = guidance.thrust_direction
        plant.thrust_direction_rate[:] = guidance.thrust_direction_rate
        plant.command_time, plant.burn_duration = guidance.command_time, guidance.burn_duration
        plant.step(k * step, step)
        see(guidance, plant.position, plant.velocity)
        guidance.step(k * step, step)
        rows.append([(k + 1) * step, *plant.position, *plant.velocity])
    assert guidance.finished
    return np.array(rows), guidance


@pytest.mark.parametrize(("guidance_class", "variant"), [(AnalyticGuidance, "stop"), (AnalyticExactGuidance, "exact")])
@pytest.mark.parametrize("step", [0.1, 1.0, 5.0])
def test_flights_are_those_of_the_independent_lander(guidance_class, variant, step):
    states = [(POSITION, VELOCITY), *states_of_the_box(1 if step < 1.0 else 4, 9)]
    for position, velocity in states:
        rows, _ = flight(guidance_class, position, velocity, step)
        truth = fly(position, velocity, step, variant)
        assert rows[:, 0] == pytest.approx(truth["times"], abs=1e-9)
        assert rows[:, 1:4] == pytest.approx(truth["positions"], rel=1e-9, abs=1e-8)
        assert rows[:, 4:] == pytest.approx(truth["velocities"], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    ("guidance_class", "step", "distance", "speed"),
    [
        (AnalyticExactGuidance, 5.0, 1.7e-2, 0.24),
        (AnalyticExactGuidance, 1.0, 1e-5, 1e-2),
        (AnalyticExactGuidance, 0.1, 1e-8, 1e-4),
        (AstarRobustGuidance, 1.0, 200.0, 10.0),
    ],
)
def test_exact_flights_arrive_within_the_published_bounds(guidance_class, step, distance, speed):
    for position, velocity in states_of_the_box(2 if step < 1.0 else 12, 10):
        rows, guidance = flight(guidance_class, position, velocity, step)
        assert guidance.status == GOOD
        assert np.linalg.norm(rows[-1, 1:4] - TARGET) <= distance
        assert np.linalg.norm(rows[-1, 4:]) <= speed


@pytest.mark.parametrize("guidance_class", [AnalyticGuidance, AstarModifiedGuidance, AstarGuidance])
def test_stopped_flights_land_with_the_speed_of_less_than_a_cycle(guidance_class):
    """At most W h of speed and W h^2/2 of way are left, once the method has found its solution."""
    step = 0.5
    rows, guidance = flight(guidance_class, POSITION, VELOCITY, step, latch=False)
    left = guidance.time_to_go
    assert left < step
    assert np.linalg.norm(rows[-1, 4:]) < 6.0 * step
    assert np.linalg.norm(rows[-1, 1:4] - TARGET) < 6.0 * step**2


@pytest.mark.parametrize("guidance_class", EXACT)
def test_exact_flight_that_starts_within_its_last_cycle_finishes(guidance_class):
    """Constant thrust that arrives exactly, from a fraction of the cycle before."""
    total = np.array([4.5, 0.3, 1.4]) - GRAVITY * UP
    for time in (0.1, 0.2, 0.3, 0.4, 0.6, 0.9):
        rows, _ = flight(guidance_class, TARGET + 0.5 * total * time**2, -total * time, 1.0, most=50)
        assert np.linalg.norm(rows[-1, 1:4] - TARGET) < 1e-3
        assert len(rows) == 2  # over at the end of the cycle of the last burn


def test_a_held_command_finishes_when_its_time_is_a_whole_number_of_cycles():
    guidance = commanded(AstarGuidance)
    guidance.time_to_go = 1.0
    see(guidance, *rootless_state())
    for k in range(8):
        guidance.step(0.25 * k, 0.25)
    assert guidance.finished


def test_a_held_command_of_an_exact_flight_ends_its_burn():
    guidance = commanded(AstarGuidance, terminal_step=1)
    guidance.step(0.0, 10.0)
    end = guidance.command_time + guidance.time_to_go
    see(guidance, *rootless_state())
    for k in range(1, 40):
        guidance.step(10.0 * k, 10.0)
    assert guidance.finished or guidance.command_time + guidance.burn_duration == pytest.approx(end, rel=1e-9)
