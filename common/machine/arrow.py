"""Columns between numpy and Arrow by their memory.

`pyarrow.array` and `to_numpy` load pandas to look at what they are given, a quarter of a second of every batch's start.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import pyarrow


def numbers_of(values: np.ndarray) -> pyarrow.Array:
    """Numbers or truths (n,), none of which is missing; NaN is a number. The memory is shared where it can be."""
    if values.dtype == np.bool_:
        memory = np.packbits(values, bitorder="little")
    else:
        memory = np.ascontiguousarray(values)
    kind = pyarrow.from_numpy_dtype(values.dtype)
    return pyarrow.Array.from_buffers(kind, values.size, [None, pyarrow.py_buffer(memory)])


def texts_of(values: Iterable[str]) -> pyarrow.Array:
    """Texts, in UTF-8, none of which is missing."""
    encoded = [value.encode() for value in values]
    ends = np.cumsum([0, *map(len, encoded)], dtype=np.int32)
    return pyarrow.StringArray.from_buffers(
        len(encoded), pyarrow.py_buffer(ends), pyarrow.py_buffer(b"".join(encoded)), null_count=0
    )


def table_of(columns: Mapping[str, np.ndarray | pyarrow.Array]) -> pyarrow.Table:
    """A table of columns by name, numbers as they are in numpy."""
    arrays = [column if isinstance(column, pyarrow.Array) else numbers_of(column) for column in columns.values()]
    return pyarrow.Table.from_arrays(arrays, names=list(columns))


def numpy_of(column: pyarrow.ChunkedArray) -> np.ndarray:
    """Numbers, truths or texts (n,), none of which is missing; texts as objects.

    Numbers that are one piece in Arrow are shared, and not to be written.
    """
    piece = column.chunk(0) if column.num_chunks == 1 else column.combine_chunks()
    if pyarrow.types.is_string(piece.type):
        coded = piece.dictionary_encode()
        return np.array(coded.dictionary.to_pylist(), dtype=object)[np.from_dlpack(coded.indices)]
    if pyarrow.types.is_boolean(piece.type):
        return np.from_dlpack(piece.cast(pyarrow.uint8())).astype(np.bool_)
    return np.from_dlpack(piece)
