"""Trials that share a drawn or derived value, such as the number of a case: each value's are a group."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ...common.errors import InputError

MOST = 100  # groups of a campaign


@dataclass(frozen=True)
class Group:
    """Trials that share one ``value``; ``label`` is that as a text, different for each."""

    label: str
    value: float

    def has(self, values: np.ndarray) -> np.ndarray:
        """Which trials are in it, by their ``values`` (trials,)."""
        return values == self.value


def groups_of(parts: Iterable[np.ndarray], where: tuple[str, str]) -> list[Group]:
    """The groups of trials by their values, finite, which come in parts (trials,); in ascending order.

    ``where`` (file, element) is what an error points to. Raises InputError for more than `MOST` groups.
    """
    distinct = np.empty(0)
    for values in parts:
        distinct = np.union1d(distinct, values)
        if distinct.size > MOST:
            problem = f"{distinct.size} different values or more, a group each"
            raise InputError(*where, problem, f"group by a value with {MOST} at most, as a choice or a grid has")
    plain = [float(value) + 0.0 for value in distinct]  # no -0
    labels = [f"{value:.10g}" for value in plain]
    if len(set(labels)) < len(labels):
        labels = [repr(value) for value in plain]
    return [Group(label, value) for label, value in zip(labels, plain, strict=True)]
