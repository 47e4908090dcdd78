"""The orbit in Basilisk."""

from crosscheck.basilisk_side import Flight
from crosscheck.cases.leo_zonal.case import CASE, DEGREE, SPEED, START
from crosscheck.space.basilisk_surroundings import surround
from crosscheck.table import Table


def fly(step: float, given: dict) -> Table:
    """Simulate gravity whose coefficients of higher order than 0 are 0."""
    zonal: list[float] = []
    for n in range(2, DEGREE + 1):
        first = n * (n + 1) - 6  # numbers of the degrees before
        zonal += [given["normalised"][first], *([0.0] * (2 * n + 1))]
    flight = Flight(step)
    flight.start(START, SPEED)
    surround(flight, given | {"normalised": zonal}, step, DEGREE)
    flight.run(CASE.duration)
    return flight.table()
