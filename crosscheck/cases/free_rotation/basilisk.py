"""The rotation in Basilisk."""

from crosscheck.basilisk_side import Flight, to_mrp
from crosscheck.cases.free_rotation.case import ANGULAR_VELOCITY, CASE, INERTIA, QUATERNION
from crosscheck.table import Table


def fly(step: float) -> Table:
    """Simulate a hub alone."""
    flight = Flight(step)
    flight.set_inertia([[INERTIA[0], 0.0, 0.0], [0.0, INERTIA[1], 0.0], [0.0, 0.0, INERTIA[2]]])
    flight.start((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), to_mrp(QUATERNION), ANGULAR_VELOCITY)
    flight.run(CASE.duration)
    return flight.table()
