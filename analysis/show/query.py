"""Query of a page about a campaign, as JSON in the address: columns and variants by number, ranges in bins."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from ...common.errors import InputError
from .scale import BINS

Index = Annotated[int, msgspec.Meta(ge=0, le=100_000)]
Bin = Annotated[int, msgspec.Meta(ge=0, lt=BINS)]
Figures = Annotated[list[Index], msgspec.Meta(max_length=64)]
LONGEST = 8000  # characters of a query


class Range(msgspec.Struct, forbid_unknown_fields=True):
    """Rows whose value in a column is in the bins ``first`` to ``last``, both included."""

    column: Index
    first: Bin
    last: Bin


class Query(msgspec.Struct, forbid_unknown_fields=True):
    """Query for ``histograms`` and ``grids`` of columns, over the rows that match all ranges, outcome and variants."""

    histograms: Figures = []
    grids: Annotated[list[tuple[Index, Index]], msgspec.Meta(max_length=4)] = []
    ranges: Annotated[list[Range], msgspec.Meta(max_length=64)] = []
    outcome: Literal["all", "success", "failure"] = "all"
    variants: Annotated[list[Index], msgspec.Meta(max_length=1000)] | None = None


def read_query(text: str, columns: int, variants: int) -> Query:
    """Read a query about a campaign with these numbers of columns and variants. Raises InputError."""
    remedy = "reload the page"
    if len(text) > LONGEST:
        raise InputError("query", "", f"the query has {len(text)} characters, but at most {LONGEST} are read", remedy)
    try:
        query = msgspec.json.decode(text, type=Query)
    except (msgspec.DecodeError, RecursionError) as error:
        raise InputError("query", "", str(error), remedy) from error
    numbers = [*query.histograms, *(index for pair in query.grids for index in pair)]
    column = max([*numbers, *(each.column for each in query.ranges)], default=0)
    if column >= columns:
        raise InputError("query", "", f"asks for column {column + 1}, but the campaign has {columns} columns", remedy)
    variant = max(query.variants or [], default=0)
    if variant >= variants:
        raise InputError(
            "query", "", f"asks for variant {variant + 1}, but the campaign has {variants} variants", remedy
        )
    return query
