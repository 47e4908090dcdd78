"""Phases of a mission: times and consumption, as timeline and table, and the propellant budget."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .....runtime.flight.results import Flight, FlightResult
from ....cell import Cell, Inline, Quantity, Rich
from ....chart.axes import lane_axis, linear_axis
from ....chart.marks import SQUARE, vertical_line
from ....common.colours import BLUE, INK, VERMILION
from ....common.quantities import display_unit, label_with_unit, number
from ....figures.declared import BoundValues, BudgetFigure, BudgetItem, PhasesFigure, SequencerPhase
from ....interactive.charts import NO_BOX, Area, Chart, ChartNote
from ....interactive.measures import TICK_SIZE
from ....model import Group, Table
from ....pictures import Figure
from .figure_texts import seconds
from .section import align, figure_group


@dataclass(frozen=True)
class PhaseSpan:
    """A phase from ``begin`` to ``end`` (s); ``spent`` is its consumption, None if not declared."""

    name: str
    begin: float
    end: float
    spent: float | None


def spans_of(phases: PhasesFigure, flight: Flight) -> list[PhaseSpan]:
    """Return the phases in order of time; a phase without a name is named by its value.

    A phase lasts from its first sample to the first sample of the next one, the last phase until the end.
    """
    values = phases.signal.values(flight)[0]
    starts = [(0, values[0]), *((int(row) + 1, values[row + 1]) for row in np.flatnonzero(np.diff(values)))]
    ends = [row for row, _ in starts[1:]] + [values.size]
    firsts: list[tuple[int, str]] = []
    for (begin, value), end in zip(starts, ends, strict=True):
        named = [phase for phase in phases.phases if phase.value == value]
        firsts += _subphases(named, flight, begin, end) if named else [(begin, f"{phases.signal.label} {value:g}")]
    spent = None if phases.spent is None else phases.spent.values(flight)[0]
    lasts = [row for row, _ in firsts[1:]] + [values.size - 1]
    return [
        PhaseSpan(
            name=name,
            begin=float(flight.time[first]),
            end=float(flight.time[last]),
            spent=None if spent is None else float(spent[first] - spent[last]),
        )
        for (first, name), last in zip(firsts, lasts, strict=True)
    ]


def _subphases(named: Sequence[SequencerPhase], flight: Flight, begin: int, end: int) -> list[tuple[int, str]]:
    """Return first row and name of the phases that share a value between two rows; phases without a row are omitted."""
    starts: list[tuple[int, str]] = []
    for phase in named:
        over = end
        if phase.until is not None:
            over = begin + int(np.argmax(np.append(phase.until.values(flight)[0][begin:end] != 0.0, True)))
        if over > begin:
            starts.append((begin, phase.name))
        begin = over
    return starts


def statuses_of(phases: PhasesFigure, flight: Flight) -> list[tuple[int, float]] | None:
    """Return each status with the time (s) of its first occurrence, in order; None if no status is declared."""
    if phases.status_times is not None:
        times = phases.status_times.values(flight)[:, -1]
        occurred = [(index, float(time)) for index, time in enumerate(times, 1) if time >= 0.0]
        return sorted(occurred, key=lambda entry: entry[1])
    if phases.status is None:
        return None
    values = phases.status.values(flight)[0]
    before = np.maximum.accumulate(np.concatenate([[0.0], values[:-1]]))
    return [(int(values[row]), float(flight.time[row])) for row in np.flatnonzero(values > before)]


LANE = 0.27  # in
BAR = 0.62  # height of a bar over the height of a lane
EDGE = 0.8  # pt, width of the ends of bars, which makes short ones visible
GAP = 4.0  # pt, from a bar to its duration
LONG = 0.5  # fraction of the flight without an event from which the plot has two windows
MARGIN = 0.06  # margin on either side of an event, over the remaining time
NEAR_THE_EDGE = 0.88  # position in a window from which durations are on the left of bars
Window = tuple[float, float]


def phase_section(phases: PhasesFigure, result: FlightResult, name: str) -> Group:
    """Return the section of the phases; ``name`` must be unique among the figures of a page."""
    spans, statuses = spans_of(phases, result), statuses_of(phases, result)
    windows = _windows(spans, statuses or [])
    caption: list[Inline] = ["Bars: phases with their duration, s."]
    if statuses:
        caption.append(" Dashed lines: status.")
    if len(windows) > 1:
        caption += [" Between the panels ", seconds(windows[1][0] - windows[0][1]), " are omitted."]
    return figure_group(
        phases.title,
        figures=_figures(phases, spans, statuses or [], windows, name),
        table=_table(phases, spans),
        findings=[] if statuses is None else _findings(phases, statuses),
        notes=[caption, *phases.notes],
    )


def _windows(spans: Sequence[PhaseSpan], statuses: Sequence[tuple[int, float]]) -> list[Window]:
    """Return the time windows of the plot: the whole run, or before and after a long interval without events."""
    begin, end = spans[0].begin, spans[-1].end
    events = sorted({begin, end, *(span.begin for span in spans), *(time for _, time in statuses)})
    length, left, right = max(
        (right - left, left, right) for left, right in zip(events, [*events[1:], end], strict=True)
    )
    margin = MARGIN * (end - begin - length)
    if not margin > 0.0 or length <= LONG * (end - begin):
        return [(begin, end)]
    return [(begin, left + margin), (right - margin, end)]


def phase_chart(
    spans: Sequence[PhaseSpan], statuses: Sequence[tuple[int, float]], window: Window, intervals: int
) -> Chart:
    """Return the chart of a time window: a bar for each phase, a line for each time of a status."""
    lanes = list(dict.fromkeys(span.name for span in spans))
    begin, end = window
    inside = [
        span
        for span in spans
        if max(span.begin, begin) < min(span.end, end) or (span.begin == span.end and begin <= span.begin <= end)
    ]
    bars, edges, notes = [], [], []
    for span in inside:
        left, right, lane = max(span.begin, begin), min(span.end, end), lanes.index(span.name)
        x, y = left + (right - left) * SQUARE[:, 0], lane + BAR * (SQUARE[:, 1] - 0.5)
        bars.append(Area(x, y, (False, False), BLUE.lower(), 1.0, 0.0))
        edges.append(np.array([[left, left, right, right], [y[0], y[2], y[0], y[2]]]))
        if span.end <= end:
            before = right > begin + NEAR_THE_EDGE * (end - begin)
            notes.append(_duration(span, left if before else right, lane, before=before))
    strokes = np.concatenate(edges, axis=1)
    by_time: dict[float, list[str]] = {}
    for status, time in statuses:
        if begin <= time <= end:
            by_time.setdefault(time, []).append(str(status))
    return Chart(
        NO_BOX,
        linear_axis((begin, end if end > begin else begin + 1.0), intervals, label="time, s"),
        lane_axis(lanes),
        areas=[*bars, Area(strokes[0], strokes[1], (False, False), BLUE.lower(), 1.0, EDGE)],
        rules=[vertical_line(time, VERMILION, 1.1, (4.0, 2.0)) for time in by_time],
        notes=[*notes, *(_status(time, ", ".join(numbers)) for time, numbers in by_time.items())],
    )


def _duration(span: PhaseSpan, at: float, lane: int, *, before: bool) -> ChartNote:
    """Return the label with a phase's duration, after or ``before`` its bar."""
    offset, side = (-GAP, "right") if before else (GAP, "left")
    text = number(span.end - span.begin, 4)
    return ChartNote(text, (at, float(lane)), (False, False), (offset, 0.0), (side, "center"), INK, TICK_SIZE)


