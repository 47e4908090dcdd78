"""The orbit by a subclass of spacecraft, exported as a user exports one."""

from pathlib import Path

from crosscheck.cases.leo_zonal.case import CASE, DEGREE, SPEED, START
from crosscheck.perilune_side import fly
from crosscheck.space.plant import GRAVITY_ALONE
from crosscheck.space.surroundings import surroundings
from crosscheck.table import Table


def handed_over(step: float) -> dict:
    """Return Earth, Sun and Moon for each step; an Earth that does not turn, since Basilisk stretches one that does."""
    return surroundings(step, CASE.duration, turns=False)


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
    file = Path(__file__).with_name("zonal_spacecraft.py")
    return fly("zonal_spacecraft", step, CASE.duration, parameters, outputs, file=file)
