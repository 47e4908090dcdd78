"""Problem of the terminal guidances, independent of their code: published box, roots and thrust by numpy and mpmath.

The thrust acceleration a0 + a1 t is mpmath's solution of the boundary conditions, times to go are `numpy.roots` of the
conditions multiplied out as polynomials.
"""

import math

import mpmath
import numpy as np
from numpy.polynomial import Polynomial

GRAVITY = 1.62
EXHAUST_SPEED = 3100.0
TARGET = np.array([0.0, 0.0, 2000.0])
UP = np.array([0.0, 0.0, 1.0])
POSITION = np.array([1e5, 0.0, 10500.0])
VELOCITY = 950.0 * np.array([-math.cos(0.05), 0.0, -math.sin(0.05)])


def declared_state(fractions):
    """Return a state of the published box from six numbers in [0, 1]."""
    u = list(fractions)
    ground = 0.95e5 + 1e4 * u[0]
    azimuth = -math.pi / 4 + math.pi / 2 * u[1]
    height = 0.95e4 + 2e3 * u[2]
    speed = 940.0 + 20.0 * u[3]
    climb = -math.atan2(height, ground) * u[4]
    heading = azimuth + math.pi + math.pi / 18 * (2.0 * u[5] - 1.0)
    position = np.array([ground * math.cos(azimuth), ground * math.sin(azimuth), height])
    velocity = speed * np.array(
        [math.cos(climb) * math.cos(heading), math.cos(climb) * math.sin(heading), math.sin(climb)]
    )
    return position, velocity


def states_of_the_box(count, seed):
    generator = np.random.default_rng(seed)
    return [declared_state(generator.uniform(size=6)) for _ in range(count)]


def linear_thrust(position, velocity, time):
    """Return a0 and a1 of the thrust acceleration that arrives at rest at the target after ``time``.

    In 30 digits: the equations are ill-conditioned, and LAPACK rounds differently from processor to processor.
    """
    with mpmath.workdps(30):
        t = mpmath.mpf(time)
        conditions = mpmath.matrix([[t, t**2 / 2], [t**2 / 2, t**3 / 6]])
        gain, way = [], []
        for x, v, target, up in zip(position, velocity, TARGET, UP, strict=True):
            gain.append(-mpmath.mpf(v) + GRAVITY * t * up)
            way.append(mpmath.mpf(target) - x - v * t + GRAVITY * t**2 / 2 * up)
        columns = [mpmath.lu_solve(conditions, mpmath.matrix(pair)) for pair in zip(gain, way, strict=True)]
        return np.array([[float(column[row]) for column in columns] for row in (0, 1)])


def impulse_and_miss(position, velocity, time):
    a = -velocity + GRAVITY * time * UP
    return a, TARGET - position - velocity * time + 0.5 * GRAVITY * time**2 * UP


def polynomials(position, velocity):
    """Return A T, B as polynomials of T, component by component."""
    impulses = [Polynomial([0.0, -velocity[i], GRAVITY * UP[i]]) for i in range(3)]
    misses = [Polynomial([TARGET[i] - position[i], -velocity[i], 0.5 * GRAVITY * UP[i]]) for i in range(3)]
    return impulses, misses


def positive_roots(polynomial, degree):
    collected = np.roots(polynomial.coef[: degree + 1][::-1])
    real = collected[abs(collected.imag) < 1e-9 * abs(collected)].real
    real = real - polynomial(real) / polynomial.deriv()(real)
    return sorted(real[real > 0.0])


def astar_roots(position, velocity):
    """Return positive roots of (A T - 3 B).(A T - 2 B) = 0, whose fourth power cancels."""
    impulses, misses = polynomials(position, velocity)
    pairs = zip(impulses, misses, strict=True)
    return positive_roots(sum(((a - 3.0 * b) * (a - 2.0 * b) for a, b in pairs), Polynomial([0.0])), 3)


def balance_polynomial(position, velocity, degree):
    """Return |A|^2 T^2 - 4 |B|^2, whose fourth power cancels; of degree 3, or 2 for the published quadratic."""
    impulses, misses = polynomials(position, velocity)
    whole = sum((a * a for a in impulses), Polynomial([0.0])) - 4.0 * sum((b * b for b in misses), Polynomial([0.0]))
    return Polynomial(whole.coef[: degree + 1])


def balance_roots(position, velocity, degree):
    """Return positive roots of |A|^2 T^2 = 4 |B|^2."""
    return positive_roots(balance_polynomial(position, velocity, degree), degree)


def modified_time(position, velocity):
    """Evaluate the published closed formula, in the method's axes (y up)."""
    distance = np.linalg.norm(TARGET - position)
    speed = np.linalg.norm(velocity)
    lift = -velocity[2] + 2.0 * GRAVITY * distance / speed
    e = math.sqrt(velocity[0] ** 2 + lift**2 + velocity[1] ** 2)
    return distance / (speed + (position[2] - TARGET[2]) * GRAVITY / speed - e / 2.0 + e**2 / (12.0 * EXHAUST_SPEED))
