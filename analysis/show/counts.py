"""Trials of a campaign counted under a filter: histograms by variant, density grids, successes and failures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .columns import Binned, BinnedColumns
from .dots import DOT_LIMIT, dots_of
from .query import Query, Range
from .scale import BARS, BINS, CODES, SHIFT


class Counter:
    """What a query asks of a campaign, counted. Raises InputError for damaged files, StoppedError at the end."""

    def __init__(self, columns: BinnedColumns, names: Sequence[str], query: Query) -> None:
        self.campaign = columns.campaign
        self.query = query
        self._names = names
        indices = [
            *query.histograms,
            *(index for pair in query.grids for index in pair),
            *(each.column for each in query.ranges),
        ]
        binned = columns.get([names[index] for index in indices])
        self._columns = {index: binned[names[index]] for index in indices}
        self._success = columns.success
        self._common = self._of_outcome_and_variants()
        self._within = {(each.column, each.first, each.last): self._in_range(each) for each in query.ranges}

    def selected(self, *without: int) -> np.ndarray:
        """The rows that the filter selects (rows,), as booleans, ranges of the columns ``without`` left out."""
        mask = self._common
        for (column, _, _), rows in self._within.items():
            if column not in without:
                mask = mask & rows
        return mask

    def document(self) -> dict[str, Any]:
        """All counts, for the page: every figure of the trials that the ranges of other columns select."""
        mask = self.selected()
        return {
            "outcomes": self._outcomes(mask),
            "ranges": [self._ends(each) for each in self.query.ranges],
            "histograms": [self._histogram(index) for index in self.query.histograms],
            "grids": [self._grid(x, y) for x, y in self.query.grids],
        }

    def _outcomes(self, mask: np.ndarray) -> list[list[int]]:
        """Failures and successes of each variant (variants, 2)."""
        variants = len(self.campaign.variants)
        codes = self.campaign.variant_numbers[mask].astype(np.intp) * 2 + self._success[mask]
        return np.bincount(codes, minlength=2 * variants).reshape(variants, 2).tolist()

    def _histogram(self, index: int) -> dict[str, Any]:
        mask, variants = self.selected(index), len(self.campaign.variants)
        codes = self.campaign.variant_numbers[mask].astype(np.intp) * CODES + (self._codes(index)[mask] >> SHIFT)
        counts = np.bincount(codes, minlength=CODES * variants).reshape(variants, CODES)
        return {"counts": counts.tolist(), "scale": scale_document(self._columns[index])}

    def _grid(self, x: int, y: int) -> dict[str, Any]:
        """Counts and failures over two columns (BARS, BARS), rows from the bottom; or the dots of few trials."""
        mask = self.selected(x, y)
        mask = mask & (self._codes(x) < BINS) & (self._codes(y) < BINS)
        scales = {"x": scale_document(self._columns[x]), "y": scale_document(self._columns[y])}
        rows = np.flatnonzero(mask)
        if rows.size <= DOT_LIMIT:
            variants = self.campaign.variant_numbers[rows]
            return scales | dots_of(rows, self._codes(x)[rows], self._codes(y)[rows], self._success[rows], variants)
        squares = (self._codes(y)[rows] >> SHIFT).astype(np.intp) * BARS + (self._codes(x)[rows] >> SHIFT)
        failures = np.bincount(squares[~self._success[rows]], minlength=BARS * BARS)
        return scales | {
            "counts": np.bincount(squares, minlength=BARS * BARS).tolist(),
            "failures": failures.tolist(),
        }

    def _codes(self, index: int) -> np.ndarray:
        return self._columns[index].codes

    def _in_range(self, each: Range) -> np.ndarray:
        codes = self._codes(each.column)
        return (codes >= each.first) & (codes <= each.last)

    def _ends(self, each: Range) -> list[float] | None:
        """The ends of a range in the column's unit; None of a column without a finite number."""
        scale = self._columns[each.column].scale
        return None if scale is None else [float(scale.edges[each.first]), float(scale.edges[each.last + 1])]

    def _of_outcome_and_variants(self) -> np.ndarray:
        if self.query.outcome == "all":
            mask = np.ones(self.campaign.rows, dtype=bool)
        else:
            mask = self._success == (self.query.outcome == "success")
        if self.query.variants is None:
            return mask
        chosen = np.zeros(len(self.campaign.variants), dtype=bool)
        chosen[self.query.variants] = True
        return mask & chosen[self.campaign.variant_numbers]


def scale_document(column: Binned) -> dict[str, float] | None:
    """A scale for the page; None where no number is finite."""
    scale = column.scale
    return None if scale is None else {"low": scale.low, "high": scale.high, "knee": scale.knee}
