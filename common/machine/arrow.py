"""Conversion of columns between numpy and Arrow without copies.

The functions replace `pyarrow.array` and `to_numpy`, which load pandas to inspect their arguments and thus take a
quarter of a second at the start of every batch.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import pyarrow


def numbers_of(values: np.ndarray) -> pyarrow.Array:
    """Return an Arrow array of numbers or Booleans of shape (n,), NaN as a number, with shared memory if possible."""
    if values.dtype == np.bool_:
        memory = np.packbits(values, bitorder="little")
    else:
        memory = np.ascontiguousarray(values)
    kind = pyarrow.from_numpy_dtype(values.dtype)
    return pyarrow.Array.from_buffers(kind, values.size, [None, pyarrow.py_buffer(memory)])


def texts_of(values: Iterable[str]) -> pyarrow.Array:
    """Return an Arrow array of texts in UTF-8."""
    encoded = [value.encode() for value in values]
    ends = np.cumsum([0, *map(len, encoded)], dtype=np.int32)
    return pyarrow.StringArray.from_buffers(
        len(encoded), pyarrow.py_buffer(ends), pyarrow.py_buffer(b"".join(encoded)), null_count=0
    )


def table_of(columns: Mapping[str, np.ndarray | pyarrow.Array | pyarrow.ChunkedArray]) -> pyarrow.Table:
    """Return an Arrow table of columns by name, with the types that the columns have in numpy."""
    arrays = [numbers_of(column) if isinstance(column, np.ndarray) else column for column in columns.values()]
    return pyarrow.Table.from_arrays(arrays, names=list(columns))


def numpy_of(column: pyarrow.ChunkedArray) -> np.ndarray:
    """Return numbers, Booleans or texts of an Arrow column as a numpy array of shape (n,); texts as objects.

    The column must not contain missing values. Numbers in a single Arrow chunk share its memory and must not be
    modified.
    """
    chunk = column.chunk(0) if column.num_chunks == 1 else column.combine_chunks()
    if pyarrow.types.is_dictionary(chunk.type):
        chunk = chunk.cast(chunk.type.value_type)
    if pyarrow.types.is_string(chunk.type) or pyarrow.types.is_large_string(chunk.type):
        coded = chunk.dictionary_encode()
        return np.array(coded.dictionary.to_pylist(), dtype=object)[np.from_dlpack(coded.indices)]
    if pyarrow.types.is_boolean(chunk.type):
        return np.from_dlpack(chunk.cast(pyarrow.uint8())).astype(np.bool_)
    return np.from_dlpack(chunk)
