"""Columns embedded in a page: the script decodes the original values.

Truth: float32 as rounded by numpy; for 16 bits, half a step of the column's range, and the derivative of sinh.
"""

import math

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from perilune.analysis.documents.interactive.columns import Columns
from tests.support.pages.node import call

SAMPLES = 200  # of columns, decoded in one process


def decoded(columns: Columns) -> list[np.ndarray]:
    document = columns.document()
    inputs = [[document, number] for number in range(len(document["columns"]))]
    return [np.array(each, dtype=float) for each in call("page/columns.ts", "decode", inputs)]


def columns_of_all_kinds() -> list[np.ndarray]:
    generator = np.random.default_rng(8)
    random = [generator.normal(size=size) * 10.0**power for size in (1, 2, 3, 500) for power in (-40, -3, 0, 9, 37)]
    bits = [generator.integers(0, 0x7F800000, size, dtype=np.uint32).view(np.float32) for size in (1, 7, 1000)]
    special = [np.array([0.0, -0.0, math.inf, -math.inf, math.nan, 1e-45, 3.4e38, 1e300, 1.0])]
    ramps = [np.linspace(-1.0, 1.0, 4001), 0.1 * np.arange(40_000), np.zeros(0), np.full(3, 7.0), np.full(2, math.nan)]
    return [*random, *bits, *special, *ramps]


def test_float32_is_exact():
    columns = Columns()
    inputs = columns_of_all_kinds()
    indices = [columns.add(each) for each in inputs]
    outputs = decoded(columns)
    for index, numbers in zip(indices, inputs, strict=True):
        with np.errstate(over="ignore"):
            expected = numbers.astype(np.float32)
        assert np.array_equal(outputs[index], expected, equal_nan=True)


def test_sixteen_bits_are_half_a_step_from_exact():
    columns = Columns()
    inputs = columns_of_all_kinds()
    indices = [columns.add(each, coarse=True) for each in inputs]
    outputs = decoded(columns)
    for index, numbers in zip(indices, inputs, strict=True):
        with np.errstate(over="ignore"):
            column = numbers.astype(np.float32).astype(float)
        finite = np.isfinite(column)
        assert np.array_equal(np.isnan(outputs[index]), ~finite)
        if not finite.any():
            continue
        error = np.abs(outputs[index][finite] - column[finite])
        encoded = columns.encoded[index]
        if encoded["knee"]:
            slope = np.hypot(column[finite], encoded["knee"])  # of sinh
            span = np.ptp(np.arcsinh(column[finite] / encoded["knee"]))
            assert np.all(error <= np.expm1(0.5001 * span / 65534) * slope)
            assert span < 200.0  # all of float32
        else:
            assert np.max(error) <= 0.5001 * np.ptp(column[finite]) / 65534


@given(st.lists(arrays(np.float32, st.integers(0, 4)), max_size=6))
@example([np.array([0.0]), np.array([-0.0])])
def test_equal_columns_share_one(inputs):
    columns = Columns()
    indices = [columns.add(each) for each in inputs]
    for one, first in zip(inputs, indices, strict=True):
        for other, second in zip(inputs, indices, strict=True):
            assert (first == second) == (one.tobytes() == other.tobytes())
