"""The flight by spacecraft."""

from crosscheck.cases.leo_gradient import case
from crosscheck.perilune_side import fly
from crosscheck.space.plant import OUTPUTS, in_gradient
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Simulate gravity of a point mass alone."""
    return fly("spacecraft", step, case.CASE.duration, in_gradient(case, step), OUTPUTS)
