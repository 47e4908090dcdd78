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

from ...fmus_src.kernel.elementary import (
    exponential,
    inverse,
    logarithm,
    normal_distribution,
    power,
    roots,
    trigonometric,
)

FUNCTIONS: dict[str, Callable] = {
    "sin": trigonometric.sin,
    "cos": trigonometric.cos,
    "tan": trigonometric.tan,
    "asin": inverse.asin,
    "acos": inverse.acos,
    "atan": inverse.atan,
    "atan2": inverse.atan2,
    "exp": exponential.exp,
    "log": logarithm.log,
    "log10": logarithm.log10,
    "pow": power.pow,
    "hypot": roots.hypot,
    "normal_distribution": normal_distribution.normal_distribution,
    "normal_quantile": normal_distribution.normal_quantile,
}


def elementary(name: str) -> Callable[..., Any]:
    """The function of `FUNCTIONS` of that name, for doubles and arrays of them (any shapes that broadcast)."""

    def call(*arguments: Any) -> Any:
        with np.errstate(all="ignore"):
            return _vectorised(name)(*arguments)

    return call


@cache
def _vectorised(name: str) -> np.ufunc:
    """Compiled at the first call: numba takes half a second to import."""
    from numba import vectorize

    from .compiler import compile_cached

    function = FUNCTIONS[name]
    signature = f"float64({','.join(['float64'] * function.__code__.co_argcount)})"
    compiled: Any = compile_cached(_with_compiled_callees(function), partial(vectorize, [signature]))
    return compiled


def _with_compiled_callees(function: FunctionType | Callable) -> FunctionType:
    """A kernel function whose kernel functions numba has compiled: its module names them as plain Python."""
    names = {
        name: _compiled(value) if isinstance(value, FunctionType) else value
        for name, value in function.__globals__.items()
        if name in function.__code__.co_names
    }
    return FunctionType(function.__code__, {**names, "__name__": function.__module__}, function.__name__)


@cache
def _compiled(function: FunctionType) -> Any:
    from .compiler import compile_cached

    return compile_cached(_with_compiled_callees(function))
