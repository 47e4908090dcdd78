"""Models of both codes at the same inputs, without a step: what a comparison states, and its rows of the table."""

from dataclasses import dataclass

import numpy as np

from crosscheck.table import Table, at_common_times

HEADS = ("model", "of Basilisk", "inputs", "difference")


@dataclass(frozen=True)
class Comparison:
    """A model that both codes evaluate at the same inputs, a row of the tables per input.

    ``quantities`` are the columns that belong together, by name; ``bounds`` the largest difference that counts as
    agreement, over the largest length of that quantity.
    """

    title: str
    basilisk: str
    inputs: str
    quantities: dict[str, tuple[str, ...]]
    bounds: dict[str, float]


def relative_differences(case: Comparison, ours: Table, other: Table) -> dict[str, float]:
    """Return the largest length of a difference over the largest length, by quantity.

    Raises ValueError where a quantity is 0 at all inputs, or an input is in one table only.
    """
    first, second = at_common_times(ours, other)
    if first["time"].size != other["time"].size:
        raise ValueError(f"{case.title}: {first['time'].size} of {other['time'].size} inputs are common")
    apart = {}
    for name, columns in case.quantities.items():
        a, b = (np.stack([table[column] for column in columns]) for table in (first, second))
        largest = np.linalg.norm(b, axis=0).max()
        if not largest > 0.0:
            raise ValueError(f"{case.title}: {name} is 0 at all inputs")
        apart[name] = float(np.linalg.norm(a - b, axis=0).max() / largest)
    return apart


def comparison_row(case: Comparison, apart: dict[str, float]) -> list[str]:
    """Return the row of the table: the difference of each quantity, named where there are several."""
    texts = [f"{difference:.1e}" if difference else "0" for difference in apart.values()]
    if len(apart) > 1:
        texts = [f"{name} {cell}" for name, cell in zip(apart, texts, strict=True)]
    return [case.title, case.basilisk, case.inputs, ", ".join(texts)]
