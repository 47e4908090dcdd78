"""Density of the upper atmosphere, exponential in height between the rows of a table. Kernel functions.

Source: Vallado 2013, table 8-4.
"""

from ...kernel.functions import exp

ROWS = 19

HEIGHT = (  # km
    100.0, 110.0, 120.0, 130.0, 140.0, 150.0, 180.0, 200.0, 250.0, 300.0, 350.0, 400.0, 450.0, 500.0, 600.0,
    700.0, 800.0, 900.0, 1000.0,
)  # fmt: skip
DENSITY = (  # kg/m3
    5.297e-07, 9.661e-08, 2.438e-08, 8.484e-09, 3.845e-09, 2.07e-09, 5.464e-10, 2.789e-10, 7.248e-11, 2.418e-11,
    9.518e-12, 3.725e-12, 1.585e-12, 6.967e-13, 1.454e-13, 3.614e-14, 1.17e-14, 5.245e-15, 3.019e-15,
)  # fmt: skip
SCALE_HEIGHT = (  # km
    5.877, 7.263, 9.473, 12.636, 16.149, 22.523, 29.74, 37.105, 45.546, 53.628, 53.298, 58.515, 60.828, 63.822,
    71.835, 88.667, 124.64, 181.05, 268.0,
)  # fmt: skip


def exponential_density(h: float) -> float:
    """Return the density (kg/m3) at a height h (m); constant below 100 km, extrapolated above 1000 km."""
    kilometres = 1e-3 * h
    if kilometres < HEIGHT[0]:
        return DENSITY[0]
    k = 0
    while k < ROWS - 1 and kilometres >= HEIGHT[k + 1]:
        k = k + 1
    return DENSITY[k] * exp((HEIGHT[k] - kilometres) / SCALE_HEIGHT[k])
