"""The elementary functions of kernels on arrays: the same text, translated to C, and so the same bits.

numpy and scipy choose variants of theirs by the processor. As there, a value that does not exist is NaN, one that is
too large infinite.
"""

from __future__ import annotations

import ctypes
from functools import cache
from typing import Any

import numpy as np

from .library import load_library


class Elementary:
    """A function of `write_elementary.FUNCTIONS` for doubles and arrays of them, of any shapes that broadcast."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __call__(self, *arguments: Any) -> Any:
        """Return the values, an array or a double."""
        doubles = np.broadcast_arrays(*(np.asarray(argument, dtype=float) for argument in arguments))
        columns = [np.ascontiguousarray(column) for column in doubles]
        values = np.empty(doubles[0].shape)
        compute = getattr(load_library(), f"perilune_{self._name}")
        addresses = (ctypes.c_void_p(column.ctypes.data) for column in (*columns, values))
        compute(ctypes.c_int64(values.size), *addresses)
        return values[()]


@cache
def elementary(name: str) -> Elementary:
    """Return the function of that name."""
    return Elementary(name)
