"""The gyros' flight by free_flying_robot."""

import numpy as np

from crosscheck.cases.robot_gyros.case import (
    ANGULAR_VELOCITY,
    CASE,
    GIMBAL_ANGLES,
    GIMBAL_RATES,
    INERTIA,
    MASS,
    QUATERNION,
    ROTOR_MOMENTUM,
)
from crosscheck.perilune_side import fly
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Simulate without jets; gimbal rates commanded once."""
    parameters = {
        "mass": MASS,
        "inertia": list(INERTIA),
        "rotor_momentum": ROTOR_MOMENTUM,
        "initial_quaternion": list(QUATERNION),
        "initial_angular_velocity": list(ANGULAR_VELOCITY),
        "initial_gimbal_angles": list(GIMBAL_ANGLES),
        "internal_step": step,
    }
    time = np.array([0.0, CASE.duration])
    commands = {f"gimbal_rates[{k + 1}]": np.full(2, rate) for k, rate in enumerate(GIMBAL_RATES)}
    outputs = {"quaternion": "quaternion", "rate": "angular_velocity"}
    return fly("free_flying_robot", step, CASE.duration, parameters, outputs, {"time": time, **commands})
