"""The random streams of components that draw random numbers themselves."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from ...common.errors import InputError

INTEGER_RANGE = 2**31  # FMI Integers have 32 bits


class StreamNumbers(NamedTuple):
    """Values of a component's Integer parameters ``seed`` and ``stream``."""

    seed: int
    stream: int


def stream_numbers(
    seed: int, trial: int, component_names: Iterable[str], where: str = "campaign"
) -> dict[str, StreamNumbers]:
    """The random stream of every component in one trial, the same for every variant.

    No two pairs (trial, component) share a stream. ``component_names`` are all components that
    take part, in any order; ``where`` is the file that an error names. Raises InputError when
    the stream number exceeds an FMI Integer.
    """
    names = sorted(set(component_names))
    if (trial + 1) * len(names) > INTEGER_RANGE:
        problem = f"trial {trial} with {len(names)} components needs a stream number above 2^31 - 1"
        raise InputError(where, "trials", problem, f"use at most {INTEGER_RANGE // len(names)} trials")
    return {name: StreamNumbers(seed % INTEGER_RANGE, trial * len(names) + index) for index, name in enumerate(names)}
