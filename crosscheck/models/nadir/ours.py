"""The reference by the FMU pointing_guidance."""

import numpy as np
from scipy.spatial.transform import Rotation

from crosscheck.models.nadir.case import POSITIONS, VELOCITIES
from crosscheck.perilune_side import sample
from crosscheck.table import Table, rows_table
from perilune.fmus_src.guidance.pointing_guidance import PointingMode

NAMES = {
    "quaternion": "reference_quaternion",
    "rate": "reference_angular_velocity",
    "acceleration": "reference_angular_acceleration",
}


def evaluate() -> Table:
    """Return the axes, rate (rad/s) and acceleration (rad/s2) in them, for each orbit, as it is when sampled."""
    rows = [0, *range(len(POSITIONS))]  # the guidance takes the first sample before its first step
    inputs = {
        "mode": np.full(len(rows), int(PointingMode.NADIR)),
        "estimated_position": POSITIONS[rows],
        "estimated_velocity": VELOCITIES[rows],
        "sample_time": np.arange(1.0, len(rows) + 1.0),
        "orbit_count": np.arange(len(rows)),
        "sun_direction": np.tile([1.0, 0.0, 0.0], (len(rows), 1)),
    }
    table = sample("pointing_guidance", {"oblateness": 0.0, "sample_period": 0.0}, inputs, NAMES)
    table = {name: column[1:] for name, column in table.items()}
    quaternion = np.stack([table[f"quaternion[{k}]"] for k in (1, 2, 3, 4)], axis=1)
    axes = Rotation.from_quat(quaternion, scalar_first=True).as_matrix().transpose(0, 2, 1).reshape(-1, 9)
    return table | rows_table(axes=axes)
