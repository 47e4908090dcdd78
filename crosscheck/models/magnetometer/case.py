"""A magnetometer without noise: turned against the body, with a scale factor, a bias and a range."""

import numpy as np

from crosscheck.case import vector
from crosscheck.comparison import Comparison
from crosscheck.space.points import directions

SCALE, BIAS, RANGE = 1.003, (2e-7, -1e-7, 3e-7), 4.5e-5  # 1; T, sensor axes; T
YAW, PITCH, ROLL = 0.02, -0.03, 0.01  # rad, from body to sensor axes
FIELDS = np.linspace(2e-5, 6e-5, 20)[:, None] * directions(20)  # T, body; the last ones are beyond the range
CASE = Comparison(
    title="magnetometer without noise",
    basilisk="`Magnetometer`",
    inputs="20 fields to 6e-5 T, range 4.5e-5 T, bias, scale factor, turned by 0.04 rad",
    quantities={"field": vector("field")},
    bounds={"field": 1e-14},
)
