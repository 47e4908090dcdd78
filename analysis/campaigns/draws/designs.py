"""Draws that are one design of all trials: grids, Latin hypercubes and Sobol sequences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy

from ...common.errors import InputError
from .declared import Columns, Draw
from .independent import generator

DESIGNS = ("grid", "latin_hypercube", "sobol")


def check_grid(draws: Sequence[Draw], trials: int, file: str) -> None:
    """Refuse a number of trials that does not fill the grid of all grid draws. Raises InputError."""
    points = int(np.prod([len(draw.arguments["values"]) for draw in draws], dtype=object)) if draws else 1
    if trials % points:
        problem = f"{trials} trials do not fill a grid of {points} points"
        raise InputError(file, "trials", problem, f"use a multiple of {points}")


def grid_columns(draws: Sequence[Draw], trials: range) -> Columns:
    """Some trials of the grid: every combination of values, the last name varying fastest, again and again."""
    if not draws:
        return {}
    shape = [len(draw.arguments["values"]) for draw in draws]
    places = np.arange(trials.start, trials.stop) % int(np.prod(shape, dtype=object))
    indices = np.unravel_index(places, shape)
    return {draw.name: np.array(draw.arguments["values"])[index] for draw, index in zip(draws, indices, strict=True)}


def latin_hypercube_columns(draws: Sequence[Draw], trials: int, seed: int) -> Columns:
    """One value in each of as many equal strata as there are trials, shuffled independently per draw."""
    # a Latin hypercube is one such column per dimension; made singly, a column does not depend on the others
    columns = {}
    for draw in draws:
        design = scipy.stats.qmc.LatinHypercube(1, rng=generator(seed, draw.name)).random(trials)
        columns[draw.name] = _stretch(draw, design[:, 0])
    return columns


def sobol_columns(draws: Sequence[Draw], trials: int, seed: int, file: str) -> Columns:
    """One scrambled Sobol sequence with a dimension per draw, in order of their names. Raises InputError."""
    if not draws:
        return {}
    if trials & (trials - 1):
        higher = 1 << trials.bit_length()
        problem = f"{trials} trials leave a Sobol sequence unbalanced"
        raise InputError(file, "trials", problem, f"use a power of two: {higher // 2} or {higher}")
    design = scipy.stats.qmc.Sobol(len(draws), scramble=True, rng=generator(seed, "design:sobol")).random(trials)
    return {draw.name: _stretch(draw, design[:, index]) for index, draw in enumerate(draws)}


def _stretch(draw: Draw, unit: np.ndarray) -> np.ndarray:
    """Numbers in [0, 1) moved to the draw's interval."""
    return draw.arguments["low"] + (draw.arguments["high"] - draw.arguments["low"]) * unit
