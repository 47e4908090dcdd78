"""The flight by a subclass of spacecraft, exported as a user exports one."""

from pathlib import Path

from crosscheck.cases.leo_plates import case
from crosscheck.cases.leo_plates.case import CASE, DENSITY, HEIGHT, LARGER, PLATES, RADIUS, SCALE_HEIGHT
from crosscheck.perilune_side import fly
from crosscheck.space.plant import OUTPUTS, flat, in_gradient
from crosscheck.space.surroundings import surroundings
from crosscheck.table import Table
from perilune.fmus_src.mathlib.space.surfaces import COLUMNS
from perilune.fmus_src.mathlib.space.surfaces import PLATES as LARGEST


def handed_over(step: float) -> dict:
    """Return Sun and axes of the Earth for each step."""
    return surroundings(step, CASE.duration)


def simulate(step: float) -> Table:
    """Simulate areas larger by the ratio of the solar constants, coefficients of drag smaller by it."""
    rows = [
        (LARGER * area, *others, coefficient / LARGER, specular, diffuse)
        for area, *others, coefficient, specular, diffuse in PLATES
    ]
    parameters = {
        **in_gradient(case, step),
        "plates": flat(rows) + [0.0] * (LARGEST - len(rows)) * COLUMNS,
        "ground_radius": RADIUS,
        "reference_density": DENSITY,
        "reference_height": HEIGHT,
        "scale_height": SCALE_HEIGHT,
    }
    return fly("round_air", step, CASE.duration, parameters, OUTPUTS, file=Path(__file__).with_name("round_air.py"))
