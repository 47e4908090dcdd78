"""Hover guidance alone, and a point mass that follows its commands, integrated by scipy."""

import numpy as np
from scipy.integrate import solve_ivp

from perilune.fmus_src.guidance.hover_guidance import HoverGuidance

GRAVITY = 1.622
EXHAUST = 300.0 * 9.80665
START = [0.0, 0.0, 2400.0]
TARGET = [1600.0, 0.0, 100.0]
MASS = 600.0
H = 0.1


def begun(**values):
    """Return a block after its first sample, at time 0."""
    block = HoverGuidance()
    defaults = {
        "uniform_gravity": GRAVITY,
        "position": START,
        "target_position": TARGET,
        "mass": MASS,
        "sample_period": H,
        "engine_lag": 0.0,
    }
    for name, value in {**defaults, **values}.items():
        setattr(block, name, value)
    block.initialize()
    return block


def fly(block, seconds, position=None, velocity=(0.0, 0.0, 0.0), gravity=lambda r: np.array([0.0, 0.0, -GRAVITY])):
    """Fly a point mass under the block's commands; yield time and state (position, velocity, mass) at every sample."""
    state = np.array([*(START if position is None else position), *velocity, block.mass])
    for n in range(round(seconds / H)):
        thrust, direction, rate = (
            block.thrust_acceleration * block.mass,
            np.array(block.thrust_direction),
            np.array(block.thrust_direction_rate),
        )

        def rates(t, s, thrust=thrust, direction=direction, rate=rate):
            d = direction + t * rate
            return [*s[3:6], *(thrust / s[6] * d / np.linalg.norm(d) + gravity(s[:3])), -thrust / EXHAUST]

        before = state
        state = solve_ivp(rates, (0.0, H), state, rtol=1e-9, atol=1e-9).y[:, -1]
        block.position, block.velocity, block.mass = state[:3], state[3:6], float(state[6])
        middle = gravity(0.5 * (before[:3] + state[:3]))
        block.velocity_increment = state[3:6] - before[3:6] - H * middle
        d = direction + H * rate
        block.attitude, block.angular_rate = d / np.linalg.norm(d), np.cross(direction, rate)
        block.step(n * H, H)
        yield (n + 1) * H, state


def last(flight):
    *_, end = flight
    return end
