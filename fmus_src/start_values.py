"""Values with which a block starts: Reals are finite, and parameters lie between their declared bounds, tunable
ones between steps, too.

The native wrapper compares with the same numbers, `fmi/instance/start_values.h`.
"""

from __future__ import annotations

import math
import sys

from .variables import Parameter, Variable

LARGEST = sys.float_info.max  # in place of a bound that is not declared: neither infinity nor NaN lies within


class StartError(ValueError):
    """A value with which a block cannot start; the message names variable, value and bound."""


class TuningError(ValueError):
    """A variable that cannot be set between steps, or not to that value; the message says which, and why."""


def start_range(variable: Variable) -> tuple[float, float]:
    """Return the least and the largest value that an element of a parameter or an input may have at the start."""
    low, high = (variable.minimum, variable.maximum) if isinstance(variable, Parameter) else (None, None)
    return (-LARGEST if low is None else max(low, -LARGEST), LARGEST if high is None else min(high, LARGEST))


def describe_violation(name: str, number: float, low: float, high: float) -> str:
    """Return what is wrong with the value of an element, which is a float or an int, outside its range."""
    if not math.isfinite(number):
        return f"{name} = {number!r} is not finite"
    side, bound = ("below its minimum", low) if number < low else ("above its maximum", high)
    return f"{name} = {number!r} is {side} {type(number)(bound)!r}"
