"""Declaration of a variable as text: name with size, start values, bounds."""

from __future__ import annotations

from ..variables import Variable

SHOWN = 12  # most start values of a list that are shown; of longer lists only the first ones are


def sized_name(variable: Variable) -> str:
    """Return the variable's name, followed by the size of a vector or the rows and columns of a matrix."""
    if variable.columns is not None:
        return f"{variable.name}[{variable.size // variable.columns}, {variable.columns}]"
    return f"{variable.name}[{variable.size}]" if variable.is_array else variable.name


def unit_text(variable: Variable) -> str:
    """Return the unit; 1 for a Real without a unit, empty for other types."""
    return variable.unit or ("1" if variable.type_name == "Real" else "")


def bounds_text(variable: Variable) -> str:
    """Return the declared range as text; empty if there are no bounds."""
    low, high = variable.minimum, variable.maximum
    if low is not None and high is not None:
        return f"{low:g} to {high:g}"
    return f"at least {low:g}" if low is not None else f"at most {high:g}" if high is not None else ""


def start_text(variable: Variable) -> str:
    """Return a short text of the start values: one value if all are equal, the first ones if there are many."""
    numbers = [number_text(number) for number in variable.elements]
    if not variable.is_array:
        return numbers[0]
    if len(set(numbers)) == 1:
        return f"all {numbers[0]}"
    return ", ".join(numbers) if len(numbers) <= SHOWN else ", ".join(numbers[:SHOWN]) + ", ..."


def number_text(number: float | int | bool) -> str:
    """Return a number as written in a parameter set."""
    if isinstance(number, bool):
        return "true" if number else "false"
    return f"{number:.10g}" if isinstance(number, float) else str(number)
