"""A free flight of spacecraft with modes, under a force and a torque in body axes."""

import numpy as np

from crosscheck.perilune_side import fly
from crosscheck.space.plant import GRAVITY_ALONE, POINT_MASS, WITHOUT_WHEELS, flat
from crosscheck.table import Table

FAR = {"initial_position": [1e15, 0.0, 0.0], "initial_velocity": [0.0, 0.0, 0.0]}  # where gravity is nothing
MODES = 4


def swing_plant(
    modes: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray],
    whole: tuple[float, object],
    drive: tuple[np.ndarray, np.ndarray],
    step: float,
    duration: float,
) -> Table:
    """Return the table of a flight from rest: a whole (mass, inertia) under a force (N) and a torque (N m).

    ``modes``: frequency (rad/s), damping, participation in translation and in rotation by mode, and the displacement
    of a mode that is 1 in the table.
    """
    frequency, damping, translation, rotation, unit = modes
    none = MODES - len(frequency)
    parameters = {
        **GRAVITY_ALONE,
        **POINT_MASS,
        **WITHOUT_WHEELS,
        **FAR,
        "mass": whole[0],
        "inertia": flat(whole[1]),
        "mode_frequency": [*map(float, frequency), *[0.0] * none],
        "mode_damping": [*map(float, damping), *[0.0] * none],
        "mode_translation": np.vstack([translation, np.zeros((none, 3))]).ravel().tolist(),
        "mode_rotation": np.vstack([rotation, np.zeros((none, 3))]).ravel().tolist(),
        "body_force": drive[0].tolist(),
        "body_torque": drive[1].tolist(),
        "internal_step": step,
    }
    outputs = {"rate": "angular_velocity", "displacement": "mode_displacements"}
    table = fly("spacecraft", step, duration, parameters, outputs)
    scaled = {f"displacement[{k + 1}]": table[f"displacement[{k + 1}]"] / each for k, each in enumerate(unit)}
    return table | scaled
