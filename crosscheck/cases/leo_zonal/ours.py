"""The orbit by a subclass of spacecraft, exported as a user exports one."""

import tempfile
from pathlib import Path

import perilune
from crosscheck.cases.leo_zonal.case import CASE, DEGREE, SPEED, START
from crosscheck.perilune_side import table_of
from crosscheck.space.plant import GRAVITY_ALONE
from crosscheck.space.surroundings import surroundings
from crosscheck.table import Table

BLOCK = "zonal_spacecraft"


def handed_over(step: float) -> dict:
    """Return Earth, Sun and Moon for each step; an Earth that does not turn, since Basilisk stretches one that does."""
    return surroundings(step, CASE.duration, turns=False)


def simulate(step: float) -> Table:
    """Gravity alone."""
    parameters = {
        **GRAVITY_ALONE,
        "gravity_degree": DEGREE,
        "initial_position": list(START),
        "initial_velocity": list(SPEED),
        "internal_step": step,
    }
    with tempfile.TemporaryDirectory() as folder:
        (fmu,) = perilune.export(Path(__file__).parent / f"{BLOCK}.py", output=f"{folder}/{BLOCK}.fmu", flavour="native").paths
        flight = perilune.simulate(
            fmu,
            step=step,
            stop_time=CASE.duration,
            set={f"{BLOCK}.{name}": setting for name, setting in parameters.items()},
        )
        return table_of(flight, {name: f"{BLOCK}.{name}" for name in ("position", "velocity")})