def _status(time: float, numbers: str) -> ChartNote:
    """Return the numbers of statuses above the axes."""
    return ChartNote(
        numbers, (time, 1.0), (False, True), (0.0, 3.0), ("center", "baseline"), VERMILION.lower(), TICK_SIZE, bold=True
    )


def _figures(
    phases: PhasesFigure,
    spans: Sequence[PhaseSpan],
    statuses: Sequence[tuple[int, float]],
    windows: Sequence[Window],
    name: str,
) -> list[Figure]:
    """Return a figure for each time window; a single figure is as wide as the page."""
    lanes = dict.fromkeys(span.name for span in spans)
    height, description = 0.75 + LANE * len(lanes), f"{phases.title}: {', '.join(lanes)} over time"
    if len(windows) == 1:
        return [Figure("", name, description, phase_chart(spans, statuses, windows[0], 10), height, is_wide=True)]
    figures = []
    for index, window in enumerate(windows):
        begin, end = (number(each, 5) for each in window)
        label = f"{begin} to {end} s"
        timeline = phase_chart(spans, statuses, window, 5)
        figures.append(Figure(label, f"{name}-{index}", f"{description}; {label}", timeline, height))
    return figures


def _table(phases: PhasesFigure, spans: Sequence[PhaseSpan]) -> Table:
    heads = ["phase", "start, s", "duration, s"]
    unit = None if phases.spent is None else phases.spent.unit_name
    if phases.spent is not None:
        is_mass = phases.spent.label.rpartition(".")[2] == "mass"
        heads.append(label_with_unit("propellant" if is_mass else "consumption", unit))
    spent = [span.spent for span in spans if span.spent is not None]
    rows = [*spans, PhaseSpan("total", spans[0].begin, spans[-1].end, sum(spent) if spent else None)]
    columns: list[Sequence[Cell]] = [
        [span.name for span in rows],
        [Quantity(span.begin, digits=6) for span in rows],
        [Quantity(span.end - span.begin, digits=6) for span in rows],
        *([align([span.spent for span in rows], unit)] if phases.spent is not None else []),
    ]
    return Table(heads, list(zip(*columns, strict=True)))


