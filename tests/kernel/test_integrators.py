"""Integrators: exact for polynomials of their order, and convergent with their order.

Truth: closed forms of a harmonic oscillator, alone and driven, of a circular orbit and of polynomials; the order
observed when the step is halved.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import pytest

from perilune.fmus_src.kernel.integrators import Forcing, Translation, runge_kutta_4, runge_kutta_nystrom, simpson
from perilune.fmus_src.kernel.records import Field, Record
from perilune.fmus_src.kernel.vector_types import Vector3, vector
from perilune.fmus_src.mathlib.vectors import norm


class Oscillator(Record):
    """x'' = -rate^2 x."""

    place = Field(unit="m")
    speed = Field(unit="m/s")


def swing(t: float, s: Oscillator, rate: float) -> Oscillator:
    """Return rates."""
    return Oscillator(place=s.speed, speed=-rate * rate * s.place)


def oscillator_error(steps: int) -> float:
    """Return the error at the end of a second of an oscillator of 3 rad/s."""
    s = Oscillator(place=1.0, speed=0.0)
    for n in range(steps):
        s = runge_kutta_4(swing, n / steps, s, 1.0 / steps, 3.0)
    return math.hypot(s.place - math.cos(3.0), s.speed / 3.0 + math.sin(3.0))


UNFORCED = Forcing(start=vector(0.0, 0.0, 0.0), middle=vector(0.0, 0.0, 0.0), end=vector(0.0, 0.0, 0.0))


def attract(position: Vector3) -> Vector3:
    """Return the attraction of a centre of unit strength, about which a circle of radius 1 has rate 1."""
    return -position / norm(position) ** 3


def spring(position: Vector3) -> Vector3:
    """Return the acceleration of a spring of 3 rad/s."""
    return -9.0 * position


def drive(t: float) -> Vector3:
    """Return the force under which the spring's body goes round with 2 rad/s: 5 - 9 = -2^2."""
    return 5.0 * vector(math.cos(2.0 * t), math.sin(2.0 * t), 0.0)


def turn(t: float) -> Vector3:
    """Return the acceleration of a body that goes round with 1 rad/s."""
    return -vector(math.cos(t), math.sin(t), 0.0)


def circle_by_kutta(t: float, s: Translation, h: float) -> Translation:
    """Step the orbit."""
    return runge_kutta_4(lambda t, s: Translation(position=s.velocity, velocity=attract(s.position)), t, s, h)


def circle_by_nystrom(t: float, s: Translation, h: float) -> Translation:
    """Step the same."""
    return runge_kutta_nystrom(attract, s, UNFORCED, h)


def driven_by_kutta(t: float, s: Translation, h: float) -> Translation:
    """Step the driven oscillator."""

    def derivatives(t: float, s: Translation) -> Translation:
        return Translation(position=s.velocity, velocity=spring(s.position) + drive(t))

    return runge_kutta_4(derivatives, t, s, h)


def driven_by_nystrom(t: float, s: Translation, h: float) -> Translation:
    """Step the same."""
    return runge_kutta_nystrom(spring, s, Forcing(start=drive(t), middle=drive(t + 0.5 * h), end=drive(t + h)), h)


def turned_by_simpson(t: float, s: Translation, h: float) -> Translation:
    """Step under an acceleration over time."""
    return simpson(turn, t, s, h)


def circle_error(advance: Callable[[float, Translation, float], Translation], rate: float, steps: int) -> float:
    """Return the error at the end of two seconds of a body on the unit circle."""

    def exact(t: float) -> Translation:
        c, s = math.cos(rate * t), math.sin(rate * t)
        return Translation(position=vector(c, s, 0.0), velocity=rate * vector(-s, c, 0.0))

    h = 2.0 / steps
    state = exact(0.0)
    for n in range(steps):
        state = advance(n * h, state, h)
    return math.hypot(*(state - exact(2.0)).elements())


ON_A_CIRCLE = [
    (circle_by_kutta, 1.0),
    (circle_by_nystrom, 1.0),
    (driven_by_kutta, 2.0),
    (driven_by_nystrom, 2.0),
    (turned_by_simpson, 1.0),
]


def orders(error: Callable[[int], float]) -> list[float]:
    """Return the powers of the step with which an error falls, halving by halving."""
    errors = [error(steps) for steps in (40, 80, 160)]
    return [math.log2(coarse / fine) for coarse, fine in pairwise(errors)]


def test_an_oscillator_is_integrated_to_the_fourth_order():
    assert orders(oscillator_error) == pytest.approx([4.0, 4.0], abs=0.1)
    assert oscillator_error(100) < 1e-6


@pytest.mark.parametrize(("advance", "rate"), ON_A_CIRCLE)
def test_a_circle_is_integrated_to_the_fourth_order(advance, rate):
    assert orders(lambda steps: circle_error(advance, rate, steps)) == pytest.approx([4.0, 4.0], abs=0.1)
    assert circle_error(advance, rate, 160) < 1e-6


@pytest.mark.parametrize("power", [0, 1, 2, 3])
def test_polynomials_of_time_are_exact(power):
    end = runge_kutta_4(lambda t, x: (power + 1) * t**power, 0.5, 0.5 ** (power + 1), 1.5)
    assert end == pytest.approx(2.0 ** (power + 1), rel=1e-15)


def test_inputs_are_passed_on():
    assert runge_kutta_4(lambda t, x, a, b: a + b, 0.0, 1.0, 2.0, 3.0, 4.0) == 15.0


def test_accelerations_of_the_second_degree_are_exact():
    """x'' = (2, 6 t, 12 t^2) from t = 1 on: x = (t^2, t^3, t^4)."""

    def acceleration(t: float) -> Vector3:
        return vector(2.0, 6.0 * t, 12.0 * t * t)

    start = Translation(position=vector(1.0, 1.0, 1.0), velocity=vector(2.0, 3.0, 4.0))
    forcing = Forcing(start=acceleration(1.0), middle=acceleration(1.25), end=acceleration(1.5))
    by_nystrom = runge_kutta_nystrom(lambda position: vector(0.0, 0.0, 0.0), start, forcing, 0.5)
    for end in (simpson(acceleration, 1.0, start, 0.5), by_nystrom):
        assert end.position == pytest.approx([1.5**2, 1.5**3, 1.5**4], rel=1e-15)
        assert end.velocity == pytest.approx([2.0 * 1.5, 3.0 * 1.5**2, 4.0 * 1.5**3], rel=1e-15)
