"""Elementary functions of arrays, in the C code that FMUs contain, and therefore with the same bits.

numpy and scipy choose implementations by processor. As in these libraries, undefined values are NaN, and an overflow is
infinite.
"""

from __future__ import annotations

import ctypes
from functools import cache
from typing import Any

import numpy as np

from .library import load_library


class Elementary:
    """Function of `write_elementary.FUNCTIONS` for doubles and broadcastable arrays of doubles."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __call__(self, *arguments: Any) -> Any:
        """Return the function values: a double, or an array if an argument is an array."""
        doubles = np.broadcast_arrays(*(np.asarray(argument, dtype=float) for argument in arguments))
        columns = [np.ascontiguousarray(column) for column in doubles]
        values = np.empty(doubles[0].shape)
        compute = getattr(load_library(), f"perilune_{self._name}")
        addresses = (ctypes.c_void_p(column.ctypes.data) for column in (*columns, values))
        compute(ctypes.c_int64(values.size), *addresses)
        return values[()]


@cache
def elementary(name: str) -> Elementary:
    """Return the elementary function with this name."""
    return Elementary(name)
