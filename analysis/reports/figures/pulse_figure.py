"""Pulses of jets: a lane for each axis with a bar for each pulse that was fired, and what was spent so far."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from ...runtime.flight.results import Result
from ..common.page import exact
from ..common.panels import Widths, both_widths, is_slim
from ..common.quantities import labelled, number
from ..common.style import BLUE, FAINT, VERMILION, plain_ticks
from .declaration.figures import Pulses
from .section import Section, sentence

LANE = 0.85  # in
SPENT = 1.1  # in
BAR = 1.1  # pt; a pulse's own width would not be seen


def fired(pulses: Pulses, result: Result) -> np.ndarray:
    """Lengths (s) of the pulses that begin in each row, with their sign, axes by rows; 0 where none does.

    Those that are still to begin in the last row are not: what is commanded in a row acts over the step after it.
    """
    lengths = np.nan_to_num(pulses.lengths.values(result), nan=0.0, posinf=0.0, neginf=0.0)
    lengths[:, -1] = 0.0
    if pulses.count is not None:
        count = pulses.count.values(result)[0]
        lengths[:, 1:] *= count[1:] != count[:-1]
    return lengths


def pulse_section(pulses: Pulses, result: Result, name: str) -> Section:
    """The figure and findings of pulses; ``name`` must differ between the figures of a page."""
    lengths = fired(pulses, result)
    notes = [Markup("{}").format(note) for note in pulses.notes]
    if not np.any(lengths):
        return Section(title=pulses.title, findings=[Markup("No pulse was fired.")], notes=notes)
    return Section(
        title=pulses.title,
        drawn=_figure(pulses, result, lengths, name),
        findings=[_findings(pulses, lengths)],
        notes=[_reading(pulses, result), *notes],
    )


def _figure(pulses: Pulses, result: Result, lengths: np.ndarray, name: str) -> Widths:
    heights = [LANE] * len(lengths) + [SPENT] * (pulses.total is not None)
    reach = 1.1 * float(np.abs(lengths).max())
    rests = None if pulses.remainder is None else pulses.remainder.shown(result)
    if rests is not None:
        reach = max(reach, 1.1 * float(np.nanmax(np.abs(rests), initial=0.0)))

    def draw(figure: Figure) -> None:
        all_axes = figure.subplots(len(heights), 1, squeeze=False, sharex=True, height_ratios=heights)[:, 0]
        for index, axes in enumerate(all_axes[: len(lengths)]):
            rest = None if rests is None else rests[index]
            _draw_lane(axes, result.time, lengths[index], rest, reach)
            label = pulses.labels[index] or pulses.lengths.label
            axes.set_title(f"{label}, s", loc="left", pad=4)
        if pulses.total is not None:
            all_axes[-1].plot(result.time, pulses.total.shown(result)[0], color=BLUE)
            all_axes[-1].set_title(labelled(pulses.total.label, pulses.total.unit_name), loc="left", pad=4)
            plain_ticks(all_axes[-1], y=3)
        plain_ticks(all_axes[-1], x=5 if is_slim(figure) else 10)
        all_axes[-1].set_xlim(result.time[0], result.time[-1])
        all_axes[-1].set_xlabel("time, s")

    description = f"{pulses.title}: a bar for each pulse of {', '.join(pulses.lengths.names)}"
    return both_widths(name, description, draw, 0.45 + sum(heights))


def _draw_lane(axes: Axes, time: np.ndarray, lengths: np.ndarray, rest: np.ndarray | None, reach: float) -> None:
    axes.axhline(0.0, color=FAINT, linewidth=0.6)
    for sign, colour in ((1.0, BLUE), (-1.0, VERMILION)):
        rows = np.flatnonzero(sign * lengths > 0.0)
        if rows.size:
            axes.add_patch(_bars(time[rows], lengths[rows], colour))
    if rest is not None and np.any(rest):
        axes.plot(time, rest, color=FAINT, linewidth=0.6, zorder=0.9)  # below the bars
    axes.set_ylim(-reach, reach)
    plain_ticks(axes, y=3)


def _bars(time: np.ndarray, lengths: np.ndarray, colour: str) -> PathPatch:
    """All bars of one sign as a single path: a collection would repeat its style for each."""
    ends = np.stack([np.stack([time, time]), np.stack([np.zeros_like(lengths), lengths])])  # x and y, foot and head
    codes = np.tile(np.array([Path.MOVETO, Path.LINETO], dtype=np.uint8), time.size)
    path = Path(ends.transpose(2, 1, 0).reshape(-1, 2), codes)
    path.should_simplify = False  # it would leave bars out
    return PathPatch(path, fill=False, edgecolor=colour, linewidth=BAR, capstyle="butt")


def _findings(pulses: Pulses, lengths: np.ndarray) -> Markup:
    words = _amount(lengths)
    if len(lengths) > 1:
        axes = (Markup("{} {}").format(label, _amount(own)) for label, own in zip(pulses.labels, lengths, strict=True))
        words = Markup("{} in all: {}").format(words, Markup("; ").join(axes))
    return sentence(words)


def _amount(lengths: np.ndarray) -> Markup:
    """How many pulses, how long together."""
    count = int(np.count_nonzero(lengths))
    word = "pulse" if count == 1 else "pulses"
    return Markup("{} {}, {} s").format(number(count), word, exact(float(np.abs(lengths).sum()), digits=3))


def _reading(pulses: Pulses, result: Result) -> Markup:
    words = Markup("bars: {}, each as high as the pulse is long, at the time at which it begins").format(
        pulses.lengths.label
    )
    if pulses.remainder is not None:
        still = not np.any(pulses.remainder.values(result))
        line = Markup("{} is 0 throughout") if still else Markup("thin line: {}")
        words = Markup("{}; {}").format(words, line.format(pulses.remainder.label))
    return sentence(words)
