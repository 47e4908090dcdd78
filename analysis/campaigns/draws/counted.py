"""Draws without a table: those of any trials are made by themselves, from seed, name and number of the trial.

Trials are divided into blocks of 1024, whatever shards there are. The values of a draw in a block come from Philox
(Salmon et al. 2011) with the key of the draw's name and a counter that begins with the block's number: no two blocks
and no two names share a number, and nothing has to be drawn before. They are others than a table's.
"""

from __future__ import annotations

import numpy as np

from ...common.errors import InputError
from .declared import Columns, Declared, Design, designs_of
from .generators import generator_at, independent_draws, sample_columns, stream_of
from .table import DrawTable, table_of

BLOCK = 1024  # trials


class CountedDraws:
    """The draws of a campaign with draw_scheme = "counter". Raises InputError for designs that need a table."""

    def __init__(self, campaign: Declared) -> None:
        for draw in campaign.draws:
            if isinstance(draw.distribution, Design) and not draw.distribution.is_periodic:
                problem = (
                    f"a {draw.distribution.keyword} is a design of all trials, which a counter does not have at once"
                )
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
        """Those of the first ``trials`` trials, which are the same in every campaign of as many or more."""
        return self

    def of_part(self, trials: range) -> DrawTable:
        """Those of trials in a row, which are counted from 0 then. Raises InputError where one is not finite."""
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
