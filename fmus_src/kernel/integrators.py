"""One step of an integrator for x' = f(t, x, inputs): a function of the rates, for any float, vector or record.

`derivatives` is a method of a block, or a function, of the time (s), the state and the inputs, which are held over the
step; it changes nothing. The translator makes each integrator anew for every `derivatives` and state.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

State = TypeVar("State")  # a float, a vector or a record
Derivatives = Callable[..., Any]  # (t, state, *inputs) -> rate of the state


def runge_kutta_4(derivatives: Derivatives, t: float, state: State, h: float, *inputs: Any) -> State:
    """The state at t + h: the classical method of fourth order (Kutta 1901).

    Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, table II.1.2.
    """
    half = 0.5 * h
    k1 = derivatives(t, state, *inputs)
    k2 = derivatives(t + half, state + half * k1, *inputs)
    k3 = derivatives(t + half, state + half * k2, *inputs)
    k4 = derivatives(t + h, state + h * k3, *inputs)
    return state + h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
