"""The phases of a flight: when each was flown and what it used, a timeline, a table, and the propellant budget."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...runtime.flight.results import Flight, Result
from ..common.page import Table, exact
from ..common.panels import Widths, both_widths, is_slim
from ..common.quantities import display_unit, label_with_unit, number
from ..common.style import BLUE, FAINT, INK, VERMILION, label_lanes, plain_ticks
from .declared import BoundValues, Budget, Item, Phase, Phases
from .section import Section, align
from .words import seconds, sentence


@dataclass(frozen=True)
class Span:
    """A phase from ``begin`` to ``end`` (s); ``spent`` is its consumption, None where that is not declared."""

    name: str
    begin: float
    end: float
    spent: float | None


def spans_of(phases: Phases, flight: Flight) -> list[Span]:
    """The phases in the order of the flight; a value without a name is its own name.

    A phase lasts from its first sample to the first sample of the next one, the last phase to the end.
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
        Span(
            name=name,
            begin=float(flight.time[first]),
            end=float(flight.time[last]),
            spent=None if spent is None else float(spent[first] - spent[last]),
        )
        for (first, name), last in zip(firsts, lasts, strict=True)
    ]


def _subphases(named: Sequence[Phase], flight: Flight, begin: int, end: int) -> list[tuple[int, str]]:
    """First row and name of the phases with the same value, between two rows; a phase without a row is left out."""
    starts: list[tuple[int, str]] = []
    for phase in named:
        over = end
        if phase.until is not None:
            over = begin + int(np.argmax(np.append(phase.until.values(flight)[0][begin:end] != 0.0, True)))
        if over > begin:
            starts.append((begin, phase.name))
        begin = over
    return starts


def statuses_of(phases: Phases, flight: Flight) -> list[tuple[int, float]] | None:
    """Each status and the time (s) of its first occurrence, in order of time; None where no status is declared."""
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
LONG = 0.5  # fraction of the flight without an event from which the time axis is broken
MARGIN = 0.06  # of the remaining time, shown on either side of the break
NEAR_THE_EDGE = 0.88  # of a window, from which the duration is written on the left of a bar
Window = tuple[float, float]


def phase_section(phases: Phases, result: Result, name: str) -> Section:
    """The section of the phases; ``name`` must differ between the figures of a page."""
    spans, statuses = spans_of(phases, result), statuses_of(phases, result)
    windows = _windows(spans, statuses or [])
    notes = [Markup("Bars: phases with their duration, s.")]
    if len(windows) > 1:
        left_out = windows[1][0] - windows[0][1]
        notes[0] = Markup("{} Axis break: {} omitted.").format(notes[0], seconds(left_out))
    return Section(
        title=phases.title,
        plot=_figure(phases, spans, statuses or [], windows, name),
        table=_table(phases, spans),
        findings=[] if statuses is None else _findings(phases, statuses),
        notes=[*notes, *phases.notes],
    )


def _windows(spans: Sequence[Span], statuses: Sequence[tuple[int, float]]) -> list[Window]:
    """The time windows of the plot: the flight, or what is before and after a long interval without an event."""
    begin, end = spans[0].begin, spans[-1].end
    events = sorted({begin, end, *(span.begin for span in spans), *(time for _, time in statuses)})
    length, left, right = max(
        (right - left, left, right) for left, right in zip(events, [*events[1:], end], strict=True)
    )
    margin = MARGIN * (end - begin - length)
    if not margin > 0.0 or length <= LONG * (end - begin):
        return [(begin, end)]
    return [(begin, left + margin), (right - margin, end)]


def _figure(
    phases: Phases, spans: Sequence[Span], statuses: Sequence[tuple[int, float]], windows: Sequence[Window], name: str
) -> Widths:
    lanes = list(dict.fromkeys(span.name for span in spans))
    widths = [end - begin or 1.0 for begin, end in windows]

    def draw(figure: Figure) -> None:
        all_axes = figure.subplots(1, len(windows), squeeze=False, sharey=True, width_ratios=widths)[0]
        for axes, (begin, end), width in zip(all_axes, windows, widths, strict=True):
            for span in spans:
                _draw_bar(axes, span, lanes.index(span.name), begin, end)
            _draw_statuses(axes, [(status, time) for status, time in statuses if begin <= time <= end])
            axes.set_xlim(begin, begin + width)
            label_lanes(axes, lanes)
            plain_ticks(axes, x=max(2, round((5 if is_slim(figure) else 10) * width / sum(widths))))
        if len(windows) > 1:
            _draw_cut(*all_axes)
        figure.supxlabel("time, s", fontsize=9, color=INK)

    description = f"{phases.title}: {', '.join(lanes)} over time"
    return both_widths(name, description, draw, 0.75 + LANE * len(lanes))


