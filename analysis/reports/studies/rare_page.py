"""The page of a rare failure: probability, interval and their conditions, levels, design points, replays."""

from __future__ import annotations

from pathlib import Path

from ...studies.rare.outcome import RareResult
from ..chart.legend import legend_of
from ..common.page import Table, exact, fraction
from ..common.quantities import label_with_unit
from .conditions import write_study_page
from .rare_figures import (
    DESIGN_LEGEND,
    PERCENT,
    design_point_panels,
    equivalents,
    exceedance_panel,
    influence,
    interval_figure,
    level_spans,
    limit_state_chart,
    limit_state_figure,
)


def write_rare_page(result: RareResult, path: Path, folder: Path | None = None) -> None:
    """Write one self-contained HTML page; the same result gives the same bytes.

    ``folder`` is where the result has been written, if it has: the page says how its failures are flown again.
    """
    write_study_page(
        path,
        "rare.html",
        "rare failure",
        result,
        percent=PERCENT,
        limit_state=limit_state_figure(result),
        limit_legend=legend_of([limit_state_chart(result)]),
        exceedance=exceedance_panel(result),
        levels=level_table(result),
        designs=design_point_panels(result),
        design_legend=DESIGN_LEGEND,
        design_points=design_table(result),
        influence=Table(
            ("parameter", "shift, standard deviations"),
            [(name, exact(shift, digits=3)) for name, shift in influence(result).items()],
            (1,),
        ),
        intervals=interval_figure(result),
        equivalents=Table(
            ("estimate", "simulations", "from", "to"),
            [
                (row.label, exact(row.simulations), exact(row.low, digits=3), exact(row.high, digits=3))
                for row in equivalents(result)
            ],
            (1, 2, 3),
        ),
        replays=replays_of(result, folder),
    )


def level_table(result: RareResult) -> Table:
    """A row per level."""
    rows = []
    for span, level in zip(level_spans(result), result.simulation.levels, strict=True):
        reached = None if span.reached is None or level.probability is None else span.reached * level.probability
        rows.append(
            (
                exact(span.number),
                exact(span.threshold, result.margin_unit),
                exact(level.samples),
                exact(span.last - span.first + 1),
                exact(level.probability),
                exact(reached, digits=3),
                fraction(level.draw_acceptance),
                fraction(level.noise_acceptance),
                fraction(level.least_acceptance),
                exact(level.correlation, digits=3),
                exact(level.deviation, digits=3),
            )
        )
    heads = (
        "level", label_with_unit("threshold", result.margin_unit), "samples", "simulations", "conditional probability",
        "cumulative", "acceptance of draws", "acceptance of noise", "lowest noise source", "gamma", "c.o.v.",
    )  # fmt: skip
    return Table(heads, rows, range(len(heads)))


def design_table(result: RareResult) -> Table:
    """A row per design point: distance, limit state, dispersed parameters, the noise of each component."""
    names = result.space.names
    sources = list(result.noise.sources)
    rows = [
        (
            exact(entry["trial"]),
            exact(entry["distance"], digits=3),
            exact(entry["margin"], result.margin_unit),
            *(exact(entry["draws"][name], result.units.get(name), 6) for name in names),
            *(exact(entry["streams"][source]) for source in sources),
        )
        for entry in result.failures
    ]
    heads = (
        "point",
        "distance, standard deviations",
        label_with_unit("limit state", result.margin_unit),
        *(label_with_unit(name, result.units.get(name)) for name in names),
        *(f"noise of {source}" for source in sources),
    )
    return Table(heads, rows, range(len(heads)))


def replays_of(result: RareResult, folder: Path | None) -> list[tuple[str, str]]:
    """Commands with what they do: the design points again where they were written, a lower bound where levels ended."""
    command = result.replay(folder, 0) if result.failures else ""
    replays = [("design point 0; trial K of the file is design point K", command)] if command else []
    if result.monte_carlo:
        replays.append(("a bound ten times lower, by Monte Carlo", result.monte_carlo))
    return replays
