"""The flight by wheel_satellite."""

import numpy as np

from crosscheck.cases.wheel_satellite.case import (
    ANGULAR_VELOCITY,
    AXES,
    CASE,
    COMMANDS,
    COULOMB,
    INERTIA,
    QUATERNION,
    SPEEDS,
    SPIN_INERTIA,
    TORQUE,
    VISCOUS,
)
from crosscheck.perilune_side import fly
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Simulate without limits of torque and speed."""
    times = np.array([*(time for time, _ in COMMANDS), CASE.duration])
    torques = np.array([*(each for _, each in COMMANDS), COMMANDS[-1][1]])
    segment = np.repeat(np.arange(times.size - 1), 2)
    commands = {f"motor_torques[{k + 1}]": torques[segment, k] for k in range(4)}
    parameters = {
        "inertia": [element for row in INERTIA for element in row],
        "wheel_axes": [element for row in AXES for element in row],
        "wheel_inertia": SPIN_INERTIA,
        "motor_torque_limit": 10.0,
        "speed_limit": 0.0,
        "viscous_friction": VISCOUS,
        "coulomb_friction": COULOMB,
        "body_torque": list(TORQUE),
        "initial_quaternion": list(QUATERNION),
        "initial_angular_velocity": list(ANGULAR_VELOCITY),
        "initial_wheel_speeds": list(SPEEDS),
        "internal_step": step,
    }
    outputs = {"quaternion": "quaternion", "rate": "angular_velocity", "wheel_speed": "wheel_speeds"}
    inputs = {"time": np.repeat(times, 2)[1:-1], **commands}
    return fly("wheel_satellite", step, CASE.duration, parameters, outputs, inputs)
