"""The page of a worst case: its value and conditions, the search, random trials, the box, its flight."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from markupsafe import Markup

from ...flight.results import Result
from ...worst.outcome import WorstResult
from ..kit.page import write_page
from ..kit.panels import Panel
from ..own.asked.declared import Figure
from ..own.own_figures import joint_findings, own_sections
from ..own.section import Section
from ..run.time_histories import ComponentHistory, time_histories
from ..run.trajectory import trajectory_panels
from .conditions import conditions_of
from .rare_page import Replays
from .tables import Table, cell
from .worst_figures import box_figure, box_lanes, objective_of, search_figure, trials_panel


class FlightPart(NamedTuple):
    """The flight of the worst case on its page: the path, what the system asks for, or else every signal."""

    status: str
    end: float | None
    trajectory: list[Panel]
    joint: list[Markup]
    own: list[Section]
    histories: list[ComponentHistory]


def write_worst_page(
    result: WorstResult,
    path: Path,
    flight: Result | None = None,
    figures: Sequence[Figure] = (),
    replays: Replays = (),
) -> None:
    """Write one self-contained HTML page; the same result gives the same bytes.

    ``flight`` is the worst case with all signals, None where a margin was studied; ``figures`` are those that the
    system asks for, see own/asked/reading.py. ``replays`` are commands that fly it again, each with a word for it.
    """
    conditions = conditions_of(result.space, result.facts, result.noise, "")
    objective = objective_of(result)
    write_page(
        path,
        Path(__file__).with_name("worst.html"),
        title=f"{conditions.system}: worst case",
        result=result,
        conditions=conditions,
        is_margin=not objective.rising,
        worst=value_cell(result.worst["value"], 6),
        random=value_cell(result.worst_random["value"], 6),
        inside=result.worst_random["inside"],
        search=search_figure(result),
        phases=phase_table(result),
        trials=trials_panel(result),
        box=box_figure(result),
        parameters=parameter_table(result),
        metrics=metric_table(result),
        flight=None if flight is None else flight_part(flight, figures),
        replays=replays,
    )


def value_cell(value: float | str | None, digits: int = 4) -> Markup:
    """A value of the objective or of a metric; a simulation without one failed."""
    return Markup("failed") if value is None else cell(value, digits)


def phase_table(result: WorstResult) -> Table:
    """A row per phase of the search, with the worst value up to its end."""
    best = objective_of(result).best_so_far()
    rows, end = [], 0
    for index, phase in enumerate(result.phases):
        end += phase.evaluations
        value = float(best[end - 1])
        rows.append((cell(index + 1), phase.name, cell(phase.evaluations), cell(value if value == value else None, 6)))
    return Table(("", "phase", "simulations", "worst so far"), rows, (0, 2, 3))


def parameter_table(result: WorstResult) -> Table:
    """A row per dispersed parameter: worst case, box, worst random trial."""
    rows = [
        (
            lane.name,
            cell(lane.worst, 6),
            cell(lane.low, 6),
            cell(lane.high, 6),
            cell(lane.at(lane.worst), 3),
            cell(lane.random, 6),
        )
        for lane in box_lanes(result)
    ]
    heads = ("parameter", "worst case", "box from", "to", "fraction of the box", "worst random trial")
    return Table(heads, rows, range(1, 6))


def metric_table(result: WorstResult) -> Table:
    """A row per metric: worst case and worst random trial."""
    worst, random = result.worst["metrics"], result.worst_random["metrics"]
    units = {metric.name: metric.unit for metric in result.space.campaign.metrics}
    rows = [
        (name, value_cell(worst[name], 6), value_cell(random[name], 6), Markup("{}").format(_unit(units.get(name))))
        for name in worst
    ]
    return Table(("metric", "worst case", "worst random trial", "unit"), rows, (1, 2))


def _unit(unit: str | None) -> str:
    return "" if unit in (None, "1") else str(unit)


def flight_part(flight: Result, figures: Sequence[Figure]) -> FlightPart:
    """What the page shows of the flight: all signals where the system asks for no time histories."""
    own = own_sections(figures, flight)
    drawn = any(part.panels or part.drawn is not None for part in own)
    return FlightPart(
        status=flight.status,
        end=float(flight.time[-1]) if flight.time.size else None,
        trajectory=trajectory_panels(flight),
        joint=joint_findings(figures, flight),
        own=own,
        histories=[] if drawn else time_histories(flight),
    )
