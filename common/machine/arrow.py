"""Conversion of columns between numpy and Arrow without copies.

`pyarrow.array` and `to_numpy` load pandas to inspect their arguments, which takes a quarter of a second at the start of
every batch.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import pyarrow


def numbers_of(values: np.ndarray) -> pyarrow.Array:
    """Return numbers or Booleans (n,) without missing values; NaN is a number. Memory is shared if possible."""
    if values.dtype == np.bool_:
        memory = np.packbits(values, bitorder="little")
    else:
        memory = np.ascontiguousarray(values)
    kind = pyarrow.from_numpy_dtype(values.dtype)
    return pyarrow.Array.from_buffers(kind, values.size, [None, pyarrow.py_buffer(memory)])


def texts_of(values: Iterable[str]) -> pyarrow.Array:
    """Return texts in UTF-8 without missing values."""
    encoded = [value.encode() for value in values]
    ends = np.cumsum([0, *map(len, encoded)], dtype=np.int32)
    return pyarrow.StringArray.from_buffers(
        len(encoded), pyarrow.py_buffer(ends), pyarrow.py_buffer(b"".join(encoded)), null_count=0
    )


def table_of(columns: Mapping[str, np.ndarray | pyarrow.Array | pyarrow.ChunkedArray]) -> pyarrow.Table:
    """Return a table of columns by name, with the same types as in numpy."""
    arrays = [numbers_of(column) if isinstance(column, np.ndarray) else column for column in columns.values()]
    return pyarrow.Table.from_arrays(arrays, names=list(columns))


def numpy_of(column: pyarrow.ChunkedArray) -> np.ndarray:
    """Return numbers, Booleans or texts (n,) without missing values; texts as objects.

    Numbers in a single Arrow chunk share its memory, and must not be written to.
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
