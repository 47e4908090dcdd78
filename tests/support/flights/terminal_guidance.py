"""What the tests of the terminal guidances share: the published box, independent roots and commands, flights.

The thrust acceleration a0 + a1 t comes from numpy's solution of the boundary conditions, times-to-go from
`numpy.roots` of the conditions multiplied out as polynomials: no code in common with the components. `flight`
runs plant and guidance in turn, as the co-simulation schedules them.
"""

import math

import numpy as np
import pytest
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from perilune.fmus_src.guidance.analytic import AnalyticGuidance
from perilune.fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from perilune.fmus_src.guidance.astar import AstarGuidance
from perilune.fmus_src.guidance.astar_modified import AstarModifiedGuidance
from perilune.fmus_src.guidance.astar_robust import AstarRobustGuidance
from perilune.fmus_src.plants.flat_moon_lander import FlatMoonLander

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
        setattr(guidance, name, value)
    guidance.initialize()
    return guidance


def see(guidance, position, velocity):
    guidance.position = np.asarray(position).tolist()
    guidance.velocity = np.asarray(velocity).tolist()


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
    collected = np.roots(polynomial.coef[: degree + 1][::-1])
    real = collected[abs(collected.imag) < 1e-9 * abs(collected)].real
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


def rootless_state():
    return next(state for state in states_of_the_box(100, 8) if not astar_roots(*state))


def flight(guidance_class, position, velocity, step, latch=True, most=5000, error=None):
    """Plant and guidance in turn, as the co-simulation schedules them: rows of time, position, velocity.

    ``error()`` gives the errors of position and velocity (six) that guidance sees in a cycle.
    """
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
        plant.thrust_direction = guidance.thrust_direction
        plant.thrust_direction_rate = guidance.thrust_direction_rate
        plant.command_time, plant.burn_duration = guidance.command_time, guidance.burn_duration
        plant.step(k * step, step)
        seen = np.array([*plant.position, *plant.velocity])
        if error is not None:
            seen = seen + error()
        see(guidance, seen[:3], seen[3:])
        guidance.step(k * step, step)
        rows.append([(k + 1) * step, *plant.position, *plant.velocity])
    assert guidance.finished
    return np.array(rows), guidance
