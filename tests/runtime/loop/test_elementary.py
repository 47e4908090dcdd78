"""The elementary functions on arrays.

Truth: the same functions in Python, value by value, to the last bit; Python's are compared with mpmath in tests/kernel.
"""

from __future__ import annotations

import numpy as np
import pytest

from perilune.analysis.runtime.loop.elementary import elementary
from perilune.analysis.runtime.loop.write_elementary import FUNCTIONS
from tests.kernel.arguments import DRAWS, edges, samples
from tests.support.lengths import generator

COUNT = 1000
SAME_ARGUMENTS = {"hypot": "atan2", "normal_distribution": "expm1", "normal_quantile": "asin"}


def bits(values: list[float] | np.ndarray) -> list[str]:
    return ["nan" if np.isnan(value) else float(value).hex() for value in values]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_arrays_have_the_bits_of_numbers(name: str) -> None:
    arguments = SAME_ARGUMENTS.get(name, name)
    assert arguments in DRAWS
    rows = samples(arguments, COUNT, generator(name)) + edges(arguments)
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    expected = bits([FUNCTIONS[name](*row) for row in rows])
    assert bits(elementary(name)(*columns)) == expected


def test_shapes_broadcast_and_whole_numbers_become_doubles() -> None:
    whole = elementary("pow")(np.array([[1], [2], [3]]), np.array([0, 1, 2, 3]))
    assert whole.tolist() == [[1.0] * 4, [1.0, 2.0, 4.0, 8.0], [1.0, 3.0, 9.0, 27.0]]
    assert float(elementary("hypot")(3, 4)) == 5.0


def test_what_does_not_exist_is_nan_and_too_large_infinite() -> None:
    with np.errstate(all="raise"):
        assert np.isnan(elementary("log")(np.array([-1.0]))).all()
        assert elementary("exp")(1e3) == np.inf
