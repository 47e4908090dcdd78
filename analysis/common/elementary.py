"""The elementary functions of kernels on arrays: the same text, compiled by numba, and so the same bits.

numpy and scipy choose variants of theirs by the processor. As there, a result that does not exist is NaN, one that is
too large infinite.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from types import FunctionType
from typing import Any

import numpy as np

from ...fmus_src.kernel import functions
from ...fmus_src.kernel.elementary import normal_distribution, roots

FEW = 30_000  # values that Python computes in the time that numba takes to load a function

FUNCTIONS: dict[str, Callable] = {
    **{function.__name__: function for function in functions.FAULTS},
    "hypot": roots.hypot,
    "normal_distribution": normal_distribution.normal_distribution,
    "normal_quantile": normal_distribution.normal_quantile,
}


class Elementary:
    """A function of `FUNCTIONS` for doubles and arrays of them, of any shapes that broadcast."""

    def __init__(self, name: str) -> None:
        self._kernel = FUNCTIONS[name]
        self._in_python = np.frompyfunc(self._kernel, self._kernel.__code__.co_argcount, 1)
        self._left = FEW

    def __call__(self, *arguments: Any) -> Any:
        """The values, an array or a double."""
        doubles = [np.asarray(argument, dtype=float) for argument in arguments]
        self._left -= np.broadcast(*doubles).size
        with np.errstate(all="ignore"):
            if self._left >= 0:
                return np.asarray(self._in_python(*doubles), dtype=float)[()]
            return _vectorise(self._kernel)(*doubles)


@cache
def elementary(name: str) -> Elementary:
    """The function of that name."""
    return Elementary(name)


@cache
def _vectorise(function: Callable) -> np.ufunc:
    from numba import vectorize

    from .compiler import compile_cached

    signature = f"float64({','.join(['float64'] * function.__code__.co_argcount)})"
    compiled: Any = compile_cached(_with_compiled_callees(function), partial(vectorize, [signature]))
    return compiled


def _with_compiled_callees(function: FunctionType | Callable) -> FunctionType:
    """A kernel function whose kernel functions numba has compiled: its module names them as plain Python."""
    names = {
        name: _compile(value) if isinstance(value, FunctionType) else value
        for name, value in function.__globals__.items()
        if name in function.__code__.co_names
    }
    return FunctionType(function.__code__, {**names, "__name__": function.__module__}, function.__name__)


@cache
def _compile(function: FunctionType) -> Any:
    from numba import njit

    return njit(_with_compiled_callees(function))  # kept as part of what calls it
