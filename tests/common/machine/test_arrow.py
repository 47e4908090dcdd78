"""perilune.common.machine.arrow: columns between numpy and Arrow.

Truth: pyarrow's conversions, which load pandas.
"""

import numpy as np
import pyarrow
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from perilune.common.machine.arrow import numbers_of, numpy_of, table_of, texts_of

KINDS = st.sampled_from([np.float64, np.int64, np.int32, np.uint32, np.bool_])
columns = KINDS.flatmap(lambda kind: arrays.arrays(kind, st.integers(0, 40)))


@given(columns, st.integers(1, 3))
def test_numbers_are_those_that_pyarrow_makes(values, step):
    values = values[::step]  # not side by side
    created = numbers_of(values)
    created.validate(full=True)
    assert created.null_count == 0
    assert created.type == pyarrow.array(values).type
    np.testing.assert_array_equal(created.to_numpy(zero_copy_only=False), values)


@given(st.lists(st.text(), max_size=20))
def test_texts_are_those_that_pyarrow_makes(values):
    created = texts_of(values)
    created.validate(full=True)
    assert created.equals(pyarrow.array(values, pyarrow.string()))


@given(columns, st.integers(0, 3), st.integers(0, 10), st.integers(0, 40))
def test_numbers_come_back_whatever_their_pieces(values, pieces, first, count):
    column = pyarrow.chunked_array([pyarrow.array(values)] * pieces, pyarrow.array(values).type).slice(first, count)
    actual = numpy_of(column)
    assert actual.dtype == values.dtype
    np.testing.assert_array_equal(actual, np.tile(values, pieces)[first : first + count])


@given(st.lists(st.text(), max_size=20), st.integers(0, 3), st.integers(0, 5))
def test_texts_come_back_whatever_their_pieces(values, pieces, first):
    column = pyarrow.chunked_array([pyarrow.array(values, pyarrow.string())] * pieces, pyarrow.string()).slice(first)
    actual = numpy_of(column)
    assert actual.dtype == object
    assert actual.tolist() == (values * pieces)[first:]


def test_a_table_has_its_columns_in_order():
    table = table_of({"b": np.arange(3), "a": texts_of("xyz"), "c": np.array([True, False, True])})
    expected = pyarrow.table({"b": np.arange(3), "a": ["x", "y", "z"], "c": [True, False, True]})
    assert table.equals(expected)
