"""Six coarse Sun sensor heads without noise, in full and in partial light."""

import math

import numpy as np

from crosscheck.case import vector
from crosscheck.comparison import Comparison
from crosscheck.space.points import attitudes

FIELD_OF_VIEW = math.radians(60.0)  # half-angle
NORMALS = ((1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0))
ATTITUDES, LIGHT = attitudes(20), np.linspace(1.0, 0.1, 20)  # body to inertial; visible share of the Sun
SUN_DIRECTION = np.array([0.6, 0.48, 0.64])  # inertial
DISTANCE = 149597870693.0  # m, Basilisk's unit, at which its heads have full scale
CASE = Comparison(
    title="Sun sensor heads without noise",
    basilisk="`CoarseSunSensor`",
    inputs="6 heads that see 60 deg, 20 attitudes, from full light to a tenth of it, 1 AU from the Sun",
    quantities={"currents": vector("currents", 6)},
    bounds={"currents": 1e-14},
)
