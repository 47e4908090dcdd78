"""GOST 4401-81 atmosphere. Truth: printed rows of geometric height and density; pressure over R T in isothermal layers.

The function has no knots at these rows, except at 100 and 120 km.
"""

import pytest

from perilune.fmus_src.mathlib.entry.gost_atmosphere import gost_air
from perilune.fmus_src.mathlib.entry.standard_atmosphere import air

# Height (km): density (kg/m3) as printed.
PUBLISHED = {
    93: 2.00484e-6, 97: 9.64450e-7, 99: 6.65312e-7, 100: 5.54951e-7, 102: 3.89128e-7, 103: 3.27067e-7, 105: 2.26166e-7,
    107: 1.55121e-7, 109: 1.09860e-7, 111: 7.99116e-8, 115: 4.51814e-8, 118: 3.08814e-8, 120: 2.44041e-8,
    123: 1.83438e-8, 128: 1.15819e-8,
}  # fmt: skip
# Height (km): pressure (Pa) as printed, at 186.65 K.
COLD = {88: 0.261501, 90: 0.183140, 92: 0.128308}
# Height (km): rounded rows of another transcription.
ROUNDED = {0: 1.225, 2: 1.007, 5: 0.736, 10: 0.414, 15: 0.195, 50: 1.027e-3, 100: 5.55e-7, 120: 2.44e-8}


@pytest.mark.parametrize("height", PUBLISHED)
def test_density(height):
    assert gost_air(1000.0 * height).density == pytest.approx(PUBLISHED[height], rel=8e-3 if height > 94 else 2e-4)


@pytest.mark.parametrize("height", COLD)
def test_the_isothermal_layer(height):
    gas = gost_air(1000.0 * height)
    assert gas.density == pytest.approx(COLD[height] / (287.05287 * 186.65), rel=2e-4)
    assert gas.speed_of_sound == pytest.approx((1.4 * 287.05287 * 186.65) ** 0.5, rel=1e-6)


@pytest.mark.parametrize("height", ROUNDED)
def test_other_rows(height):
    assert gost_air(1000.0 * height).density == pytest.approx(ROUNDED[height], rel=2e-3)


@pytest.mark.parametrize("height", [0.0, 30000.0, 70000.0, 85900.0])
def test_below_it_is_the_us_standard(height):
    assert gost_air(height) == air(height)


def test_there_are_no_gaps():
    """At the end of the layers, at the first row of the table, and held beyond the last."""
    for height in (86152.0, 94000.0):
        assert gost_air(height - 0.5).density == pytest.approx(gost_air(height + 0.5).density, rel=3e-4)
    assert gost_air(5e5).density == 9.68064e-9


def test_it_is_thicker_at_120_km():
    assert gost_air(120000.0).density / air(120000.0).density == pytest.approx(2.44041e-8 / 2.222e-8, rel=1e-12)
    assert gost_air(120000.0).density / air(120000.0).density == pytest.approx(1.098, abs=5e-4)


@pytest.mark.parametrize("height", range(25, 101))
def test_it_differs_from_the_us_standard_by_a_hundredth_at_most(height):
    assert gost_air(1000.0 * height).density == pytest.approx(air(1000.0 * height).density, rel=0.01)
