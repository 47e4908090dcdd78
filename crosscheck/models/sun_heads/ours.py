"""The heads' currents by the FMU sun_sensors."""

import numpy as np

from crosscheck.models.sun_heads.case import ATTITUDES, FIELD_OF_VIEW, LIGHT, NORMALS, SUN_DIRECTION
from crosscheck.perilune_side import sample
from crosscheck.table import Table


def evaluate() -> Table:
    """Return the currents, of full scale, at each attitude."""
    parameters = {
        "sigma": 0.0,
        "field_of_view": FIELD_OF_VIEW,
        "normals_of_heads": [element for row in NORMALS for element in row],
        "sample_period": 1.0,
    }
    inputs = {
        "quaternion": ATTITUDES,
        "sun_direction": np.tile(SUN_DIRECTION, (len(ATTITUDES), 1)),
        "illumination": LIGHT,
    }
    return sample("sun_sensors", parameters, inputs, {"currents": "currents"})
