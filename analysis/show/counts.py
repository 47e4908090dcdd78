"""Counts of a campaign's trials under a filter: histograms by variant, density grids, successes and failures."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .binned_columns import Binned, BinnedColumns
from .documents import Counts, GridCounts, HistogramCounts, RangeEnds, ScaleDocument
from .dots import DOT_LIMIT, dots_of
from .query import Query, Range
from .scale import BARS, BINS, CHUNK, CODES, SHIFT


class Counter:
    """Counter of a campaign's trials under the filters of queries.

    Raises InputError for damaged files, StoppedError after the server stopped.
    """

    def __init__(self, columns: BinnedColumns, names: Sequence[str], query: Query) -> None:
        self.campaign = columns.campaign
        self.query = query
        self._binned = columns
        self._names = names
        grids = [index for pair in query.grids for index in pair]
        needed = [*grids, *(each.column for each in query.ranges)]
        if len({*needed, *query.histograms}) <= columns.limit:
            self._get([*needed, *query.histograms])  # missing columns are read in one pass
        self._columns = self._get(needed)
        self._success = columns.success
        self._common = self._of_outcome_and_variants()
        self._within = {(each.column, each.first, each.last): self._in_range(each) for each in query.ranges}

    def select_rows(self, *without: int) -> np.ndarray:
        """Return a mask (rows,) of the rows that the filter selects, ignoring the ranges of the columns ``without``."""
        mask = self._common
        for (column, _, _), rows in self._within.items():
            if column not in without:
                mask = mask & rows
        return mask

    def document(self) -> Counts:
        """Return all counts for the page; each figure ignores the ranges of the columns that it shows."""
        mask = self.select_rows()
        return {
            "outcomes": self._outcomes(mask),
            "ranges": [self._find_ends(each) for each in self.query.ranges],
            "histograms": self._histograms(),
            "grids": [self._grid(x, y) for x, y in self.query.grids],
        }

    def _outcomes(self, mask: np.ndarray) -> list[tuple[int, int]]:
        """Count failures and successes of each variant, (variants, 2)."""
        return [(failures, successes) for failures, successes in self._by_variant(mask, self._success, 2)]

    def _histograms(self) -> list[HistogramCounts]:
        """Count the trials of each variant per bar, for as many columns at a time as the memory limit allows."""
        histograms: list[HistogramCounts] = []
        size = self._binned.limit
        for first in range(0, len(self.query.histograms), size):
            group = self.query.histograms[first : first + size]
            columns = self._get(group)
            for index in group:
                counts = self._by_variant(self.select_rows(index), columns[index].codes, CODES, SHIFT)
                histograms.append({"counts": counts, "scale": scale_document(columns[index])})
        return histograms

    def _by_variant(self, mask: np.ndarray, codes: np.ndarray, kinds: int, shift: int = 0) -> list[list[int]]:
        """Count the codes, shifted right, of each variant in the rows of a mask, (variants, kinds)."""
        variants = len(self.campaign.variants)
        counts = np.zeros(variants * kinds, dtype=np.intp)
        for first in range(0, mask.size, CHUNK):  # indices are four times as large as codes
            chosen = mask[first : first + CHUNK]
            number = self.campaign.variant_numbers[first : first + CHUNK][chosen].astype(np.intp)
            code = codes[first : first + CHUNK][chosen].astype(np.intp) >> shift
            counts += np.bincount(number * kinds + code, minlength=counts.size)
        return counts.reshape(variants, kinds).tolist()

    def _get(self, indices: Sequence[int]) -> dict[int, Binned]:
        binned = self._binned.get([self._names[index] for index in indices])
        return {index: binned[self._names[index]] for index in indices}

    def _grid(self, x: int, y: int) -> GridCounts:
        """Count trials and failures over two columns, (BARS, BARS) from the bottom; few trials are returned as dots."""
        mask = self.select_rows(x, y)
        mask = mask & (self._codes(x) < BINS) & (self._codes(y) < BINS)
        scales: GridCounts = {"x": scale_document(self._columns[x]), "y": scale_document(self._columns[y])}
        rows = np.flatnonzero(mask)
        if rows.size <= DOT_LIMIT:
            variants = self.campaign.variant_numbers[rows]
            dots = dots_of(rows, self._codes(x)[rows], self._codes(y)[rows], self._success[rows], variants)
            return {**scales, "dots": dots}
        squares = (self._codes(y)[rows] >> SHIFT).astype(np.intp) * BARS + (self._codes(x)[rows] >> SHIFT)
        failures = np.bincount(squares[~self._success[rows]], minlength=BARS * BARS)
        return {
            **scales,
            "counts": np.bincount(squares, minlength=BARS * BARS).tolist(),
            "failures": failures.tolist(),
        }

    def _codes(self, index: int) -> np.ndarray:
        return self._columns[index].codes

    def _in_range(self, each: Range) -> np.ndarray:
        codes = self._codes(each.column)
        return (codes >= each.first) & (codes <= each.last)

    def _find_ends(self, each: Range) -> RangeEnds | None:
        """Return the ends of a range; None for a column without a finite number.

        The step is the smaller width of the bins at the two ends.
        """
        scale = self._columns[each.column].scale
        if scale is None:
            return None
        low, high = scale.edges[[each.first, each.last + 1]]
        step = min(scale.edges[each.first + 1] - low, high - scale.edges[each.last])
        return {"low": float(low), "high": float(high), "step": float(step)}

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


def scale_document(column: Binned) -> ScaleDocument | None:
    """Return a column's scale for the page; None if no number is finite."""
    scale = column.scale
    return None if scale is None else {"low": scale.low, "high": scale.high, "knee": scale.knee}
