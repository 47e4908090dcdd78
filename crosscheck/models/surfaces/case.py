"""Drag and solar pressure on four plates at attitudes that expose and hide each of them."""

import numpy as np

from crosscheck.case import vector
from crosscheck.comparison import Comparison
from crosscheck.space.points import attitudes

# Area (m2), unit outward normal, centre (m), drag coefficient, specular and diffuse reflectivity; body.
PLATES = (
    (0.48, 1.0, 0.0, 0.0, 0.3, 0.01, 0.02, 2.2, 0.3, 0.2),
    (0.48, 0.0, 1.0, 0.0, 0.0, 0.31, 0.0, 2.2, 0.3, 0.2),
    (0.36, 0.0, 0.0, -1.0, 0.01, 0.0, -0.4, 2.2, 0.1, 0.4),
    (0.9, 0.6, 0.0, 0.8, 0.0, -0.9, 0.1, 2.4, 0.1, 0.1),
)
ATTITUDES = attitudes(20)
DENSITY, VELOCITY = 5e-13, np.array([7000.0, 2000.0, -500.0])  # kg/m3; m/s, inertial, against air at rest
SUN = 1.496e11 * np.array([0.6, 0.48, 0.64])  # m, inertial, from the craft
SOLAR_CONSTANT = 1368.0  # W/m2, that of Basilisk; here it is 1361
CASE = Comparison(
    title="drag and solar pressure on plates",
    basilisk="`FacetDragDynamicEffector`, `FacetSRPDynamicEffector`",
    inputs="4 plates, 20 attitudes; ours times 1368/1361, since Basilisk has 1368 W/m2 at 1 AU",
    quantities={name: vector(name) for name in ("drag", "drag_torque", "pressure", "pressure_torque")},
    bounds=dict.fromkeys(("drag", "drag_torque", "pressure", "pressure_torque"), 1e-12),
)
