"""The descent by spherical_moon_lander."""

import numpy as np

from crosscheck.cases.moon_thrust.case import (
    CASE,
    DIRECTION,
    INITIAL_MASS,
    MU,
    RADIUS,
    SPECIFIC_IMPULSE,
    SPEED,
    START,
    THRUST,
)
from crosscheck.perilune_side import fly
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Simulate an engine and an attitude without delay, one command for the whole flight."""
    parameters = {
        "initial_position": list(START),
        "initial_velocity": list(SPEED),
        "initial_mass": INITIAL_MASS,
        "specific_impulse": SPECIFIC_IMPULSE,
        "gravitational_parameter": MU,
        "moon_radius": RADIUS,
        "thrust_lag": 0.0,
        "direction_response": 0.0,
        "slew_rate_limit": 0.0,
        "internal_step": step,
    }
    time = np.array([0.0, CASE.duration])
    command = {"thrust": THRUST, "burn_duration": 2.0 * CASE.duration}
    command |= {f"thrust_direction[{k + 1}]": element for k, element in enumerate(DIRECTION)}
    commands = {"time": time, **{name: np.full(2, level) for name, level in command.items()}}
    outputs = {"position": "position", "velocity": "velocity", "mass": "mass"}
    return fly("spherical_moon_lander", step, CASE.duration, parameters, outputs, commands)
