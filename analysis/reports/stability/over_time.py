"""The figure at the top of a stability page: margins over the time of flight, of loops studied at several times."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from ...stability.loops.margin_values import Quantity
from ...stability.results.report import StabilityReport
from ..common.panels import Panel, panel, swatch
from ..common.quantities import number
from .courses import QUANTITIES, Course, course_look, courses, draw_over_time
from .shared import together
from .words import numeral


@dataclass(frozen=True)
class OverTime:
    """Its panels, one for each margin; the legend's swatches with their loops; operating points with their times."""

    panels: list[Panel]
    legend: list[tuple[Markup, str]]
    points: list[tuple[str, Markup]]


def over_time(report: StabilityReport) -> OverTime | None:
    """None where no loop is studied at two times of one flight."""
    histories = courses(report)
    if not histories:
        return None
    seen = {loop.point for course in histories for loops in course.loops for loop in loops}
    points = sorted((point for point in report.points if point.name in seen), key=lambda point: point.time)
    return OverTime(
        [_panel(histories, quantity, f"over-time-{index + 1}") for index, quantity in enumerate(QUANTITIES)],
        [(swatch(course_look(index)), _names(course)) for index, course in enumerate(histories)],
        [(point.name, numeral(point.time)) for point in points],
    )


def _names(course: Course) -> str:
    return together([loops[0] for loops in course.loops])


def _panel(histories: list[Course], quantity: Quantity, name: str) -> Panel:
    sizes = [size for course in histories for size in course.sizes[quantity].tolist()]
    minimum = min(sizes)
    loops = sum(len(course.loops) for course in histories)
    words = f"{quantity.capitalize()} of {loops} loops over the time of flight, minimum "
    words += (
        number(minimum, 3)
        if abs(minimum) < float("inf")
        else "that of an unstable loop"
        if minimum < 0.0
        else "unlimited"
    )
    draw: Any = lambda axes: draw_over_time(histories, quantity, axes)  # noqa: E731
    return panel(quantity.capitalize(), name, words, draw)
