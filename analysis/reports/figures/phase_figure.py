"""The phases of a flight: when each was flown and what it used, a timeline, and a table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...runtime.flight.results import Flight, Result
from ..common.page import exact
from ..common.panels import Widths, both_widths, is_slim
from ..common.quantities import number, shown_unit
from ..common.style import BLUE, FAINT, INK, VERMILION, plain_ticks
from ..common.tables import Table
from .declaration.figures import Phase, Phases
from .section import Section, evenly, seconds, sentence


@dataclass(frozen=True)
class Span:
    """A phase from ``begin`` to ``end`` (s); ``spent`` is what it used up, None where that is not told."""

    name: str
    begin: float
    end: float
    spent: float | None


def spans_of(phases: Phases, flight: Flight) -> list[Span]:
    """The phases as they were flown, one after the other; a value without a name is its own.

    A phase is from the row in which its value stands first to that of the next one, the last to the end.
    """
    values = phases.signal.values(flight)[0]
    starts = [(0, values[0]), *((int(row) + 1, values[row + 1]) for row in np.flatnonzero(np.diff(values)))]
    ends = [row for row, _ in starts[1:]] + [values.size]
    firsts: list[tuple[int, str]] = []
    for (begin, value), end in zip(starts, ends, strict=True):
        named = [phase for phase in phases.phases if phase.value == value]
        firsts += _parts(named, flight, begin, end) if named else [(begin, f"{phases.signal.label} {value:g}")]
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


def _parts(named: Sequence[Phase], flight: Flight, begin: int, end: int) -> list[tuple[int, str]]:
    """First row and name of the phases that share a value, between two rows; one that takes no row is left out."""
    found: list[tuple[int, str]] = []
    for phase in named:
        over = end
        if phase.until is not None:
            over = begin + int(np.argmax(np.append(phase.until.values(flight)[0][begin:end] != 0.0, True)))
        if over > begin:
            found.append((begin, phase.name))
        begin = over
    return found


def statuses_of(phases: Phases, flight: Flight) -> list[tuple[int, float]] | None:
    """Each status and when (s) it was there first, in order of time; None where statuses are not told."""
    if phases.status_times is not None:
        times = phases.status_times.values(flight)[:, -1]
        found = [(index, float(time)) for index, time in enumerate(times, 1) if time >= 0.0]
        return sorted(found, key=lambda entry: entry[1])
    if phases.status is None:
        return None
    values = phases.status.values(flight)[0]
    before = np.maximum.accumulate(np.concatenate([[0.0], values[:-1]]))
    return [(int(values[row]), float(flight.time[row])) for row in np.flatnonzero(values > before)]


LANE = 0.27  # in
LONG = 0.5  # share of the flight in which nothing happens from which on it is cut, so that the rest is seen
KEPT = 0.06  # of that rest, what is left of the cut time at either end
NEAR_THE_EDGE = 0.88  # of a window, from where on a bar's duration stands on its left
Window = tuple[float, float]


def phase_section(phases: Phases, result: Result, name: str) -> Section:
    """The figure, table and statuses of the phases; ``name`` must differ between the figures of a page."""
    spans, statuses = spans_of(phases, result), statuses_of(phases, result)
    windows = _windows(spans, statuses or [])
    notes = [Markup("A bar for each phase with how long it takes, s.")]
    if len(windows) > 1:
        left_out = windows[1][0] - windows[0][1]
        notes[0] = Markup("{} The time is cut by {}.").format(notes[0], seconds(left_out))
    return Section(
        title=phases.title,
        drawn=_figure(phases, spans, statuses or [], windows, name),
        table=_table(phases, spans),
        findings=[] if statuses is None else _findings(phases, statuses),
        notes=[*notes, *(Markup("{}").format(note) for note in phases.notes)],
    )


def _windows(spans: Sequence[Span], statuses: Sequence[tuple[int, float]]) -> list[Window]:
    """The times that are drawn: all, or those before and after a time when long nothing happens within a phase."""
    begin, end = spans[0].begin, spans[-1].end
    events = sorted({begin, end, *(span.begin for span in spans), *(time for _, time in statuses)})
    length, left, right = max(
        (right - left, left, right) for left, right in zip(events, [*events[1:], end], strict=True)
    )
    kept = KEPT * (end - begin - length)
    if not kept > 0.0 or length <= LONG * (end - begin):
        return [(begin, end)]
    return [(begin, left + kept), (right - kept, end)]


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
            axes.grid(visible=False, axis="y")
            axes.tick_params(axis="y", length=0, labelsize=9)
            plain_ticks(axes, x=max(2, round((5 if is_slim(figure) else 10) * width / sum(widths))))
        all_axes[0].set_yticks(range(len(lanes)), lanes)
        all_axes[0].set_ylim(len(lanes) - 0.4, -0.6)
        if len(windows) > 1:
            _draw_cut(*all_axes)
        figure.supxlabel("time, s", fontsize=9, color=INK)

    words = f"{phases.title}: {', '.join(lanes)} over time"
    return both_widths(name, words, draw, 0.75 + LANE * len(lanes))


def _draw_bar(axes: Axes, span: Span, lane: int, begin: float, end: float) -> None:
    """The part of a phase that a window shows, with its whole duration where it ends."""
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
    together: dict[float, list[int]] = {}
    for status, time in statuses:
        together.setdefault(time, []).append(status)
    for time, found in together.items():
        axes.axvline(time, color=VERMILION, linewidth=1.1, linestyle=(0, (4, 2)))
        axes.annotate(
            ", ".join(map(str, found)), (time, 1.0), xycoords=("data", "axes fraction"), xytext=(0, 3),
            textcoords="offset points", ha="center", fontsize=8, color=VERMILION, fontweight="bold",
        )  # fmt: skip


def _draw_cut(left: Axes, right: Axes) -> None:
    """Slanted strokes where the axis of time goes on later."""
    left.spines["right"].set_visible(False)
    right.spines["left"].set_visible(False)
    for axes, x in ((left, 1.0), (right, 0.0)):
        axes.plot(
            [x, x], [0.0, 1.0], transform=axes.transAxes, clip_on=False, linestyle="", color=FAINT,
            marker=[(-0.6, -1.0), (0.6, 1.0)], markersize=9, markeredgewidth=1.0,
        )  # fmt: skip


def _table(phases: Phases, spans: Sequence[Span]) -> Table:
    heads = ["phase", "begins, s", "takes, s"]
    unit = None if phases.spent is None else phases.spent.unit_name
    if phases.spent is not None:
        heads.append(f"uses up, {shown_unit(unit)}" if shown_unit(unit) else "uses up")
    whole = [*spans, _whole(spans)]
    columns = [
        [span.name for span in whole],
        [exact(span.begin, digits=6) for span in whole],
        [exact(span.end - span.begin, digits=6) for span in whole],
        *([evenly([span.spent for span in whole], unit)] if phases.spent is not None else []),
    ]
    return Table(tuple(heads), list(zip(*columns, strict=True)), numbers=(1, 2, 3))


def _whole(spans: Sequence[Span]) -> Span:
    spent = [span.spent for span in spans if span.spent is not None]
    return Span("all", spans[0].begin, spans[-1].end, sum(spent) if spent else None)


def _findings(phases: Phases, statuses: Sequence[tuple[int, float]]) -> list[Markup]:
    """What each status means and when it was there first."""
    if not statuses:
        return [Markup("Status 0 throughout.")]
    return [
        sentence(Markup("status {} at {}: {}").format(number(status), seconds(time), phases.meanings[status]))
        if status in phases.meanings
        else sentence(Markup("status {} at {}").format(number(status), seconds(time)))
        for status, time in statuses
    ]
