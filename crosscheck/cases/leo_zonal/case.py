"""A low orbit of the Earth under zonal harmonics, Sun and Moon."""

from crosscheck.case import POSITION, VELOCITY, Case
from crosscheck.space.points import LOW_ORBIT

DEGREE = 8
START, SPEED = LOW_ORBIT

CASE = Case(
    title="low orbit, zonal gravity, Sun and Moon",
    verifies="spacecraft: orbit under J2 to J8, Sun and Moon, with the pole of our series, over a revolution",
    gravitation="GGM03S, zonal terms to degree 8; Sun and Moon",
    environment="none",
    integrator="Runge-Kutta of fourth order",
    matched="here by a class that overrides one method of the plant, so that tesseral terms are 0; in Basilisk pole, "
    "Sun and Moon of a step are those of its middle, as here",
    step=5.0,
    duration=5600.0,
    quantities={"position": POSITION, "velocity": VELOCITY},
    bounds={"position": 1e-6, "velocity": 1e-9},
)
