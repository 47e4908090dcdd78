"""Heights and densities. Truth: the same formulas in another program, and the rows of the published tables."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.mathlib.space import exponential_atmosphere, harris_priester
from perilune.fmus_src.mathlib.space.ephemerides import sun_position
from perilune.fmus_src.mathlib.space.geodetic import (
    ECCENTRICITY_SQUARED,
    EQUATORIAL_RADIUS,
    geodetic_height,
)
from perilune.fmus_src.mathlib.vectors import vector

EXPONENTIAL = {150: 2.07e-09, 225: 1.4217940148293663e-10, 410: 3.1398357840164125e-12, 500: 6.967e-13,
               777: 1.516488408101019e-14}  # fmt: skip
# Position (m) for height and bulge, exponent, density (kg/m3), with the Sun of 2026-03-20.
BULGE = [
    ((6878137.0, 0.0, 0.0), 4.0, 1.8310217452248255e-12),
    ((-6e6, 2.5e6, 2e6), 6.0, 1.4745157849342051e-12),
    ((1e6, -6.5e6, 1.2e6), 4.0, 1.6169012396024062e-11),
]


def height(position):
    return geodetic_height(float(np.hypot(position[0], position[1])), position[2])


@given(st.floats(-np.pi / 2, np.pi / 2), st.floats(1e5, 1.5e6))
def test_height(latitude, h):
    """The point at a latitude and height above the ellipsoid has this height again."""
    n = EQUATORIAL_RADIUS / np.sqrt(1.0 - ECCENTRICITY_SQUARED * np.sin(latitude) ** 2)
    out, up = (n + h) * np.cos(latitude), (n * (1.0 - ECCENTRICITY_SQUARED) + h) * np.sin(latitude)
    assert geodetic_height(float(out), float(up)) == pytest.approx(h, abs=1e-8)


@pytest.mark.parametrize("kilometres", EXPONENTIAL)
def test_exponential(kilometres):
    density = exponential_atmosphere.exponential_density(1000.0 * kilometres)
    assert density == pytest.approx(EXPONENTIAL[kilometres], rel=1e-12)


@pytest.mark.parametrize(("position", "exponent", "density"), BULGE)
def test_harris_priester(position, exponent, density):
    sun = np.array(sun_position(827301600.0).elements())
    fraction = harris_priester.bulge_fraction(vector(*position), vector(*(sun / np.linalg.norm(sun))), exponent)
    assert harris_priester.harris_priester_density(height(position), fraction) == pytest.approx(density, rel=1e-11)


@pytest.mark.parametrize("k", range(harris_priester.ROWS - 1))
def test_rows_of_harris_priester(k):
    h = 1000.0 * harris_priester.HEIGHT[k]
    assert harris_priester.harris_priester_density(h, 0.0) == pytest.approx(
        1e-12 * harris_priester.LOWEST[k], rel=1e-12
    )
    assert harris_priester.harris_priester_density(h, 1.0) == pytest.approx(
        1e-12 * harris_priester.HIGHEST[k], rel=1e-12
    )


def test_ends():
    assert harris_priester.harris_priester_density(5e4, 0.0) == harris_priester.harris_priester_density(1e5, 0.0)
    assert harris_priester.harris_priester_density(1e6, 1.0) == 0.0
    assert exponential_atmosphere.exponential_density(5e4) == exponential_atmosphere.DENSITY[0]
    # Scale height of the row at 1000 km, which is continued.
    ratio = exponential_atmosphere.exponential_density(1.268e6) / exponential_atmosphere.exponential_density(1e6)
    assert ratio == pytest.approx(np.exp(-1.0), rel=1e-12)