def _draw_bar(axes: Axes, span: Span, lane: int, begin: float, end: float) -> None:
    """The part of a phase within a window, with its whole duration where it ends."""
    left, right = max(span.begin, begin), min(span.end, end)
    if right < left or (right == left and span.end > span.begin):
        return
    axes.barh(lane, right - left, left=left, height=0.62, color=BLUE, edgecolor=BLUE, linewidth=0.8)
    if span.end > end:
        return
    before = right > begin + NEAR_THE_EDGE * (end - begin)
    axes.annotate(
        number(span.end - span.begin, 4), (left if before else right, lane), xytext=(-4 if before else 4, 0),
        textcoords="offset points", ha="right" if before else "left", va="center", fontsize=8, color=INK,
    )  # fmt: skip


def _draw_statuses(axes: Axes, statuses: Sequence[tuple[int, float]]) -> None:
    by_time: dict[float, list[int]] = {}
    for status, time in statuses:
        by_time.setdefault(time, []).append(status)
    for time, numbers in by_time.items():
        axes.axvline(time, color=VERMILION, linewidth=1.1, linestyle=(0, (4, 2)))
        axes.annotate(
            ", ".join(map(str, numbers)), (time, 1.0), xycoords=("data", "axes fraction"), xytext=(0, 3),
            textcoords="offset points", ha="center", fontsize=8, color=VERMILION, fontweight="bold",
        )  # fmt: skip


def _draw_cut(left: Axes, right: Axes) -> None:
    """Slanted strokes at the break of the time axis."""
    left.spines["right"].set_visible(False)
    right.spines["left"].set_visible(False)
    for axes, x in ((left, 1.0), (right, 0.0)):
        axes.plot(
            [x, x], [0.0, 1.0], transform=axes.transAxes, clip_on=False, linestyle="", color=FAINT,
            marker=[(-0.6, -1.0), (0.6, 1.0)], markersize=9, markeredgewidth=1.0,
        )  # fmt: skip


def _table(phases: Phases, spans: Sequence[Span]) -> Table:
    heads = ["phase", "start, s", "duration, s"]
    unit = None if phases.spent is None else phases.spent.unit_name
    if phases.spent is not None:
        is_mass = phases.spent.label.rpartition(".")[2] == "mass"
        heads.append(label_with_unit("propellant" if is_mass else "consumption", unit))
    spent = [span.spent for span in spans if span.spent is not None]
    rows = [*spans, Span("total", spans[0].begin, spans[-1].end, sum(spent) if spent else None)]
    columns = [
        [span.name for span in rows],
        [exact(span.begin, digits=6) for span in rows],
        [exact(span.end - span.begin, digits=6) for span in rows],
        *([align([span.spent for span in rows], unit)] if phases.spent is not None else []),
    ]
    return Table(tuple(heads), list(zip(*columns, strict=True)), numbers=(1, 2, 3))


def _findings(phases: Phases, statuses: Sequence[tuple[int, float]]) -> list[Markup]:
    """Each status with the time of its first occurrence and its meaning."""
    if not statuses:
        return [Markup("Status 0 throughout.")]
    return [
        sentence(Markup("status {} at {}: {}").format(number(status), seconds(time), phases.meanings[status]))
        if status in phases.meanings
        else sentence(Markup("status {} at {}").format(number(status), seconds(time)))
        for status, time in statuses
    ]


def consumption_by_phase(budget: Budget, result: Result) -> dict[str, float]:
    """The consumption of each phase that occurred, summed over its occurrences."""
    spent: dict[str, float] = {}
    for span in spans_of(budget.of, result):
        assert span.spent is not None  # the reader of a budget demands it
        spent[span.name] = spent.get(span.name, 0.0) + span.spent
    return spent


def amount(item: Item, spent: Mapping[str, float], bound: BoundValues | None) -> float | None:
    """The amount of an item; None where one of its phases did not occur or the bound is missing."""
    values = {} if bound is None else bound.values
    if any(name not in spent for name in item.phases) or any(name not in values for name in (*item.plus, *item.minus)):
        return None
    used = (spent[name] for name in item.phases)
    return math.fsum((*used, *(values[name] for name in item.plus), *(-values[name] for name in item.minus)))


def budget_section(budget: Budget, result: Result) -> Section:
    """The table of a budget."""
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
    notes = [Markup("Phase did not occur: {}.").format(name) for name in named if name not in spent]
    if budget.bound is not None and budget.bound.missing:
        notes.append(Markup("Bound not available: {}.").format(budget.bound.missing))
    return Section(
        title=budget.title,
        table=Table(
            heads=("item", display_unit(unit), "sum of"),
            rows=list(zip(names, numbers, sources, strict=True)),
            numbers=(1,),
        ),
        notes=notes,
    )


def _sum_text(item: Item) -> str:
    """The terms of an item."""
    parts = []
    if item.phases:
        parts.append(" + ".join(item.phases))
    if item.plus:
        parts.append(f"bound of {' + '.join(item.plus)}")
    terms = " + ".join(parts)
    return f"{terms} − bound of {' + '.join(item.minus)}" if item.minus else terms  # noqa: RUF001
