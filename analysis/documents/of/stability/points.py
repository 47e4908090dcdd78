"""Operating points of a stability study: time, distance from a trim, settings."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from .....fmus_src.roles import FROZEN
from ....stability.results.report import PointReport
from ...cell import Cell, Inline, Phrase
from ...common.quantities import display_unit
from ...model import Fold, Missing, Node, Note, Table
from .study_cells import fold_long, names, numbers, numeral, per_cent, sentences

FROZEN_TIME = f"{FROZEN}time_to_go"  # parameter (s) of guidance laws


def point_nodes(points: Sequence[PointReport], parameters: Mapping[str, object]) -> list[Node]:
    """Return the table of operating points, and folded trims and settings; ``parameters`` hold at all points."""
    if not points:
        return [Missing("no operating point")]
    trims = trim_table(points)
    folded: list[Node] = [
        *([trims] if trims.rows else []),
        *(Note(_settings(point)) for point in points if point.settings),
    ]
    return [
        fold_long(point_table(points, parameters), "operating points"),
        *([Fold("Trim residuals and settings", folded)] if folded else []),
        Note(
            "Linearised about the flight frozen at each point. The drift is the largest relative change of the "
            "response over one further period; the linearisation counts as valid until it would be 10 %. "
            "A frozen plan does not drift: it is valid for the frozen time to go at most, since in flight it changes."
        ),
    ]


def _settings(point: PointReport) -> list[Inline]:
    values = [
        part for name, value in point.settings.items() for part in (", ", f"{name} = ", numeral(value, digits=10))
    ]
    return [f"Set at {point.name}: ", *values[1:], "."]


def point_table(points: Sequence[PointReport], parameters: Mapping[str, object]) -> Table:
    """Return a row for each point: the state that drifts most, and how long the frozen-time linearisation is valid."""
    rows: list[tuple[Cell, ...]] = []
    for point in points:
        fastest: Cell = "none"
        if point.trim:
            name, _, change, unit = point.trim[0]
            fastest = Phrase([f"{name} by ", numeral(change, unit), f" {display_unit(unit)}"])
        holds = _validity(point, parameters)
        rows.append((point.name, point.phase, numeral(point.time, digits=6), fastest, per_cent(point.drift), holds))
    heads = (
        names("operating point"), sentences("phase"), numbers("time, s"),
        sentences("largest state drift per period"),
        numbers("drift of the response, %", "frozen-time linearisation valid for, s"),
    )  # fmt: skip
    return Table([head for group in heads for head in group], rows)


def _validity(point: PointReport, parameters: Mapping[str, object]) -> Cell:
    """Return how long the linearisation is valid; for a frozen plan this is at most its time to go."""
    settings = {**parameters, **point.settings}
    times = [float(str(value)) for name, value in settings.items() if name.endswith(f".{FROZEN_TIME}")]
    frozen = min((time for time in times if time > 0.0), default=math.inf)
    if point.holds is None or point.holds <= frozen:
        return numeral(point.holds, infinite="does not change")
    return Phrase([numeral(frozen), " (frozen plan)"])


def trim_table(points: Sequence[PointReport]) -> Table:
    """Return the table of states that change most at each operating point while they are assumed constant."""
    rows: list[tuple[Cell, ...]] = [
        (point.name, name, numeral(value, unit, 6), numeral(change, unit), display_unit(unit))
        for point in points
        for name, value, change, unit in point.trim
    ]
    return Table(["operating point", "state", *numbers("value", "change over a period"), "unit"], rows)
