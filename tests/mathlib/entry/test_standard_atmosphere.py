"""US standard atmosphere 1976. Truth: the published table, with five digits of density (0.01 %)."""

import math

import pytest

from perilune.fmus_src.mathlib.entry.standard_atmosphere import air

# Geometric height (km): density (kg/m3), U.S. Standard Atmosphere 1976, table I.
PUBLISHED = {
    0: 1.2250,
    1: 1.1117,
    2: 1.0066,
    3: 0.90925,
    5: 0.73643,
    7: 0.59002,
    10: 0.41351,
    15: 0.19476,
    20: 0.088910,
    25: 0.040084,
    30: 0.018410,
    35: 0.0084634,
    40: 0.0039957,
    45: 0.0019663,
    50: 0.0010269,
    55: 5.6810e-4,
    60: 3.0968e-4,
    65: 1.6321e-4,
    70: 8.2829e-5,
    75: 3.9921e-5,
    80: 1.8458e-5,
    85: 8.2196e-6,
}


@pytest.mark.parametrize("height", PUBLISHED)
def test_density(height):
    assert air(1000.0 * height).density == pytest.approx(PUBLISHED[height], rel=1.5e-4)


@pytest.mark.parametrize(("height", "speed"), [(0, 340.29), (10, 299.53), (20, 295.07), (50, 329.80), (80, 282.54)])
def test_speed_of_sound(height, speed):
    assert air(1000.0 * height).speed_of_sound == pytest.approx(speed, rel=5e-5)


def test_the_thin_air_above():
    """Tabulated at 90, 100 and 120 km, straight in the logarithm between, held beyond, without a gap at 86 km."""
    assert [air(1000.0 * h).density for h in (90, 100, 120, 130, 500)] == pytest.approx(
        [3.416e-6, 5.604e-7, 2.222e-8, 8.152e-9, 8.152e-9]
    )
    assert air(92500.0).density == pytest.approx(math.sqrt(3.416e-6 * 1.393e-6), rel=1e-12)
    assert air(86000.0 - 1e-6).density == pytest.approx(air(86000.0).density, rel=2e-4)
