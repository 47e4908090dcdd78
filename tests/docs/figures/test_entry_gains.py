"""Gains of the capsule: stored values equal the computed table; poles; numbers from another program.

Truth: eigenvalues of the closed loop (1e-6), and gains and norms from another program, to the digits printed.
"""

import numpy as np
import pytest

from docs.figures.entry_gains import (
    DESIGN_PRESSURE,
    LOWER,
    SCHEDULE,
    SYSTEM,
    UPPER,
    entry_gains,
    gain_files,
    gain_parameters,
    plant,
    sideslip_block,
    sideslip_moments,
    whole_gain,
    whole_model,
)
from perilune import modal
from perilune.fmus_src.control.output_feedback import OutputFeedback

POLES = [-0.7 - 0.8j, -0.7 + 0.8j, -0.6, -0.35]
NORMS = {"direct1": 2424.0, "direct0": 4459.0, "dual_a": 3823.0, "dual_b": 6375.0}


@pytest.fixture(scope="module")
def gains():
    return entry_gains()


def closed_poles(gain, pressure):
    a, b, c = plant(pressure)
    return np.sort_complex(np.linalg.eigvals(a + b @ gain @ c))


def test_stored_parameter_sets_are_what_the_table_gives():
    for file, content in gain_files().items():
        assert (SYSTEM / file).read_bytes() == content, file


def test_the_default_of_the_block_is_direct1(gains):
    values = gain_parameters("direct1", gains["direct1"])
    block = OutputFeedback()
    assert [*block.pressures, *block.gains.elements()] == list(values.values())


def test_moments_of_the_air():
    """M q with (0.0527, -1.061): sideslip swings with w^2 = 8.018e-4 q."""
    assert sideslip_moments() == (0.0527, -1.061)
    a, _, _ = plant(1.0)
    assert -np.array([a[1, 2], a[1, 3]]) @ a[2:, 1] == pytest.approx(8.018e-4, rel=1e-4)


@pytest.mark.parametrize("name", NORMS)
def test_poles_and_norms(gains, name):
    assert closed_poles(gains[name], DESIGN_PRESSURE) == pytest.approx(POLES, abs=1e-6)
    assert np.linalg.norm(gains[name]) == pytest.approx(NORMS[name], abs=1.0)


def test_some_gains(gains):
    """To the digits printed."""
    assert gains["direct1"][0] == pytest.approx([-335.2711, -1260.9402, -890.1654], abs=6e-5)
    assert gains["dual_b"][1] == pytest.approx([4.9372, 1182.2370, -3629.7474], abs=6e-5)
    assert gains["scheduled"][4] == pytest.approx([-267.4719, -809.8999, -1586.3189], abs=6e-5)


def test_scheduled_poles_follow_the_pressure(gains):
    for number, pressure in enumerate(SCHEDULE):
        gain = gains["scheduled"][2 * number : 2 * number + 2]
        expected = np.sort_complex([*np.linalg.eigvals(sideslip_block(pressure)), -0.35, -0.6])
        assert closed_poles(gain, pressure) == pytest.approx(expected, abs=1e-6)


def test_the_robust_gain_is_in_the_set_of_every_pressure():
    """Generalised Ackermann: N_1 without the pressure, which N_0 alone holds."""
    robust = np.array([[-325.472, -1276.363, -299.691], [-97.484, -244.495, -468.357]])
    actual = []
    for pressure in (200.0, 1147.0, 8000.0):
        a, b, c = plant(pressure)
        actual.append(modal.polynomial_of_gain(a, b, -robust @ c))
    for coefficients in actual:
        assert coefficients[1] == pytest.approx(np.array([[0.9194, 0.2692], [0.1855, 0.3806]]), abs=6e-5)
    assert np.abs(actual[0][0] - actual[1][0]).max() > 0.1


def test_the_whole_model_needs_a_gain_that_nobody_would_fly():
    """|F| is 1.6e6 in another program; the poles are where they were put, the double one to the root of rounding."""
    a, b, c = whole_model()
    gain = whole_gain()
    assert np.linalg.norm(gain) == pytest.approx(1.6e6, rel=0.02)
    desired = np.sort_complex([*np.diag(UPPER), *LOWER])
    assert np.sort_complex(np.linalg.eigvals(a + b @ gain @ c)) == pytest.approx(desired, abs=1e-6)
