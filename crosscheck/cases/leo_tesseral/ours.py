"""The orbit by spacecraft."""

from crosscheck.cases.leo_tesseral.case import CASE, DEGREE, SPEED, START
from crosscheck.perilune_side import fly
from crosscheck.space.plant import GRAVITY_ALONE
from crosscheck.space.surroundings import surroundings
from crosscheck.table import Table


def handed_over(step: float) -> dict:
    """Return Earth, Sun and Moon for each step."""
    return surroundings(step, CASE.duration)


def simulate(step: float) -> Table:
    """Simulate gravity alone."""
    parameters = {
        **GRAVITY_ALONE,
        "gravity_degree": DEGREE,
        "initial_position": list(START),
        "initial_velocity": list(SPEED),
        "internal_step": step,
    }
    outputs = {"position": "position", "velocity": "velocity"}
    return fly("spacecraft", step, CASE.duration, parameters, outputs)
