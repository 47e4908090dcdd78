"""The attitude of local vertical and horizontal, its rate and acceleration, on eccentric orbits in all directions."""

import numpy as np

from crosscheck.case import vector
from crosscheck.comparison import Comparison
from crosscheck.space.points import directions, points

POSITIONS = points(20, 6.8e6, 8e6)[2:]  # m, inertial
VELOCITIES = 7500.0 * np.cross(directions(20)[2:], [0.3, -0.5, 0.8]) + 900.0 * directions(20)[2:]  # m/s
CASE = Comparison(
    title="reference attitude NADIR",
    basilisk="`hillPoint`, its axes in our order",
    inputs="18 orbits, to 900 m/s away from the Earth; a point mass here",
    quantities={"axes": vector("axes", 9), "rate": vector("rate"), "acceleration": vector("acceleration")},
    bounds={"axes": 1e-14, "rate": 1e-14, "acceleration": 1e-14},
)
