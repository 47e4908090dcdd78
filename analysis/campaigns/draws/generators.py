"""Counter-based random generators: a stream of its own for each draw, independent of all others."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .declared import Columns, Draw, Independent


def generator(seed: int, name: str) -> np.random.Generator:
    """The random stream of the draw that fills ``name``: counter-based (Philox), independent of all other names."""
    return np.random.Generator(np.random.Philox(_sequence(seed, name)))


def generator_at(seed: int, name: str, block: int) -> np.random.Generator:
    """The stream of a block of trials: that of `generator`, its 256-bit counter begun at ``block`` times 2^192."""
    key = _sequence(seed, name).generate_state(2, np.uint64)
    return np.random.Generator(np.random.Philox(key=key, counter=np.array([0, 0, 0, block], dtype=np.uint64)))


def stream_of(draw: Draw) -> str:
    """The name of a draw's random stream, different for each draw."""
    return " ".join(draw.names)


def _sequence(seed: int, name: str) -> np.random.SeedSequence:
    return np.random.SeedSequence(seed, spawn_key=tuple(name.encode()))


def independent_draws(draws: Sequence[Draw]) -> list[tuple[Draw, Independent]]:
    """The draws whose trials are independent, each with its distribution."""
    return [(draw, draw.distribution) for draw in draws if isinstance(draw.distribution, Independent)]


def sample_columns(draw: Draw, distribution: Independent, trials: int, source: np.random.Generator) -> Columns:
    """The next ``trials`` values of a draw from its stream, an array (trials,) for each name."""
    return dict(zip(draw.names, distribution.sample(trials, source), strict=True))
