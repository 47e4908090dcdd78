"""The flight by spacecraft."""

import numpy as np

from crosscheck.cases.leo_torquers import case
from crosscheck.cases.leo_torquers.case import CASE, COMMANDS, FIELD_DEGREE, LIMIT, RESIDUAL
from crosscheck.perilune_side import fly
from crosscheck.space.plant import OUTPUTS, in_gradient
from crosscheck.space.surroundings import surroundings
from crosscheck.table import Table
from perilune.fmus_src.mathlib.space import magnetic_field


def handed_over(step: float) -> dict:
    """Return the axes of the Earth in the middle of each step, and Schmidt's coefficients of the field (nT)."""
    given = surroundings(step, CASE.duration, epoch=magnetic_field.START, at=0.5)
    return given | {"schmidt": list(magnetic_field.FIELD)}


def simulate(step: float) -> Table:
    """Simulate dipoles that change between steps."""
    times = np.array([*(time for time, _ in COMMANDS), CASE.duration])
    dipoles = np.array([*(each for _, each in COMMANDS), COMMANDS[-1][1]])
    segment = np.repeat(np.arange(times.size - 1), 2)
    commands = {f"dipole[{k + 1}]": dipoles[segment, k] for k in range(3)}
    parameters = {
        **in_gradient(case, step),
        "epoch": magnetic_field.START,
        "magnetic_degree": FIELD_DEGREE,
        "residual_dipole": list(RESIDUAL),
        "dipole_limit": LIMIT,
    }
    inputs = {"time": np.repeat(times, 2)[1:-1], **commands}
    return fly("spacecraft", step, CASE.duration, parameters, OUTPUTS, inputs)
