"""Polynomials in the sources equal the results of their derivation."""

from types import ModuleType

import pytest

from perilune.fmus_src.kernel.elementary import (
    exponential,
    hyperbolic,
    inverse,
    logarithm,
    normal_distribution,
    roots,
    trigonometric,
)
from tests.kernel.coefficients import APPROXIMATIONS, Approximation

HOMES: tuple[ModuleType, ...] = (exponential, hyperbolic, inverse, logarithm, normal_distribution, roots, trigonometric)
# two exact steps follow CBRT; TAIL is a whole function, whose first coefficient is rounded
WORST = {"CBRT": 1e-5, "TAIL": 1.2e-16}


@pytest.mark.parametrize("approximation", APPROXIMATIONS, ids=lambda case: case.name)
def test_sources_have_the_derived_coefficients(approximation: Approximation) -> None:
    prefix = f"{approximation.name}_"
    named = {name: value for home in HOMES for name, value in vars(home).items() if name.startswith(prefix)}
    in_source = [named[f"{prefix}{number}"] for number in range(approximation.terms)]
    assert in_source == approximation.derive()
    assert approximation.worst_error(in_source) < WORST.get(approximation.name, 2e-17)
