"""Integrators: one step of x' = f(t, x, inputs) for a state x that is a float, vector or record.

`derivatives` is a function, or a method of a block, of time (s), state and inputs, without side effects. The inputs are
constant over the step. The C translator generates each integrator separately for every `derivatives` and state.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from .records import Field, Record
from .vector_types import Vector3

STEP_ROUNDING = 1e-9  # tolerance for multiples of a step or period, as a fraction of it

State = TypeVar("State")  # a float, a vector or a record
Derivatives = Callable[..., Any]  # (t, state, *inputs) -> rate of the state


def runge_kutta_4(derivatives: Derivatives, t: float, state: State, h: float, *inputs: Any) -> State:
    """Return the state at t + h by the classical Runge-Kutta method of fourth order (Kutta 1901).

    Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, table II.1.2.
    """
    k1 = derivatives(t, state, *inputs)
    return runge_kutta_4_from(k1, derivatives, t, state, h, *inputs)


def runge_kutta_4_from(k1: Any, derivatives: Derivatives, t: float, state: State, h: float, *inputs: Any) -> State:
    """Return the state at t + h by `runge_kutta_4` with a known rate k1 at the start."""
    half = 0.5 * h
    k2 = derivatives(t + half, state + half * k1, *inputs)
    k3 = derivatives(t + half, state + half * k2, *inputs)
    k4 = derivatives(t + h, state + h * k3, *inputs)
    return state + h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0


def count_steps(h: float, longest: float) -> int:
    """Return the number of equal steps in h (s) that are not longer than ``longest`` (s) apart from rounding."""
    return int(h / longest - STEP_ROUNDING) + 1


class Translation(Record):
    """Translational motion of a point: position and velocity."""

    position = Field(Vector3, unit="m", description="position of the point")
    velocity = Field(Vector3, unit="m/s", description="velocity of the point")


def simpson(acceleration: Derivatives, t: float, s: Translation, h: float) -> Translation:
    """Return the motion at t + h under x'' = acceleration(t) by Simpson's rule (`runge_kutta_4` reduces to it)."""
    a1 = acceleration(t)
    a2 = acceleration(t + 0.5 * h)
    a4 = acceleration(t + h)
    return Translation(
        position=s.position + h * (s.velocity + h * (a1 + 2.0 * a2) / 6.0),
        velocity=s.velocity + h * (a1 + 4.0 * a2 + a4) / 6.0,
    )


class Forcing(Record):
    """Acceleration during a step, independent of the motion."""

    start = Field(Vector3, unit="m/s2", description="acceleration at the start of the step")
    middle = Field(Vector3, unit="m/s2", description="acceleration in the middle of the step")
    end = Field(Vector3, unit="m/s2", description="acceleration at the end of the step")


def runge_kutta_nystrom(field: Derivatives, s: Translation, forcing: Forcing, h: float) -> Translation:
    """Return the motion after h (s) under x'' = field(x) + forcing by Nystrom's method of fourth order (1925).

    Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, section II.14.
    """
    g1 = field(s.position)
    g2 = field(s.position + 0.5 * h * (s.velocity + 0.25 * h * (g1 + forcing.start)))
    g4 = field(s.position + h * (s.velocity + 0.5 * h * (g2 + forcing.middle)))
    mean = (g1 + 2.0 * g2) + (forcing.start + 2.0 * forcing.middle)
    fall = h * (g1 + 2.0 * g2 + 2.0 * g2 + g4) / 6.0
    return Translation(
        position=s.position + h * (s.velocity + h * mean / 6.0), velocity=s.velocity + gain_of(forcing, h) + fall
    )


def gain_of(forcing: Forcing, h: float) -> Vector3:
    """Return the change of velocity (m/s) by a forcing over h (s), from Simpson's rule."""
    return h * (forcing.start + 2.0 * forcing.middle + 2.0 * forcing.middle + forcing.end) / 6.0
