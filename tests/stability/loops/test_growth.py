"""Growth of a disturbance. Truth: solutions of difference equations with a known factor per sample."""

import numpy as np
import pytest

from perilune.analysis.stability.loops.growth import growth_to_overflow, steady_growth

SAMPLES = np.arange(4000.0)


@pytest.mark.parametrize("radius", [1.0005, 1.0025, 1.02])
@pytest.mark.parametrize("angle", [0.0, 0.3, 2.9])
def test_a_mode_outside_of_the_unit_circle(radius, angle):
    deviation = 1e-3 * radius**SAMPLES * np.cos(angle * SAMPLES)
    assert steady_growth(deviation) == pytest.approx(radius, abs=1e-5)


@pytest.mark.parametrize(
    "deviation",
    [
        np.cos(0.3 * SAMPLES),
        0.999**SAMPLES,
        1.0 - 0.999**SAMPLES,
        SAMPLES,
        SAMPLES**2,
        SAMPLES**3,
        np.zeros(4000),
        np.where(SAMPLES > 3000.0, 1.0, 0.0),
        np.random.default_rng(1).standard_normal(4000),
    ],
    ids=["forced", "decaying", "settling", "drift", "double integrator", "cube", "nothing", "step", "noise"],
)
def test_what_does_not_grow_by_a_factor(deviation):
    assert steady_growth(deviation) is None


@pytest.mark.parametrize("radius", [1.45, 21.0, 1e30])
def test_a_mode_that_overflows(radius):
    """Behind an offset that hides it at first."""
    with np.errstate(over="ignore"):
        deviation = 5.0 + 1e-6 * radius ** np.arange(3000.0)
    assert growth_to_overflow(deviation) == pytest.approx(radius, rel=0.15)


@pytest.mark.parametrize("last", [np.inf, np.nan])
def test_a_singular_end_is_no_growth(last):
    """As of a command that is divided by the time that is left."""
    deviation = np.append(1.0 / np.arange(1000.0, 0.0, -1.0), last)
    assert growth_to_overflow(deviation) is None
    assert growth_to_overflow(np.array([last])) is None
