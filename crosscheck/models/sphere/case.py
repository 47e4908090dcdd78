"""Drag and solar pressure on a sphere that moves in all directions, with the Sun in others."""

import numpy as np

from crosscheck.case import vector
from crosscheck.comparison import Comparison
from crosscheck.space.points import directions

AREA, DRAG, REFLECTIVITY = 1.5, 2.2, 1.3  # m2, coefficients
DENSITY, VELOCITIES = (
    5e-13,
    np.linspace(7000.0, 8000.0, 20)[:, None] * directions(20),
)  # kg/m3; m/s, against air at rest
SUNS = np.linspace(1.47e11, 1.52e11, 20)[:, None] * directions(20)[::-1]  # m, from the craft
ASTRONOMICAL_UNIT = 149597870693.0  # m, that of Basilisk's sphere
CASE = Comparison(
    title="drag and solar pressure on a sphere",
    basilisk="`DragDynamicEffector`, `RadiationPressure`",
    inputs="20 velocities and directions of the Sun; ours with Basilisk's astronomical unit",
    quantities={name: vector(name) for name in ("drag", "pressure")},
    bounds=dict.fromkeys(("drag", "pressure"), 1e-12),
)
