"""The coast in Basilisk."""

from crosscheck.basilisk_side import Flight
from crosscheck.cases.moon_coast.case import APOAPSIS, CASE, MU, RADIUS, SPEED
from crosscheck.table import Table


def fly(step: float) -> Table:
    flight = Flight(step)
    flight.attract(MU)
    flight.start([0.0, 0.0, APOAPSIS], [SPEED, 0.0, 0.0])
    flight.run(CASE.duration)
    table = flight.table()
    table["position[3]"] = table["position[3]"] - RADIUS
    return table
