"""Rate gyros without noise: turned against the body, with a scale factor per axis, a bias and a range.

Without rounding: Basilisk rounds towards 0 unless a direction is set, which its Python does not offer; here to nearest.
"""

import numpy as np

from crosscheck.case import vector
from crosscheck.comparison import Comparison
from crosscheck.space.points import directions

SCALE, BIAS = (1.001, 0.999, 1.002), (1e-4, -2e-4, 3e-4)  # 1; rad/s, sensor axes
RANGE = 0.4  # rad/s
YAW, PITCH, ROLL = 0.02, -0.03, 0.01  # rad, from body to sensor axes
RATES = np.linspace(0.01, 0.6, 20)[:, None] * directions(20)  # rad/s, body; the last ones are beyond the range
CASE = Comparison(
    title="rate gyros without noise",
    basilisk="`ImuSensor`",
    inputs="20 rates to 0.6 rad/s, range 0.4 rad/s, bias, scale factors, turned by 0.04 rad",
    quantities={"rate": vector("rate")},
    bounds={"rate": 1e-14},
)
