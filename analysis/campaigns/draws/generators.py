"""Counter-based random generators, with a separate stream for each draw; random streams of components with noise."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ....common.errors import InputError
from .interfaces import Columns, Draw, Independent

TAIL = 3.6541528853610088  # beyond this value numpy's ziggurat (Marsaglia and Tsang 2000) uses the C library's log1p
STEP = 2.0**-30


def generator(seed: int, name: str) -> np.random.Generator:
    """Return the random stream of the draw ``name``, which is counter-based (Philox) and independent of other names."""
    return np.random.Generator(np.random.Philox(_sequence(seed, name)))


def generator_at(seed: int, name: str, block: int) -> np.random.Generator:
    """Return the stream of `generator` for a block of trials; its 256-bit counter starts at ``block`` * 2^192."""
    key = _sequence(seed, name).generate_state(2, np.uint64)
    return np.random.Generator(np.random.Philox(key=key, counter=np.array([0, 0, 0, block], dtype=np.uint64)))


def standard_normals(source: np.random.Generator, shape: int | tuple[int, ...]) -> np.ndarray:
    """Draw standard normal values that are the same on every processor.

    Values above ``TAIL`` are rounded to multiples of ``STEP``, because the last bits of the C library's log1p depend on
    the processor.
    """
    values = source.standard_normal(shape)
    return np.where(np.abs(values) > TAIL, np.rint(values / STEP) * STEP, values)


def stream_of(draw: Draw) -> str:
    """Return the unique name of a draw's random stream."""
    return " ".join(draw.names)


def _sequence(seed: int, name: str) -> np.random.SeedSequence:
    return np.random.SeedSequence(seed, spawn_key=tuple(name.encode()))


def independent_draws(draws: Sequence[Draw]) -> list[tuple[Draw, Independent]]:
    """Return the draws whose trials are independent, each with its distribution."""
    return [(draw, draw.distribution) for draw in draws if isinstance(draw.distribution, Independent)]


def sample_columns(draw: Draw, distribution: Independent, trials: int, source: np.random.Generator) -> Columns:
    """Draw the next ``trials`` values from a draw's stream; return an array (trials,) for each name."""
    return dict(zip(draw.names, distribution.sample(trials, source), strict=True))


INTEGER_RANGE = 2**31  # FMI Integers have 32 bits


def stream_numbers(
    seed: int, trials: np.ndarray, component: str, component_names: Iterable[str], where: str = "campaign"
) -> tuple[int, np.ndarray]:
    """Return the seed of a component, and its stream numbers in ``trials`` (n,), the same for every variant.

    No two pairs (trial, component) share a stream. ``component_names`` contains the names of all components, in any
    order; ``where`` is the file named in errors. Raises InputError if a stream number exceeds an FMI Integer.
    """
    names = sorted(set(component_names))
    last = int(trials.max(initial=0))
    if (last + 1) * len(names) > INTEGER_RANGE:
        problem = f"trial {last} with {len(names)} random components needs a stream number above 2^31 - 1"
        raise InputError(where, "trials", problem, f"use at most {INTEGER_RANGE // len(names)} trials")
    return seed % INTEGER_RANGE, trials * len(names) + names.index(component)
