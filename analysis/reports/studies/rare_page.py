"""The page of a rare failure: probability, interval and their conditions, levels, design points, replays."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...rare.outcome import RareResult
from ..kit.page import write_page
from .conditions import conditions_of
from .rare_figures import (
    PERCENT,
    design_point_panels,
    equivalents,
    exceedance_panel,
    influence,
    interval_figure,
    level_spans,
    limit_state_figure,
)
from .tables import Table, cell

Replays = Sequence[tuple[str, str]]


def write_rare_page(result: RareResult, path: Path, replays: Replays = ()) -> None:
    """Write one self-contained HTML page; the same result gives the same bytes.

    ``replays`` are commands that fly the design points again, each with a word for it.
    """
    conditions = conditions_of(result.space, result.facts, result.noise, "")
    write_page(
        path,
        Path(__file__).with_name("rare.html"),
        title=f"{conditions.system}: rare failure",
        result=result,
        conditions=conditions,
        percent=PERCENT,
        limit_state=limit_state_figure(result),
        exceedance=exceedance_panel(result),
        levels=level_table(result),
        designs=design_point_panels(result),
        design_points=design_table(result),
        influence=Table(
            ("parameter", "shift, standard deviations"),
            [(name, cell(shift, 3)) for name, shift in influence(result).items()],
            (1,),
        ),
        intervals=interval_figure(result),
        equivalents=Table(
            ("estimate", "simulations", "from", "to"),
            [(row.label, cell(row.simulations), cell(row.low, 3), cell(row.high, 3)) for row in equivalents(result)],
            (1, 2, 3),
        ),
        replays=replays,
    )


def level_table(result: RareResult) -> Table:
    """A row per level."""
    rows = [
        (
            cell(span.number),
            cell(span.threshold),
            cell(level.samples),
            cell(span.last - span.first + 1),
            cell(level.probability),
            cell(span.reached * level.probability, 3),
            cell(level.taken, 2),
            cell(level.correlation, 3),
            cell(level.deviation, 3),
        )
        for span, level in zip(level_spans(result), result.simulation.levels, strict=True)
    ]
    heads = (
        "level", "limit state from", "samples", "simulations", "conditional probability", "cumulative",
        "acceptance", "gamma", "c.o.v.",
    )  # fmt: skip
    return Table(heads, rows, range(len(heads)))


def design_table(result: RareResult) -> Table:
    """A row per design point: distance, limit state, dispersed parameters."""
    names = result.space.names
    rows = [
        (
            cell(entry["trial"]),
            cell(entry["distance"], 3),
            cell(entry["margin"]),
            *(cell(entry["draws"][name], 6) for name in names),
        )
        for entry in result.failures
    ]
    return Table(("point", "distance β", "limit state", *names), rows, range(3 + len(names)))
