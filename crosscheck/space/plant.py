"""Flights of the plant spacecraft, with the settings that several cases have."""

from collections.abc import Iterable
from types import ModuleType

import numpy as np

from crosscheck.perilune_side import fly
from crosscheck.space.surroundings import EPOCH, TT_MINUS_UT1
from crosscheck.table import Table

GRAVITY_ALONE = {
    "epoch": EPOCH,
    "tt_minus_ut1": TT_MINUS_UT1,
    "atmosphere": 0,
    "residual_dipole": [0.0, 0.0, 0.0],
}
POINT_MASS = {"gravity_degree": 0, "third_bodies": False}
WITHOUT_WHEELS = {"wheel_inertia": 1e-9, "viscous_friction": 0.0, "coulomb_friction": 0.0}  # the smallest there are
OUTPUTS = {"position": "position", "velocity": "velocity", "quaternion": "quaternion", "rate": "angular_velocity"}
FAR = {"initial_position": [1e15, 0.0, 0.0], "initial_velocity": [0.0, 0.0, 0.0]}  # where gravity is nothing
MODES = 4


def flat(rows: Iterable[Iterable[float]]) -> list[float]:
    """Return the elements of a matrix by row, as a parameter takes them."""
    return [element for row in rows for element in row]


def in_gradient(case: ModuleType, step: float) -> dict:
    """Return the parameters of a rigid craft about a point mass, as a case has it."""
    return {
        **GRAVITY_ALONE,
        **POINT_MASS,
        **WITHOUT_WHEELS,
        "mass": case.MASS,
        "inertia": flat(case.INERTIA),
        "initial_position": list(case.START),
        "initial_velocity": list(case.SPEED),
        "initial_quaternion": list(case.QUATERNION),
        "initial_angular_velocity": list(case.ANGULAR_VELOCITY),
        "internal_step": step,
    }


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
    unused = MODES - len(frequency)
    parameters = {
        **GRAVITY_ALONE,
        **POINT_MASS,
        **WITHOUT_WHEELS,
        **FAR,
        "mass": whole[0],
        "inertia": flat(whole[1]),
        "mode_frequency": [*map(float, frequency), *[0.0] * unused],
        "mode_damping": [*map(float, damping), *[0.0] * unused],
        "mode_translation": np.vstack([translation, np.zeros((unused, 3))]).ravel().tolist(),
        "mode_rotation": np.vstack([rotation, np.zeros((unused, 3))]).ravel().tolist(),
        "body_force": drive[0].tolist(),
        "body_torque": drive[1].tolist(),
        "internal_step": step,
    }
    outputs = {"rate": "angular_velocity", "displacement": "mode_displacements"}
    table = fly("spacecraft", step, duration, parameters, outputs)
    scaled = {f"displacement[{k + 1}]": table[f"displacement[{k + 1}]"] / each for k, each in enumerate(unit)}
    return table | scaled
