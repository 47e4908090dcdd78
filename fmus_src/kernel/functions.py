"""Elementary functions for kernels and users: the functions of `elementary`, with the exceptions of Python's `math`.

A NaN result for arguments that are not NaN raises ValueError; an infinite result of finite arguments raises
OverflowError, or ValueError at a pole. Errors are below one unit in the last place, and results have identical bits on
every processor, in Python and in C.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, TypeVar

from .elementary import exponential, hyperbolic, inverse, logarithm, power, roots, trigonometric

F = TypeVar("F", bound=Callable)

DOMAIN_ERROR, RANGE_ERROR = "math domain error", "math range error"
EITHER_ERROR = ""  # depends on the argument

VERSION = 1  # version of the results: incremented when a change affects the bits of any function

# By function of one argument: the exception for an infinite result of a finite argument, or None if no
# result is infinite.
FAULTS: dict[Any, str | None] = {}


def _refuse(y: float, if_infinite: str) -> None:
    """Raise the exception for a result that is not finite."""
    if y == y and if_infinite == RANGE_ERROR:
        raise OverflowError(RANGE_ERROR)
    raise ValueError(DOMAIN_ERROR)


def _check_result(function: Callable[[float], float], if_infinite: str) -> Callable[[float], float]:
    """Return a function of one argument that raises an exception if the result for a finite argument is not finite."""

    @functools.wraps(function)
    def call(x: float) -> float:
        y = function(x)
        if y - y != 0.0 and (x - x == 0.0 or (x == x and y != y)):
            _refuse(y, if_infinite)
        return y

    FAULTS[function] = if_infinite
    return call


def _check_power(function: Callable[[float, float], float]) -> Callable[[float, float], float]:
    """Return a function x^y that raises an exception if the result for finite arguments is not finite."""

    @functools.wraps(function)
    def call(x: float, y: float) -> float:
        z = function(x, y)
        if z - z != 0.0 and x - x == 0.0 and y - y == 0.0:
            _refuse(z, DOMAIN_ERROR if x == 0.0 else RANGE_ERROR)
        return z

    FAULTS[function] = EITHER_ERROR
    return call


def _without_faults(function: F) -> F:
    """Register a function that needs no check: finite arguments give finite results, and only NaN gives NaN."""
    FAULTS[function] = None
    return function


sin = _check_result(trigonometric.sin, DOMAIN_ERROR)
cos = _check_result(trigonometric.cos, DOMAIN_ERROR)
tan = _check_result(trigonometric.tan, DOMAIN_ERROR)
asin = _check_result(inverse.asin, DOMAIN_ERROR)
acos = _check_result(inverse.acos, DOMAIN_ERROR)
atan = _without_faults(inverse.atan)
atan2 = _without_faults(inverse.atan2)
exp = _check_result(exponential.exp, RANGE_ERROR)
exp2 = _check_result(exponential.exp2, RANGE_ERROR)
expm1 = _check_result(exponential.expm1, RANGE_ERROR)
log = _check_result(logarithm.log, DOMAIN_ERROR)
log2 = _check_result(logarithm.log2, DOMAIN_ERROR)
log10 = _check_result(logarithm.log10, DOMAIN_ERROR)
log1p = _check_result(logarithm.log1p, DOMAIN_ERROR)
pow = _check_power(power.pow)
sinh = _check_result(hyperbolic.sinh, RANGE_ERROR)
cosh = _check_result(hyperbolic.cosh, RANGE_ERROR)
tanh = _without_faults(hyperbolic.tanh)
cbrt = _without_faults(roots.cbrt)
fmod = math.fmod  # exact by definition
