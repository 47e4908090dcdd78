"""Checks of a block's start values: Reals are finite, parameters lie within their declared bounds.

Tunable parameters are checked between steps, too. The native wrapper compares with the same numbers in
`fmi/instance/start_values.h`.
"""

from __future__ import annotations

import math
import sys

from .variables import Parameter, Variable

LARGEST = sys.float_info.max  # replaces a bound that is not declared, so that infinity and NaN are always outside


class StartError(ValueError):
    """Error raised for a value with which a block cannot start; the message names variable, value and bound."""


class TuningError(ValueError):
    """Error raised for a variable, or a value, that cannot be set between steps; the message gives the reason."""


def start_range(variable: Variable) -> tuple[float, float]:
    """Return the least and largest start value allowed for an element of a parameter or input."""
    low, high = (variable.minimum, variable.maximum) if isinstance(variable, Parameter) else (None, None)
    return (-LARGEST if low is None else max(low, -LARGEST), LARGEST if high is None else min(high, LARGEST))


def describe_violation(name: str, number: float, low: float, high: float) -> str:
    """Return a text that describes how the value of an element, a float or int, violates its range."""
    if not math.isfinite(number):
        return f"{name} = {number!r} is not finite"
    side, bound = ("below its minimum", low) if number < low else ("above its maximum", high)
    return f"{name} = {number!r} is {side} {type(number)(bound)!r}"
