"""A low orbit of the Earth under all harmonics, Sun and Moon."""

from crosscheck.case import POSITION, VELOCITY, Case
from crosscheck.space.points import LOW_ORBIT

DEGREE = 8
START, SPEED = LOW_ORBIT

CASE = Case(
    title="low orbit, gravity of degree 8, Sun and Moon",
    verifies="spacecraft: orbit under gravity of degree and order 8 in the axes of the Earth that turns",
    gravitation="GGM03S to degree and order 8; Sun and Moon",
    environment="none",
    integrator="Runge-Kutta of fourth order",
    matched="in Basilisk pole, Sun and Moon of a step are those of its middle, as here; its Earth turns on linearly "
    "within a step, ours along a circle",
    step=2.0,
    duration=5600.0,
    quantities={"position": POSITION, "velocity": VELOCITY},
    bounds={"position": 1.0, "velocity": 1e-3},
)
