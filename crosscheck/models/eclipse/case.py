"""Light of the Sun behind the Earth: in the shadow, the half-shadow, beyond the shadow's end, by day."""

import numpy as np

from crosscheck.comparison import Comparison

SUN = np.array([1.2e11, 8.0e10, 3.9e10])  # m, from the Earth's centre
SUN_RADIUS, EARTH_RADIUS = 695000e3, 6378136.6  # m, those of Basilisk
ALONG = SUN / np.linalg.norm(SUN)
ACROSS = np.cross(ALONG, [0.0, 0.0, 1.0]) / np.linalg.norm(np.cross(ALONG, [0.0, 0.0, 1.0]))
HEIGHTS = np.linspace(6.36e6, 6.40e6, 61)  # m, of the ray above the axis of the shadow
POINTS = np.vstack([
    HEIGHTS[:, None] * ACROSS - 2e6 * ALONG,  # low orbit
    (HEIGHTS + 3e5 * np.linspace(-1.0, 1.0, HEIGHTS.size))[:, None] * ACROSS - 4.2e7 * ALONG,  # geostationary
    [-7e6 * ALONG, 7e6 * ALONG, 7e6 * ACROSS, -1.6e9 * ALONG],
])  # fmt: skip
CASE = Comparison(
    title="eclipse",
    basilisk="`Eclipse`",
    inputs=f"{len(POINTS)} points through the half-shadow at 2e6 and 4.2e7 m, in the shadow, before it and beyond its "
    "end; Basilisk's radii of Sun and Earth",
    quantities={"light": ("light[1]",)},
    bounds={"light": 5e-9},
)
