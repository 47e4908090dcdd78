"""The magnetometer's samples by the FMU magnetometer."""

import numpy as np
from scipy.spatial.transform import Rotation

from crosscheck.models.magnetometer.case import BIAS, FIELDS, PITCH, RANGE, ROLL, SCALE, YAW
from crosscheck.perilune_side import sample
from crosscheck.table import Table


def evaluate() -> Table:
    """Return a sample (T) of each field: S holds turn and scale factor, Basilisk's bias is scaled, too."""
    turn = Rotation.from_euler("ZYX", [YAW, PITCH, ROLL]).as_matrix().T
    parameters = {
        "sigma": 0.0,
        "bias_sigma": 0.0,
        "scale_sigma": 0.0,
        "quantum": 0.0,
        "bias": list(SCALE * np.array(BIAS)),
        "scale": (SCALE * turn - np.eye(3)).ravel().tolist(),
        "range": RANGE,
    }
    return sample("magnetometer", parameters, {"magnetic_field_body": FIELDS}, {"field": "measured_field"})
