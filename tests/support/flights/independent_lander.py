"""Independent simulation of the lunar landing: plain numpy, no code in common with the components.

Plant and analytic terminal guidance in one loop, written from the published formulas in angles with their known
corrections. It shares only the contract with the components: a command holds for one guidance cycle, during which
thrust points along normalised(d + d' (t - command_time)), motion is integrated by the classic Runge-Kutta method with
substeps of at most 0.1 s, and a flight ends with the first cycle whose time to go is shorter than the cycle, or with a
last burn of the remaining time to go.

Frame: landing site, x north, y west, z up; m, m/s, s, rad.
"""

import math
from typing import Any

import numpy as np

TARGET = np.array([0.0, 0.0, 2000.0])
GRAVITY = 1.62
LONGEST_SUBSTEP = 0.1
LAST_BURN = 1.5  # steps
CYCLES_AT_MOST = 1_000_000
UP = np.array([0.0, 0.0, 1.0])


def time_to_go(position: np.ndarray, velocity: np.ndarray, exact: bool) -> float:
    """Return time-to-go (s) to rest at the target from |A| T = 2 |B|, with or without its cubic term."""
    way = TARGET - position
    cubic = 2.0 * GRAVITY * velocity[2]
    square = velocity @ velocity - 4.0 * (velocity @ velocity + GRAVITY * way[2])
    linear = 8.0 * (way @ velocity)
    constant = -4.0 * (way @ way)
    discriminant = max(linear**2 - 4.0 * square * constant, 0.0)
    root = (-linear - math.sqrt(discriminant)) / (2.0 * square)
    if not exact:
        return float(root)
    roots = np.roots([cubic, square, linear, constant])
    root = roots[np.argmin(abs(roots - root))].real
    for _ in range(3):
        value = np.polyval([cubic, square, linear, constant], root)
        slope = np.polyval([3.0 * cubic, 2.0 * square, linear], root)
        if slope != 0.0:
            root = root - value / slope
    return float(root)


def command(position: np.ndarray, velocity: np.ndarray, exact: bool) -> tuple[float, float, np.ndarray, np.ndarray]:
    """Return time-to-go (s), thrust acceleration (m/s2), thrust direction and its derivative (1/s)."""
    time = time_to_go(position, velocity, exact)
    a = -velocity + GRAVITY * time * UP
    b = TARGET - position - velocity * time + 0.5 * GRAVITY * time**2 * UP
    p = 3.0 * b - a * time
    q = a * time - 2.0 * b
    horizontal = math.hypot(p[0], p[1])
    yaw = math.atan2(p[1], p[0])
    yaw_rate = -3.0 * (a[0] * b[1] - a[1] * b[0]) / horizontal**2
    pitch = math.atan2(p[2], horizontal)
    if exact:
        growth = 3.0 / time * (p[0] * q[0] + p[1] * q[1]) / horizontal
        pitch_rate = (3.0 / time * q[2] * horizontal - p[2] * growth) / (horizontal**2 + p[2] ** 2)
    else:
        pitch_rate = 3.0 / time * q[2] / horizontal
    direction = np.array([math.cos(pitch) * math.cos(yaw), math.cos(pitch) * math.sin(yaw), math.sin(pitch)])
    to_pitch = np.array([-math.sin(pitch) * math.cos(yaw), -math.sin(pitch) * math.sin(yaw), math.cos(pitch)])
    to_yaw = np.array([-math.cos(pitch) * math.sin(yaw), math.cos(pitch) * math.cos(yaw), 0.0])
    return time, math.sqrt(a @ a) / time, direction, pitch_rate * to_pitch + yaw_rate * to_yaw


def burn(
    state: np.ndarray, duration: float, acceleration: float, direction: np.ndarray, rate: np.ndarray
) -> np.ndarray:
    """Return the state (position, velocity) ``duration`` (s) after a command, by Runge-Kutta with four slopes."""

    def slope(since_command: float, y: np.ndarray) -> np.ndarray:
        along = direction + rate * since_command
        return np.concatenate([y[3:], acceleration * along / math.sqrt(along @ along) - GRAVITY * UP])

    pieces = max(1, math.ceil(duration / LONGEST_SUBSTEP - 1e-9))
    h = duration / pieces
    for k in range(pieces):
        since = k * h
        k1 = slope(since, state)
        k2 = slope(since + h / 2.0, state + h / 2.0 * k1)
        k3 = slope(since + h / 2.0, state + h / 2.0 * k2)
        k4 = slope(since + h, state + h * k3)
        state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return state


def fly(initial_position: Any, initial_velocity: Any, step: float, variant: str) -> dict[str, Any]:
    """Fly from a state (m, m/s) with a guidance cycle of ``step`` (s) to the target at rest.

    ``variant`` is "stop" (quadratic time-to-go; ends at the first cycle, after the start, with
    time-to-go below the step) or "exact" (cubic time-to-go, exact pitch rate; from one and a half
    steps on the last command burns for the time-to-go, and the state is kept from there).

    Returns ``times`` (n + 1), ``positions`` and ``velocities`` (n + 1, 3) at every cycle, and
    ``last_burn`` (s), the length of the last burn ("exact") or the time-to-go left unflown ("stop").
    Raises RuntimeError if the flight does not end.
    """
    if variant not in ("stop", "exact"):
        raise ValueError(f"variant {variant!r}: use 'stop' or 'exact'")
    exact = variant == "exact"
    state = np.concatenate([np.asarray(initial_position, dtype=float), np.asarray(initial_velocity, dtype=float)])
    states = [state]
    for cycle in range(CYCLES_AT_MOST):
        time, acceleration, direction, rate = command(state[:3], state[3:], exact)
        last = cycle > 0 and (time <= LAST_BURN * step if exact else time < step)
        if last and not exact:
            break
        if not last or time > step:
            states.append(burn(state, step, acceleration, direction, rate))
        if last:
            states.append(burn(state, time, acceleration, direction, rate))
            break
        state = states[-1]
    else:
        raise RuntimeError(f"no end of the flight in {CYCLES_AT_MOST} cycles")
    table = np.array(states)
    return {
        "times": step * np.arange(len(states)),
        "positions": table[:, :3],
        "velocities": table[:, 3:],
        "last_burn": time,
    }
