"""The flight by a subclass of spacecraft, exported as a user exports one."""

from pathlib import Path

from crosscheck.cases.leo_plates.case import (
    ANGULAR_VELOCITY,
    CASE,
    DENSITY,
    HEIGHT,
    INERTIA,
    LARGER,
    MASS,
    PLATES,
    QUATERNION,
    RADIUS,
    SCALE_HEIGHT,
    SPEED,
    START,
)
from crosscheck.perilune_side import fly
from crosscheck.space.plant import GRAVITY_ALONE, OUTPUTS, POINT_MASS, WITHOUT_WHEELS, flat
from crosscheck.space.surroundings import surroundings
from crosscheck.table import Table
from perilune.fmus_src.mathlib.space.surfaces import COLUMNS
from perilune.fmus_src.mathlib.space.surfaces import PLATES as LARGEST


def handed_over(step: float) -> dict:
    """Return Sun and axes of the Earth for each step."""
    return surroundings(step, CASE.duration)


def simulate(step: float) -> Table:
    """Areas larger by the ratio of the solar constants, coefficients of drag smaller by it."""
    rows = [
        (LARGER * area, *rest, coefficient / LARGER, specular, diffuse)
        for area, *rest, coefficient, specular, diffuse in PLATES
    ]
    parameters = {
        **GRAVITY_ALONE,
        **POINT_MASS,
        **WITHOUT_WHEELS,
        "plates": flat(rows) + [0.0] * (LARGEST - len(rows)) * COLUMNS,
        "ground_radius": RADIUS,
        "reference_density": DENSITY,
        "reference_height": HEIGHT,
        "scale_height": SCALE_HEIGHT,
        "mass": MASS,
        "inertia": flat(INERTIA),
        "initial_position": list(START),
        "initial_velocity": list(SPEED),
        "initial_quaternion": list(QUATERNION),
        "initial_angular_velocity": list(ANGULAR_VELOCITY),
        "internal_step": step,
    }
    return fly("round_air", step, CASE.duration, parameters, OUTPUTS, file=Path(__file__).with_name("round_air.py"))
