"""The documents of `perilune show`: what its page begins with, and what the server answers."""

from __future__ import annotations

from typing import NotRequired, TypedDict


class Quantity(TypedDict):
    """A column of a campaign; numbers are in SI, times ``factor`` in ``unit``."""

    name: str
    unit: str
    factor: float
    meaning: str


class Variant(TypedDict):
    """A variant of a campaign, and its colour."""

    name: str
    colour: str


class Campaign(TypedDict):
    """A campaign in a folder; ``flown`` of its trials are there."""

    folder: str
    system: str
    description: str
    criterion: str
    trials: int
    flown: int
    variants: list[Variant]
    quantities: list[Quantity]


class ShowDocument(TypedDict):
    """Campaigns, and sizes: bins of a column, bars of a histogram, histograms at first."""

    campaigns: list[Campaign]
    bins: int
    bars: int
    figures: int


class ScaleDocument(TypedDict):
    """A range of numbers; of asinh(x / knee) unless the knee is 0."""

    low: float
    high: float
    knee: float


class HistogramCounts(TypedDict):
    """Counts by variant: of the bars, then of nan, infinity and minus infinity."""

    counts: list[list[int]]
    scale: ScaleDocument | None


class DotsDocument(TypedDict):
    """Trials one by one: row numbers, bins, outcomes and variants as little-endian integers in base64."""

    rows: str
    x: str
    y: str
    success: str
    variants: str


class GridCounts(TypedDict):
    """Trials over two columns: counts and failures of squares, rows from the bottom; or dots of few trials."""

    x: ScaleDocument | None
    y: ScaleDocument | None
    counts: NotRequired[list[int]]
    failures: NotRequired[list[int]]
    dots: NotRequired[DotsDocument]


class RangeEnds(TypedDict):
    """The ends of a range in SI, ``low`` included, ``high`` not; ``step`` is the least distance to another end."""

    low: float
    high: float
    step: float


class Counts(TypedDict):
    """The answer to a query; ``outcomes`` are failures and successes of each variant."""

    outcomes: list[tuple[int, int]]
    ranges: list[RangeEnds | None]
    histograms: list[HistogramCounts]
    grids: list[GridCounts]


class TrialEntry(TypedDict):
    """A trial, the command that simulates it again, and numbers: null is nan, a text infinite."""

    row: int
    trial: int
    variant: str
    success: bool
    status: str
    command: str
    numbers: list[float | str | None]
