"""The libration by orbital_spacecraft."""

import numpy as np
from scipy.spatial.transform import Rotation

from crosscheck.cases.gravity_gradient.case import (
    ANGLES,
    ANGULAR_VELOCITY,
    CASE,
    INERTIA,
    ORBITAL_RATE,
    PULSES,
    TORQUE,
)
from crosscheck.perilune_side import fly
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Simulate; convert its angles to attitudes in the inertial frame that the orbital one is at the start."""
    times = np.array([0.0, *(start for start, _ in PULSES), CASE.duration])
    lengths = np.array([(0.0, 0.0, 0.0), *(each for _, each in PULSES), PULSES[-1][1]])
    count = np.array([0, *(number + 1 for number in range(len(PULSES))), len(PULSES)])
    time = np.repeat(times, 2)[1:-1]
    segment = np.repeat(np.arange(times.size - 1), 2)
    commands = {f"pulse_lengths[{k + 1}]": lengths[segment, k] for k in range(3)} | {"pulse_count": count[segment]}
    parameters = {
        "inertia": [element for row in INERTIA for element in row],
        "jet_torque": list(TORQUE),
        "orbital_rate": ORBITAL_RATE,
        "initial_angles": list(ANGLES),
        "initial_angular_velocity": list(ANGULAR_VELOCITY),
        "internal_step": step,
    }
    outputs = {"angles": "angles", "rate": "angular_velocity"}
    table = fly("orbital_spacecraft", step, CASE.duration, parameters, outputs, {"time": time, **commands})
    roll, yaw, pitch = (table.pop(f"angles[{k + 1}]") for k in range(3))
    to_orbital = Rotation.from_euler("YZX", np.stack([yaw, pitch, roll], axis=1))
    orbit = Rotation.from_rotvec(np.outer(-ORBITAL_RATE * table["time"], [0.0, 0.0, 1.0]))
    quaternion = (orbit * to_orbital).as_quat(scalar_first=True)
    return table | {f"quaternion[{k + 1}]": column for k, column in enumerate(quaternion.T)}
