"""Cubic splines. Truth: scipy's splines, to rounding."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from perilune.fmus_src.kernel.matrices import Matrix, zeros
from perilune.fmus_src.mathlib.cubic_spline import cubic_value, curvatures


@given(st.integers(0, 2**32 - 1), st.integers(3, 20), st.booleans(), st.floats(-0.5, 1.5))
def test_splines(seed, n, clamped, place):
    step, curves = 0.3, np.random.default_rng(seed).normal(size=(2, n))
    second = zeros(2, n)
    values = Matrix(curves.tolist())
    for number in range(2):
        curvatures(values, number, n, step, clamped, second)
    x = place * step * (n - 1)
    for number, curve in enumerate(curves):
        knots = step * np.arange(n)
        truth = CubicSpline(knots, curve, bc_type=((1, 0.0) if clamped else (2, 0.0), (2, 0.0)))
        expected = float(truth(min(max(x, 0.0), knots[-1])))
        assert cubic_value(values, second, number, n, step, x) == pytest.approx(expected, abs=1e-12)
