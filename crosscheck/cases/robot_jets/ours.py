"""The jets' flight by free_flying_robot."""

import numpy as np

from crosscheck.cases.robot_jets.case import (
    ANGULAR_VELOCITY,
    ARM,
    AZIMUTH,
    CASE,
    INERTIA,
    MASS,
    ON_TIMES,
    QUATERNION,
    TAIL,
    THRUST,
    TILT,
)
from crosscheck.perilune_side import fly
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Simulate rotors without momentum; thrusts change at whole steps, each time repeated."""
    begins = step * np.arange(round(CASE.duration / step))
    time = np.repeat(np.append(begins, CASE.duration), 2)[1:-1]
    commands = {}
    for jet, on_time in enumerate(ON_TIMES):
        levels = np.where(begins < on_time - 0.5 * step, 1.0, np.where(begins < on_time + 0.5 * step, TAIL, 0.0))
        commands[f"jet_thrust[{jet + 1}]"] = THRUST * np.repeat(levels if on_time else 0.0 * levels, 2)
    parameters = {
        "mass": MASS,
        "inertia": list(INERTIA),
        "jet_tilt": TILT,
        "jet_azimuth": AZIMUTH,
        "jet_arm": list(ARM),
        "maximum_thrust": THRUST,
        "rotor_momentum": 0.0,
        "initial_quaternion": list(QUATERNION),
        "initial_angular_velocity": list(ANGULAR_VELOCITY),
        "internal_step": step,
    }
    outputs = {"position": "position", "velocity": "velocity", "quaternion": "quaternion", "rate": "angular_velocity"}
    return fly("free_flying_robot", step, CASE.duration, parameters, outputs, {"time": time, **commands})
