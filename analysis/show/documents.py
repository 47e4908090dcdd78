"""Documents of `perilune show`: initial data of its page, and answers of the server."""

from __future__ import annotations

from typing import NotRequired, TypedDict


class QuantityEntry(TypedDict):
    """A column of a campaign; its numbers are in SI units, and ``factor`` converts them to ``unit``."""

    name: str
    unit: str
    factor: float
    meaning: str


class VariantEntry(TypedDict):
    """A variant of a campaign with its colour."""

    name: str
    colour: str


class CampaignEntry(TypedDict):
    """A campaign in a folder; ``flown`` is the number of trials available."""

    folder: str
    system: str
    description: str
    criterion: str
    trials: int
    flown: int
    variants: list[VariantEntry]
    quantities: list[QuantityEntry]


class ShowDocument(TypedDict):
    """Campaigns, and the numbers of bins per column, of bars per histogram and of initial histograms."""

    campaigns: list[CampaignEntry]
    bins: int
    bars: int
    figures: int


class ScaleDocument(TypedDict):
    """Scale over a range of numbers: linear if the knee is 0, else linear in asinh(x / knee)."""

    low: float
    high: float
    knee: float


class HistogramCounts(TypedDict):
    """Numbers of trials of each variant: in each bar, then with NaN, infinity and minus infinity."""

    counts: list[list[int]]
    scale: ScaleDocument | None


class DotsDocument(TypedDict):
    """Individual trials: row numbers, bins, outcomes and variants as little-endian integers in base64."""

    rows: str
    x: str
    y: str
    success: str
    variants: str


class GridCounts(TypedDict):
    """Trials over two columns: trials and failures per square, in rows from the bottom, or dots if they are few."""

    x: ScaleDocument | None
    y: ScaleDocument | None
    counts: NotRequired[list[int]]
    failures: NotRequired[list[int]]
    dots: NotRequired[DotsDocument]


class RangeEnds(TypedDict):
    """The ends of a range in SI: ``low`` inclusive, ``high`` exclusive; ``step`` is the least distance between ends."""

    low: float
    high: float
    step: float


class Counts(TypedDict):
    """The answer to a query; ``outcomes`` are the failures and successes of each variant."""

    outcomes: list[tuple[int, int]]
    ranges: list[RangeEnds | None]
    histograms: list[HistogramCounts]
    grids: list[GridCounts]


class TrialEntry(TypedDict):
    """A trial, the command that repeats it, and its numbers: NaN is null, and an infinite number is a text."""

    row: int
    trial: int
    variant: str
    success: bool
    status: str
    command: str
    numbers: list[float | str | None]
