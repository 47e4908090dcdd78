"""Integrators: exact for what their order promises, and of that order.

Truth: closed forms of a harmonic oscillator and of polynomials.
"""

from __future__ import annotations

import math

import pytest

from perilune.fmus_src.kernel.integrators import Translation, runge_kutta_4, simpson
from perilune.fmus_src.kernel.records import Field, Record
from perilune.fmus_src.kernel.vector_types import vector


class Oscillator(Record):
    """x'' = -rate^2 x."""

    place = Field(unit="m")
    speed = Field(unit="m/s")


def swing(t: float, s: Oscillator, rate: float) -> Oscillator:
    """Rates."""
    return Oscillator(place=s.speed, speed=-rate * rate * s.place)


def error(steps: int) -> float:
    """At the end of a second of an oscillator of 3 rad/s."""
    s = Oscillator(place=1.0, speed=0.0)
    for n in range(steps):
        s = runge_kutta_4(swing, n / steps, s, 1.0 / steps, 3.0)
    return math.hypot(s.place - math.cos(3.0), s.speed / 3.0 + math.sin(3.0))


def test_the_error_falls_with_the_fourth_power_of_the_step():
    assert math.log2(error(20) / error(40)) == pytest.approx(4.0, abs=0.1)
    assert error(100) < 1e-6


@pytest.mark.parametrize("power", [0, 1, 2, 3])
def test_polynomials_of_time_are_exact(power):
    end = runge_kutta_4(lambda t, x: (power + 1) * t**power, 0.5, 0.5 ** (power + 1), 1.5)
    assert end == pytest.approx(2.0 ** (power + 1), rel=1e-15)


def test_inputs_are_passed_on():
    assert runge_kutta_4(lambda t, x, a, b: a + b, 0.0, 1.0, 2.0, 3.0, 4.0) == 15.0


def test_simpsons_rule_is_exact_for_accelerations_of_the_second_degree():
    """x'' = (2, 6 t, 12 t^2) from t = 1 on: x = (t^2, t^3, t^4)."""
    start = Translation(position=vector(1.0, 1.0, 1.0), velocity=vector(2.0, 3.0, 4.0))
    end = simpson(lambda t: vector(2.0, 6.0 * t, 12.0 * t * t), 1.0, start, 0.5)
    assert end.position == pytest.approx([1.5**2, 1.5**3, 1.5**4], rel=1e-15)
    assert end.velocity == pytest.approx([2.0 * 1.5, 3.0 * 1.5**2, 4.0 * 1.5**3], rel=1e-15)
