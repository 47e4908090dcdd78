"""The page of a worst case: its value and conditions, the search, random trials, the box, its flight."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from markupsafe import Markup

from ...campaigns.definition.campaign import Record
from ...campaigns.definition.plan import BatchPlan
from ...campaigns.draws.declared import input_names
from ...campaigns.draws.given import GivenDraws, part_streams, stream_component
from ...campaigns.execute.flyer import Flyer
from ...runtime.flight.results import Result
from ...studies.worst.outcome import WorstResult
from ..chart.legend import legend_of
from ..common.page import Table, exact, fraction
from ..common.panels import Panel
from ..common.quantities import display_unit, label_with_unit
from ..figures.declared import Figure
from ..figures.figure_sections import figure_sections, joint_findings
from ..figures.reading import read_figures
from ..figures.section import Section
from ..time_histories import Histories, time_histories
from ..trajectory import trajectory_panels, trajectory_reading
from .conditions import write_study_page
from .worst_figures import (
    BOX_LEGEND,
    box_figure,
    box_lanes,
    fresh_panel,
    objective_of,
    search_chart,
    search_figure,
    trials_panel,
)


class FlightPart(NamedTuple):
    """The flight of the worst case on its page, as the page of a run shows one."""

    status: str
    end: float | None
    trajectory: list[Panel]
    reading: str
    joint: list[Markup]
    own: list[Section]
    histories: Histories


def write_worst_page(
    result: WorstResult,
    path: Path,
    flight: Result | None = None,
    figures: Sequence[Figure] = (),
    folder: Path | None = None,
) -> None:
    """Write one self-contained HTML page; the same result gives the same bytes.

    ``flight`` is the worst case with all signals, None where a margin was studied; ``figures`` are those that the
    system asks for, see figures/reading.py. ``folder`` is where the result has been written, if it has: the page says
    how the worst case is flown again.
    """
    objective = objective_of(result)
    largest = result.worst_realisation
    write_study_page(
        path,
        "worst.html",
        "worst case",
        result,
        is_margin=not objective.rising,
        worst=with_unit(result.worst["value"], result.unit),
        largest=None if largest is None else with_unit(result.as_json(largest), result.unit),
        random=with_unit(result.worst_random["value"], result.unit),
        inside=result.worst_random["inside"],
        search=search_figure(result),
        search_legend=legend_of([search_chart(result)]),
        phases=phase_table(result),
        points=objective.values.size,
        panels=[one for one in (trials_panel(result), fresh_panel(result)) if one is not None],
        fresh=fresh_cells(result),
        box=box_figure(result),
        box_legend=BOX_LEGEND,
        parameters=parameter_table(result),
        metrics=metric_table(result),
        flight=None if flight is None else flight_part(flight, figures),
        replays=replays_of(result, folder),
    )


def value_cell(value: float | str | None, unit: str | None) -> Markup:
    """A value of the objective or of a metric in its shown unit; a simulation without one failed."""
    return Markup("failed") if value is None else exact(value, unit, 6)


def with_unit(value: float | str | None, unit: str) -> Markup:
    """A value of the objective with its unit behind it, if it has one."""
    displayed = value_cell(value, unit)
    return (
        Markup("{} {}").format(displayed, display_unit(unit)) if display_unit(unit) and value is not None else displayed
    )


class FreshCells(NamedTuple):
    """The worst case under fresh noise: how many realisations, their worst, and the quantile by its name."""

    realisations: int
    worst: Markup
    name: str
    quantile: Markup


def fresh_cells(result: WorstResult) -> FreshCells | None:
    """What fresh noise does to the worst case; None where the noise is not random."""
    if result.fresh is None or result.over is None:
        return None
    fresh = result.fresh.document(result.as_json)
    worst, quantile = (with_unit(number, result.unit) for number in (fresh["worst"], fresh["at_quantile"]))
    return FreshCells(fresh["realisations"], worst, result.over.name, quantile)


def replays_of(result: WorstResult, folder: Path | None) -> list[tuple[str, str]]:
    """The command that flies the worst case again; none where nothing was written."""
    replay = result.replay(folder, 0)
    return [("worst case", replay)] if replay else []


def phase_table(result: WorstResult) -> Table:
    """A row per phase of the search, with the worst value up to its end."""
    worst = objective_of(result).worst_so_far()
    rows, end = [], 0
    for index, phase in enumerate(result.phases):
        end += phase.evaluations
        value = float(worst[end - 1])
        rows.append(
            (exact(index + 1), phase.name, exact(phase.evaluations), exact(value if value == value else None, digits=6))
        )
    head = label_with_unit("worst so far", result.unit)
    return Table(("", "method", "points", head), rows, (0, 2, 3))


def parameter_table(result: WorstResult) -> Table:
    """A row per dispersed parameter: worst case, box, worst random trial."""
    rows = [
        (
            lane.label,
            exact(lane.worst, lane.unit, 6),
            exact(lane.low, lane.unit, 6),
            exact(lane.high, lane.unit, 6),
            fraction(lane.at(lane.worst)),
            exact(lane.random, lane.unit, 6),
        )
        for lane in box_lanes(result)
    ]
    heads = ("parameter", "worst case", "box from", "to", "fraction of the box", "worst random trial")
    return Table(heads, rows, range(1, 6))


def metric_table(result: WorstResult) -> Table:
    """A row per metric: worst case and worst random trial."""
    worst, random = result.worst["metrics"], result.worst_random["metrics"]
    rows = [
        (
            label_with_unit(name, result.units.get(name)),
            value_cell(worst[name], result.units.get(name)),
            value_cell(random[name], result.units.get(name)),
        )
        for name in worst
    ]
    return Table(("metric", "worst case", "worst random trial"), rows, (1, 2))


def flight_part(flight: Result, figures: Sequence[Figure]) -> FlightPart:
    """What the page shows of the flight."""
    return FlightPart(
        status=flight.status,
        end=float(flight.time[-1]) if flight.time.size else None,
        trajectory=trajectory_panels(flight),
        reading=trajectory_reading(flight),
        joint=joint_findings(figures, flight),
        own=figure_sections(figures, flight),
        histories=time_histories(flight),
    )


def worst_flight(result: WorstResult, plan: BatchPlan) -> tuple[Result, list[Figure]]:
    """The flight of the worst case with the bits of the search; ``plan`` is that of the study. Raises InputError."""
    plotted = result.flown.draws
    names = [*input_names(plan.campaign), *(name for name in plotted if stream_component(name) is not None)]
    given = GivenDraws(*part_streams({name: plotted[name][[result.row]] for name in names}))
    plain = replace(plan, campaign=replace(plan.campaign, record=Record(), group=None, scatters=()))
    flyer = Flyer(plain.of_samples(given))
    (variant,) = flyer.variants
    flight, _ = flyer.replay(variant, 0)
    return flight, read_figures(plain.prepare(flyer.variants[variant]))
