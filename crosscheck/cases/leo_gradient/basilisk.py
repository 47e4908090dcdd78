"""The flight in Basilisk."""

from crosscheck.cases.leo_gradient import case
from crosscheck.space.basilisk_effectors import begin_in_gradient
from crosscheck.table import Table


def fly(step: float) -> Table:
    """Simulate gravity of a point mass and its gradient."""
    flight = begin_in_gradient(case, step)
    flight.run(case.CASE.duration)
    return flight.table()
