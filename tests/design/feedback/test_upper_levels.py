"""Output feedback through the upper levels.

Truth: eigenvalues of A + B F C by numpy; for the example without a decoupled solution, the coefficients of its
characteristic polynomial.
"""

from __future__ import annotations

import contextlib

import numpy as np
import pytest

from perilune import modal
from perilune.analysis.design.feedback.upper_levels import UpperLevels
from perilune.analysis.design.poles.spectrum import Spectrum
from perilune.analysis.design.poles.zeroth_level import ZerothLevel
from tests.support.lengths import either
from tests.support.modal.draws import EPS, kappa_of, pole_error, random_spectrum, random_systems

SIZES = either(
    {(8, 3, 4): 20, (7, 3, 3): 12, (5, 2, 3): 50, (5, 3, 2): 50, (6, 3, 4): 50, (4, 2, 3): 50},
    {(8, 3, 4): 1, (5, 2, 3): 2, (5, 3, 2): 3, (6, 3, 4): 5, (4, 2, 3): 5},
)
EXPECTED_SHARE = {(8, 3, 4): 0.75, (7, 3, 3): 0.7}  # not every plant is placed from 20 starts


@pytest.mark.parametrize(("size", "count"), SIZES.items())
def test_places_every_draw(size: tuple[int, int, int], count: int) -> None:
    placed = 0
    for a, b, c, poles in random_systems(count, *size, most_pairs=2, seed=30):
        with contextlib.suppress(modal.PlacementError):
            actual = modal.output_feedback_upper(a, b, c, poles)
            placed += 1
            loop = a + b @ actual.gain @ c
            bound = 1e4 * EPS * kappa_of(loop) * np.linalg.norm(loop, 2) * (1.0 + (actual.condition_x or 1.0))
            assert pole_error(loop, poles) <= bound
    assert placed >= EXPECTED_SHARE.get(size, 1.0) * count


def gap() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a mass, and one on a spring of which only the speed is measured."""
    a = np.zeros((4, 4))
    a[0, 2] = a[1, 3] = 1.0
    a[3, 1] = -0.5
    return a, np.eye(4)[:, 2:], np.eye(4)[[0, 2, 3]]


@pytest.mark.parametrize("method", ["direct", "dual"])
def test_what_a_diagonal_upper_level_does_not_reach(method: str) -> None:
    """Real poles: the diagonal Phi_1 leaves the spring to its own speed, s^2 + f s + 1/2; a turned one does not."""
    poles = [-1.0, -2.0, -3.0, -4.0]
    with pytest.raises(modal.PlacementError, match="not observable"):
        modal.output_feedback(*gap(), poles, method=method, choice="least_norm")
    a, b, c = gap()
    actual = modal.output_feedback_upper(a, b, c, poles)
    assert pole_error(a + b @ actual.gain @ c, poles) < 1e-10
    assert abs(actual.gain[0, 2] * actual.gain[1, 0]) > 1.0  # one mass is led by the other


def test_a_class_that_the_zeroth_level_alone_refuses() -> None:
    """m + p = 7 < 8 and m p = 12."""
    ((a, b, c, poles),) = random_systems(1, 8, 3, 4, most_pairs=2, seed=31)
    with pytest.raises(modal.PlacementError, match="= 7 must not be less than n"):
        modal.output_feedback(a, b, c, poles)
    actual = modal.output_feedback_upper(a, b, c, poles)
    assert pole_error(a + b @ actual.gain @ c, poles) < 1e-8
    assert actual.gain.shape == (3, 4)


def test_divisors_of_zero_are_not_noticed_above() -> None:
    """K_1 + N W: the upper level keeps its poles for any numbers, and X changes."""
    random = np.random.default_rng(73)
    for a, b, c, _ in random_systems(5, 5, 3, 3, seed=32):
        upper = Spectrum.of(random_spectrum(random, 2, 0), 2)
        level = ZerothLevel(a, b, c)
        family = UpperLevels(level, upper)
        assert family.size == family.family.parameters + 1 * 2
        first, second = random.normal(size=(2, family.size))
        second[: family.family.parameters] = first[: family.family.parameters]
        state, driven = level.above
        for free in (first, second):
            assert pole_error(state + driven @ family.gain(free), upper.poles) < 1e-9
            np.testing.assert_allclose(-family.feedback(free).gain, family.gain(free), rtol=0.0, atol=1e-9)
        change = family.gain(first) - family.gain(second)
        assert np.abs(driven @ change).max() < 1e-12 < np.abs(change).max()
        assert (
            np.abs(level.lower_matrices(family.gain(first))[1] - level.lower_matrices(family.gain(second))[1]).max()
            > 1e-3
        )


@pytest.mark.parametrize(
    ("size", "options", "message"),
    [
        ((6, 2, 2), {}, "F has m p = 2 x 2 = 4 elements, too few to place n = 6 poles"),
        ((4, 2, 3), {"starts": 0}, "starts"),
        ((4, 4, 2), {}, "drives every state"),
        ((4, 2, 4), {}, "measures every state"),
        ((4, 2, 3), {"upper": [-9.0, -8.0]}, "not one of the poles"),
    ],
)
def test_refusals(size: tuple[int, int, int], options: dict, message: str) -> None:
    ((a, b, c, _),) = random_systems(1, *size, seed=33)
    with pytest.raises(ValueError, match=message):
        modal.output_feedback_upper(a, b, c, [-float(k) for k in range(1, size[0] + 1)], **options)


def test_pairs_that_do_not_leave_an_odd_number() -> None:
    ((a, b, c, _),) = random_systems(1, 4, 3, 2, seed=34)
    with pytest.raises(modal.PlacementError, match="which would split one of 2 conjugate pairs"):
        modal.output_feedback_upper(a, b, c, [-1 + 1j, -1 - 1j, -2 + 1j, -2 - 1j])
