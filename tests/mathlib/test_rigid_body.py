"""`fmus_src.mathlib.rigid_body` against numpy's products."""

import numpy as np
import pytest
from fmus_src.mathlib.rigid_body import total_momentum
from hypothesis import given
from hypothesis import strategies as st

from fmus_src.mathlib.vectors import cross

vectors = st.lists(st.floats(-1e3, 1e3), min_size=3, max_size=3)


@given(vectors, vectors)
def test_cross(a, b):
    product = [0.0] * 3
    cross(a, b, product)
    assert product == np.cross(a, b).tolist()
    first = list(a)
    cross(first, b, first)
    assert first == product


@given(vectors, vectors, vectors)
def test_total_momentum(inertia, rate, gyros):
    total = [0.0] * 3
    total_momentum(inertia, rate, gyros, total)
    assert total == pytest.approx(np.diag(inertia) @ rate + gyros, rel=1e-15, abs=1e-9)
