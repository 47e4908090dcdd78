"""The table of draws: made for all trials at once, from the root seed, before anything flies.

Each draw has a random stream of its own, keyed by the seed and the name it fills, of which trial k uses
the k-th portion: a trial's values depend neither on how many trials there are nor on what else
is drawn. Grids, Latin hypercubes and Sobol sequences are designs of the whole table instead.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.stats import qmc

from ..errors import InputError
from .campaign import Campaign
from .distributions import Draw

Columns = dict[str, np.ndarray]
INTEGER_RANGE = 2**31  # FMI Integers have 32 bits


@dataclass(frozen=True)
class DrawTable:
    """All drawn and derived values: ``columns`` maps each name to an array of doubles, one per trial."""

    trials: int
    columns: Mapping[str, np.ndarray]

    def of_first(self, trials: int) -> DrawTable:
        """Those of the first ``trials`` trials."""
        return self.of_part(range(trials))

    def of_part(self, trials: range) -> DrawTable:
        """Those of trials in a row, which are counted from 0 then."""
        rows = slice(trials.start, trials.stop)
        return DrawTable(len(trials), {name: column[rows] for name, column in self.columns.items()})

    def row(self, trial: int) -> dict[str, float]:
        """Every value of one trial."""
        return {name: float(column[trial]) for name, column in self.columns.items()}

    def parameters(self, trial: int) -> dict[str, float]:
        """The values of one trial that are component parameters: those with a dot in their name."""
        return {name: value for name, value in self.row(trial).items() if "." in name}


def generator(seed: int, name: str) -> np.random.Generator:
    """The random stream of the draw that fills ``name``: counter-based (Philox), independent of all other names."""
    sequence = np.random.SeedSequence(seed, spawn_key=tuple(name.encode()))
    return np.random.Generator(np.random.Philox(sequence))


def _random(draw: Draw, trials: int, seed: int) -> Columns:
    """Columns of a draw whose trials are independent of each other."""
    source = generator(seed, " ".join(draw.names))
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


def _grid(draws: list[Draw], trials: int, file: str) -> Columns:
    """Every combination of the grid draws' values, the last name varying fastest, repeated to fill the table."""
    shape = [len(draw.arguments["values"]) for draw in draws]
    points = int(np.prod(shape, dtype=object)) if shape else 1
    if trials % points:
        problem = f"{trials} trials do not fill a grid of {points} points"
        raise InputError(file, "trials", problem, f"use a multiple of {points}")
    indices = np.unravel_index(np.arange(trials) % points, shape) if shape else ()
    return {draw.name: np.array(draw.arguments["values"])[index] for draw, index in zip(draws, indices, strict=True)}


def _stretch(draw: Draw, unit: np.ndarray) -> np.ndarray:
    """Numbers in [0, 1) moved to the draw's interval."""
    return draw.arguments["low"] + (draw.arguments["high"] - draw.arguments["low"]) * unit


def _latin_hypercube(draws: list[Draw], trials: int, seed: int) -> Columns:
    """One value in each of as many equal strata as there are trials, shuffled independently per draw."""
    # a Latin hypercube is one such column per dimension; made singly, a column does not depend on the others
    columns = {}
    for draw in draws:
        design = qmc.LatinHypercube(1, rng=generator(seed, draw.name)).random(trials)
        columns[draw.name] = _stretch(draw, design[:, 0])
    return columns


def _sobol(draws: list[Draw], trials: int, seed: int, file: str) -> Columns:
    """One scrambled Sobol sequence with a dimension per draw, in order of their names."""
    if not draws:
        return {}
    if trials & (trials - 1):
        higher = 1 << trials.bit_length()
        problem = f"{trials} trials leave a Sobol sequence unbalanced"
        raise InputError(file, "trials", problem, f"use a power of two: {higher // 2} or {higher}")
    design = qmc.Sobol(len(draws), scramble=True, rng=generator(seed, "design:sobol")).random(trials)
    return {draw.name: _stretch(draw, design[:, index]) for index, draw in enumerate(draws)}


def draw_table(campaign: Campaign) -> DrawTable:
    """The table of draws and derived values of a campaign, columns in the order of its file.

    The order in which draws are declared does not change their values. Raises InputError where
    the number of trials does not suit a design or a derived value is not finite.
    """
    trials, seed = campaign.trials, campaign.seed
    designs: dict[str, list[Draw]] = {"grid": [], "latin_hypercube": [], "sobol": []}
    found: Columns = {}
    for draw in sorted(campaign.draws, key=lambda draw: draw.names):
        if draw.distribution in designs:
            designs[draw.distribution].append(draw)
        else:
            found |= _random(draw, trials, seed)
    found |= _grid(designs["grid"], trials, campaign.file)
    found |= _latin_hypercube(designs["latin_hypercube"], trials, seed)
    found |= _sobol(designs["sobol"], trials, seed, campaign.file)
    return table_of(campaign, found)


def table_of(campaign: Campaign, drawn: Mapping[str, np.ndarray]) -> DrawTable:
    """The table with these draws, an array (trials,) by name, and what the campaign derives of them.

    Raises InputError where a derived value is not finite.
    """
    names = [name for draw in campaign.draws for name in draw.names]
    columns: Columns = {name: drawn[name] for name in (*names, *(other for other in drawn if other not in names))}
    for name, formula in campaign.derived.items():
        columns[name] = np.array(np.broadcast_to(formula.evaluate(columns), (campaign.trials,)))
        wrong = np.flatnonzero(~np.isfinite(columns[name]))
        if wrong.size:
            problem = f"{formula.text!r} is {columns[name][wrong[0]]} in trial {wrong[0]}"
            raise InputError(*formula.where, problem, "keep the expression finite over the range of the draws")
    return DrawTable(campaign.trials, columns)


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
