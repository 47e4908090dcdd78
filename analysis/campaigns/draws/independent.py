"""Draws whose trials are independent of each other, each from a random stream of its own."""

from __future__ import annotations

import numpy as np

from .declared import Columns, Draw


def generator(seed: int, name: str) -> np.random.Generator:
    """The random stream of the draw that fills ``name``: counter-based (Philox), independent of all other names."""
    return np.random.Generator(np.random.Philox(_sequence(seed, name)))


def generator_at(seed: int, name: str, block: int) -> np.random.Generator:
    """The stream of a block of trials: that of `generator`, its 256-bit counter begun at ``block`` times 2^192."""
    key = _sequence(seed, name).generate_state(2, np.uint64)
    return np.random.Generator(np.random.Philox(key=key, counter=np.array([0, 0, 0, block], dtype=np.uint64)))


def stream_of(draw: Draw) -> str:
    """The name by which the stream of a draw is told from others."""
    return " ".join(draw.names)


def _sequence(seed: int, name: str) -> np.random.SeedSequence:
    return np.random.SeedSequence(seed, spawn_key=tuple(name.encode()))


def independent_columns(draw: Draw, trials: int, source: np.random.Generator) -> Columns:
    """The next ``trials`` values of a draw from its stream; parts of any size give what one part of all gives."""
    arguments = draw.arguments
    if draw.distribution == "uniform":
        return {draw.name: source.uniform(arguments["low"], arguments["high"], trials)}
    if draw.distribution == "normal":
        return {draw.name: source.normal(arguments["mean"], arguments["sigma"], trials)}
    if draw.distribution == "choice":
        weights = np.array(arguments["weights"])
        return {draw.name: source.choice(np.array(arguments["values"]), trials, p=weights / weights.sum())}
    size = len(draw.names)
    values, vectors = np.linalg.eigh(np.array(arguments["covariance"]))
    factor = vectors * np.sqrt(np.maximum(values, 0.0))
    normal = source.standard_normal((trials, size))
    # summed column by column: a matrix product may round a row differently in a longer table
    return {
        name: arguments["mean"][i] + sum(factor[i, j] * normal[:, j] for j in range(size))
        for i, name in enumerate(draw.names)
    }
