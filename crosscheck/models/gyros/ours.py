"""The gyros' samples by the FMU rate_gyros."""

import numpy as np
from scipy.spatial.transform import Rotation

from crosscheck.models.gyros.case import BIAS, PITCH, RANGE, RATES, ROLL, SCALE, YAW
from crosscheck.perilune_side import sample
from crosscheck.table import Table


def evaluate() -> Table:
    """Return a sample (rad/s) of each rate: S holds turn and scale factors, Basilisk's bias is scaled, too."""
    turn = Rotation.from_euler("ZYX", [YAW, PITCH, ROLL]).as_matrix().T
    parameters = {
        "bias": list(np.multiply(SCALE, BIAS)),
        "scale": (np.diag(SCALE) @ turn - np.eye(3)).ravel().tolist(),
        "range": RANGE,
        "sample_period": 1.0,
    }
    return sample("rate_gyros", parameters, {"angular_velocity": RATES}, {"rate": "measured_angular_velocity"})
