"""A signal that is to come into a band and stay: the whole flight, the band close up, and from when on it stays."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter

from ...runtime.flight.results import Result
from ..common.page import exact
from ..common.panels import HALF_WIDTH, Panel, panel
from ..common.quantities import shown_factor, shown_unit
from ..common.style import FAINT, GREEN, INK, look
from .declaration.figures import Band
from .declaration.values import Signal
from .section import HEIGHT, Section, history_panel, legend_of, seconds, sentence

CLOSE = 3.0  # widths of the band that the close-up shows
DECADES = 100.0  # ratio of an abscissa's ends from which on it is logarithmic
FAR = 4.0  # widths of the band from which on the whole flight leaves too little of it to see


def inside(band: Band, result: Result) -> np.ndarray:
    """Where each element is within the band, limits included, elements by rows; nan is not."""
    values = band.values(result)
    low, high = (-np.inf if band.low is None else band.low), (np.inf if band.high is None else band.high)
    return (values >= low) & (values <= high) & np.isfinite(values)


def settled_row(held: np.ndarray) -> int | None:
    """The first row from which on a condition holds to the last one; None where it does not in that."""
    failing = np.flatnonzero(~held)
    row = int(failing[-1]) + 1 if failing.size else 0
    return None if row == held.size else row


def since(name: str, time: np.ndarray, held: np.ndarray) -> Markup:
    """From when on a condition, ``name``, holds."""
    row = settled_row(held)
    if row is None:
        return Markup("not {} at the end").format(name)
    return (
        Markup("{} throughout").format(name) if row == 0 else Markup("{} from {} on").format(name, seconds(time[row]))
    )


def band_section(band: Band, result: Result, name: str) -> Section:
    """The figures and findings of a band; ``name`` must differ between the figures of a page."""
    held, values, time = inside(band, result), band.shown(result), result.time
    row = settled_row(np.logical_and.reduce(held))
    factor, unit = shown_factor(band.signal.unit_name), shown_unit(band.signal.unit_name)
    low, high = (None if limit is None else factor * limit for limit in (band.low, band.high))
    close = None if low is None or high is None else _close_up(values, low, high)

    def draw(axes: Axes, limits: tuple[float, float] | None = None) -> None:
        for index, line in enumerate(values):
            style = look(index)
            axes.plot(time, line, color=style.colour, linestyle=style.dashes, marker="." if time.size == 1 else "")
        _shade(axes, low, high)
        for begin, end in _spans(band, result):
            axes.axvspan(begin, end, color=FAINT, alpha=0.35, linewidth=0.0)
        if limits is not None:
            axes.set_ylim(limits)
        if row:
            axes.axvline(time[row], color=INK, linewidth=0.9, linestyle=(0, (1, 2)))

    what = f"{band.title}: {', '.join(band.signal.names)} over time with the band"
    panels = [history_panel("The whole flight", f"{name}-whole", what, unit, time, draw)]
    if close is not None:
        label = "The band close up"
        panels.append(
            history_panel(label, f"{name}-close", f"{what}, close up", unit, time, lambda axes: draw(axes, close))
        )
    for number, other in enumerate(band.against):
        panels.append(_against(band, result, other, f"{name}-against{number}", (low, high)))
    return Section(
        title=band.title,
        panels=panels,
        legend=legend_of(band.labels),
        findings=[_findings(band, time, held)],
        notes=[_reading(band, unit, row), *(Markup("{}").format(note) for note in band.notes)],
    )


def _spans(band: Band, result: Result) -> list[tuple[float, float]]:
    """Begin and end (s) of the times that are shaded."""
    if band.shade is None:
        return []
    below = np.append(band.shade.values(result)[0] < band.shade_below, False).astype(int)
    edges = np.diff(np.append(0, below))
    time = np.append(result.time, result.time[-1])
    begins, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return [(float(time[begin]), float(time[end])) for begin, end in zip(begins, ends, strict=True)]


def _against(band: Band, result: Result, other: Signal, name: str, limits: tuple[float | None, float | None]) -> Panel:
    """The signal over another one, on a logarithmic scale where that spans decades."""
    across = other.shown(result)[0]
    decades = bool(np.all(across > 0.0)) and float(np.nanmax(across)) > DECADES * float(np.nanmin(across))
    unit = shown_unit(other.unit_name)

    def draw(axes: Axes) -> None:
        for index, line in enumerate(band.shown(result)):
            style = look(index)
            axes.plot(across, line, color=style.colour, linestyle=style.dashes)
        _shade(axes, *limits)
        if decades:
            axes.set_xscale("log")
            axes.xaxis.set_major_formatter("{x:g}")  # plain digits: the text of a figure is not set as mathematics
            axes.xaxis.set_minor_formatter(NullFormatter())
        axes.set_xlabel(f"{other.label}, {unit}" if unit else other.label)
        axes.set_title(shown_unit(band.signal.unit_name), loc="left", pad=4)

    label = f"Against {other.label.rpartition('.')[2].replace('_', ' ')}"
    return panel(label, name, f"{band.title} against {other.label}, with the band", draw, HEIGHT, HALF_WIDTH)


def _close_up(values: np.ndarray, low: float, high: float) -> tuple[float, float] | None:
    """The ordinate of a close-up; None where the whole flight shows the band well, or nothing comes near it."""
    finite = values[np.isfinite(values)]
    width = high - low
    margin = 0.5 * (CLOSE - 1.0) * width
    near = (finite >= low - margin) & (finite <= high + margin)
    if not np.any(near) or np.ptp(finite) <= FAR * width:
        return None
    return low - margin, high + margin


def _shade(axes: Axes, low: float | None, high: float | None) -> None:
    """The band between the limits, up to the edge of the panel where there is none."""
    limits = [limit for limit in (low, high) if limit is not None]
    for limit in limits:
        axes.axhline(limit, color=FAINT, linewidth=0.8)
    bottom, top = axes.get_ylim()
    axes.axhspan(bottom if low is None else low, top if high is None else high, color=GREEN, alpha=0.16, linewidth=0.0)
    axes.set_ylim(bottom, top)


def _findings(band: Band, time: np.ndarray, held: np.ndarray) -> Markup:
    words = since(band.name, time, np.logical_and.reduce(held))
    if len(held) == 1:
        return sentence(words)
    return sentence(
        Markup("{}: {}").format(words, Markup(", ").join(map(_element, band.labels, [time] * len(held), held)))
    )


def _element(label: str, time: np.ndarray, held: np.ndarray) -> Markup:
    row = settled_row(held)
    if row is None:
        return Markup("{} not").format(label)
    return Markup("{} throughout").format(label) if row == 0 else Markup("{} from {}").format(label, seconds(time[row]))


def _reading(band: Band, unit: str, row: int | None) -> Markup:
    """What is shaded and what was subtracted."""
    name = band.signal.unit_name
    if band.low is None or band.high is None:
        limit, word = (band.low, "from") if band.high is None else (band.high, "up to")
        words = Markup("shaded: {} {} {}").format(word, exact(limit, name), unit)
    else:
        words = Markup("shaded: {} to {} {}").format(exact(band.low, name), exact(band.high, name), unit)
    words = Markup("{} of {}").format(words, band.signal.label)
    if band.less is not None:
        words = Markup("{} less {}").format(words, band.less.label)
    if band.shade is not None:
        words = Markup("{}; grey: {} below {}").format(words, band.shade.label, exact(band.shade_below))
    if band.about:
        values = Markup(", ").join(exact(value, name) for value in band.about)
        words = Markup("{} less ({}) {}").format(words, values, unit)
    if row:
        words = Markup("{}; dotted: from there on {}").format(words, band.name)
    return sentence(words)
