"""The flight in Basilisk."""

from crosscheck.basilisk_side import Flight, to_mrp
from crosscheck.cases.leo_gradient.case import (
    ANGULAR_VELOCITY,
    CASE,
    INERTIA,
    MASS,
    MU,
    QUATERNION,
    SPEED,
    START,
)
from crosscheck.space.basilisk_gradient import add_gravity_gradient
from crosscheck.table import Table


def fly(step: float) -> Table:
    """Gravity of a point mass and its gradient."""
    flight = Flight(step)
    flight.attract(MU)
    flight.set_inertia([list(row) for row in INERTIA], MASS)
    flight.start(START, SPEED, to_mrp(QUATERNION), ANGULAR_VELOCITY)
    add_gravity_gradient(flight)
    flight.run(CASE.duration)
    return flight.table()