def _findings(phases: PhasesFigure, statuses: Sequence[tuple[int, float]]) -> list[Rich]:
    """Return each status with the time of its first occurrence and its meaning."""
    if not statuses:
        return ["status 0 throughout"]
    return [
        [
            f"status {number(status)} at ",
            seconds(time),
            f": {phases.meanings[status]}" if status in phases.meanings else "",
        ]
        for status, time in statuses
    ]


def consumption_by_phase(budget: BudgetFigure, result: FlightResult) -> dict[str, float]:
    """Return the consumption of each phase that occurred, summed over its occurrences."""
    spent: dict[str, float] = {}
    for span in spans_of(budget.of, result):
        assert span.spent is not None  # required by the reader of a budget
        spent[span.name] = spent.get(span.name, 0.0) + span.spent
    return spent


def amount(item: BudgetItem, spent: Mapping[str, float], bound: BoundValues | None) -> float | None:
    """Return the amount of an item; None if one of its phases did not occur, or if the bound is missing."""
    values = {} if bound is None else bound.values
    if any(name not in spent for name in item.phases) or any(name not in values for name in (*item.plus, *item.minus)):
        return None
    used = (spent[name] for name in item.phases)
    return math.fsum((*used, *(values[name] for name in item.plus), *(-values[name] for name in item.minus)))


def budget_section(budget: BudgetFigure, result: FlightResult) -> Group:
    """Return the section with the table of a budget."""
    spent = consumption_by_phase(budget, result)
    unit = budget.of.spent.unit_name if budget.of.spent is not None else None
    amounts = [amount(item, spent, budget.bound) for item in budget.items]
    known = [value for value in amounts if value is not None]
    total = math.fsum(known) if len(known) == len(amounts) else None
    named = list(dict.fromkeys(name for item in budget.items for name in item.phases))
    used = math.fsum(spent[name] for name in named) if all(name in spent for name in named) else None
    names = [*(item.name for item in budget.items), "total", "consumption in these phases"]
    sources = [*map(_sum_text, budget.items), "", ", ".join(named)]
    numbers = align([*amounts, total, used], unit)
    notes = [f"Phase did not occur: {name}." for name in named if name not in spent]
    if budget.bound is not None and budget.bound.missing:
        notes.append(f"Bound not available: {budget.bound.missing}.")
    table = Table(("item", display_unit(unit), "sum of"), list(zip(names, numbers, sources, strict=True)))
    return figure_group(budget.title, table=table, notes=notes)


def _sum_text(item: BudgetItem) -> str:
    """Return the terms of an item."""
    parts = []
    if item.phases:
        parts.append(" + ".join(item.phases))
    if item.plus:
        parts.append(f"bound of {' + '.join(item.plus)}")
    terms = " + ".join(parts)
    return f"{terms} − bound of {' + '.join(item.minus)}" if item.minus else terms  # noqa: RUF001
