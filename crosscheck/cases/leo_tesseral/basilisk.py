"""The orbit in Basilisk."""

from crosscheck.basilisk_side import Flight
from crosscheck.cases.leo_tesseral.case import CASE, DEGREE, SPEED, START
from crosscheck.space.basilisk_surroundings import surround
from crosscheck.table import Table


def fly(step: float, given: dict) -> Table:
    """Simulate gravity alone."""
    flight = Flight(step)
    flight.start(START, SPEED)
    surround(flight, given, step, DEGREE)
    flight.run(CASE.duration)
    return flight.table()
