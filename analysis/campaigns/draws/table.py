"""Draws of all trials from the root seed: in one table, or counter-based.

In a table each draw has a separate random stream, with the seed and the draw's name as the key, of which trial k uses
the k-th portion: a trial's values depend neither on the number of trials nor on other draws. Grids, Latin hypercubes
and Sobol sequences, however, are designs of the complete table.

Counter-based draws need no table. Trials are divided into blocks of 1024, independently of shards. The values of a draw
in a block come from Philox (Salmon et al. 2011) with the key of the draw's name and a counter that begins with the
block's number: no two blocks and no two names share a random number. The two schemes draw different values.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ....common.bounds import TABLE_TRIALS
from ....common.errors import InputError
from .generators import generator, generator_at, independent_draws, sample_columns, stream_of
from .interfaces import CampaignDraws, Columns, Design, designs_of, input_names
from .supplied import stream_component


class Draws(Protocol):
    """All drawn and derived values of a campaign, stored or computed on demand."""

    def of_first(self, trials: int) -> Draws:
        """Return the samples of the first ``trials`` trials."""
        ...

    def of_part(self, trials: range) -> DrawTable:
        """Return the samples of consecutive trials, renumbered from 0."""
        ...


@dataclass(frozen=True)
class DrawTable:
    """All drawn and derived values: ``columns`` maps each name to an array of doubles, one for each trial."""

    trials: int
    columns: Mapping[str, np.ndarray]

    def of_first(self, trials: int) -> DrawTable:
        return self.of_part(range(trials))

    def of_part(self, trials: range) -> DrawTable:
        rows = slice(trials.start, trials.stop)
        return DrawTable(len(trials), {name: column[rows] for name, column in self.columns.items()})

    def row(self, trial: int) -> dict[str, float]:
        return {name: column.item(trial) for name, column in self.columns.items()}

    def parameters(self, rows: slice) -> dict[str, np.ndarray]:
        """Return the drawn columns of component parameters, whose names contain a dot, in some trials."""
        return {
            name: column[rows]
            for name, column in self.columns.items()
            if "." in name and stream_component(name) is None
        }


def split_trials(trials: int, size: int) -> Iterator[range]:
    """Yield the ranges of all trials, with ``size`` trials each."""
    return (range(first, min(first + size, trials)) for first in range(0, trials, size))


def draw_parts(campaign: CampaignDraws, size: int) -> Iterator[DrawTable]:
    """Yield the table of draws and derived values in blocks of ``size`` trials, with columns in the file's order.

    Values depend neither on the size nor on the order in which draws are declared. Only designs are stored completely
    in memory. Raises InputError if the number of trials does not suit a design or a table, or if a derived value is not
    finite.
    """
    trials, seed, file = campaign.trials, campaign.seed, campaign.file
    if trials > TABLE_TRIALS.limit:
        problem = f"{trials} trials are requested, but one table of draws has at most {TABLE_TRIALS.limit:.0f}"
        raise InputError(
            file,
            "trials",
            problem,
            'give fewer trials, or write draw_scheme = "counter", which yields different samples',
        )
    ordered = sorted(campaign.draws, key=lambda draw: draw.names)
    designs = [kind.design(draws, trials, seed, file) for kind, draws in designs_of(ordered).items()]
    sources = [(*pair, generator(seed, stream_of(pair[0]))) for pair in independent_draws(ordered)]
    for part in split_trials(trials, size):
        columns: Columns = {}
        for design in designs:
            columns |= design(part)
        for draw, distribution, source in sources:
            columns |= sample_columns(draw, distribution, len(part), source)
        yield table_of(campaign, columns, part)


def draw_table(campaign: CampaignDraws) -> DrawTable:
    """Return all blocks of `draw_parts` in one table. Raises InputError."""
    return next(draw_parts(campaign, campaign.trials))


def table_of(campaign: CampaignDraws, drawn: Mapping[str, np.ndarray], trials: range | None = None) -> DrawTable:
    """Return the table of these draws, arrays (trials,) by name, with the campaign's derived values and lookups.

    ``trials`` are the numbers of the trials, by default of all trials of the campaign. Raises InputError if a derived
    value is not finite, or if a lookup has fewer trials.
    """
    numbers = range(campaign.trials) if trials is None else trials
    names = input_names(campaign)
    columns: Columns = {name: drawn[name] for name in (*names, *(other for other in drawn if other not in names))}
    for name, formula in campaign.derived.items():
        columns[name] = np.array(np.broadcast_to(formula.evaluate(columns), (len(numbers),)))
        wrong = np.flatnonzero(~np.isfinite(columns[name]))
        if wrong.size:
            problem = f"{formula.text!r} is {columns[name][wrong[0]]} in trial {numbers[wrong[0]]}"
            raise InputError(*formula.where, problem, "keep the expression finite over the range of the draws")
    columns |= {lookup.name: lookup.numbers_of(numbers) for lookup in campaign.lookups}
    return DrawTable(len(numbers), columns)


BLOCK = 1024  # trials


class CountedDraws:
    """Draws of a campaign with draw_scheme = "counter". Raises InputError for designs that need a table."""

    def __init__(self, campaign: CampaignDraws) -> None:
        for draw in campaign.draws:
            if isinstance(draw.distribution, Design) and not draw.distribution.is_periodic:
                kind = draw.distribution.keyword
                problem = f'a {kind} needs all trials at once, which draw_scheme = "counter" does not draw'
                remedy = 'use "uniform", or draw_scheme = "table"'
                raise InputError(campaign.file, f"draw.{draw.name}", problem, remedy)
        self._campaign = campaign
        ordered = sorted(campaign.draws, key=lambda draw: draw.names)
        self._designs = [
            kind.design(draws, campaign.trials, campaign.seed, campaign.file)
            for kind, draws in designs_of(ordered).items()
        ]
        self._independent = independent_draws(ordered)

    def of_first(self, trials: int) -> CountedDraws:
        """Return the samples of the first ``trials`` trials, which do not depend on the number of trials."""
        return self

    def of_part(self, trials: range) -> DrawTable:
        """Return the samples of consecutive trials, renumbered from 0. Raises InputError if a sample is not finite."""
        first = trials.start // BLOCK
        blocks = [self._block(block) for block in range(first, -(-trials.stop // BLOCK))]
        rows = slice(trials.start - first * BLOCK, trials.stop - first * BLOCK)
        columns = {name: np.concatenate([block[name] for block in blocks])[rows] for name in blocks[0]}
        for design in self._designs:
            columns |= design(trials)
        return table_of(self._campaign, columns, trials)

    def _block(self, block: int) -> Columns:
        columns: Columns = {}
        for draw, distribution in self._independent:
            source = generator_at(self._campaign.seed, stream_of(draw), block)
            columns |= sample_columns(draw, distribution, BLOCK, source)
        return columns
