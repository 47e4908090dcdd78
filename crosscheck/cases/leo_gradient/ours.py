"""The flight by spacecraft."""

from crosscheck.cases.leo_gradient.case import (
    ANGULAR_VELOCITY,
    CASE,
    INERTIA,
    MASS,
    QUATERNION,
    SPEED,
    START,
)
from crosscheck.perilune_side import fly
from crosscheck.space.plant import GRAVITY_ALONE, OUTPUTS, POINT_MASS, WITHOUT_WHEELS, flat
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Gravity of a point mass alone."""
    parameters = {
        **GRAVITY_ALONE,
        **POINT_MASS,
        **WITHOUT_WHEELS,
        "mass": MASS,
        "inertia": flat(INERTIA),
        "initial_position": list(START),
        "initial_velocity": list(SPEED),
        "initial_quaternion": list(QUATERNION),
        "initial_angular_velocity": list(ANGULAR_VELOCITY),
        "internal_step": step,
    }
    return fly("spacecraft", step, CASE.duration, parameters, OUTPUTS)
