"""Pulses of jets: a lane for each axis with a bar for each pulse, and the thruster on-time so far."""

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
from ..common.quantities import label_with_unit, number
from ..common.style import BLUE, FAINT, VERMILION, plain_ticks
from .declared import Pulses
from .section import Section
from .words import sentence

LANE = 0.85  # in
TOTAL = 1.1  # in
BAR = 1.1  # pt; the duration of a pulse would not be visible


def pulse_lengths(pulses: Pulses, result: Result) -> np.ndarray:
    """Signed lengths (s) of the pulses that start at each sample, [axes, samples]; 0 where none starts.

    Pulses of the last sample are left out: a command acts over the step after its sample.
    """
    lengths = np.nan_to_num(pulses.lengths.values(result), nan=0.0, posinf=0.0, neginf=0.0)
    lengths[:, -1] = 0.0
    if pulses.count is not None:
        count = pulses.count.values(result)[0]
        lengths[:, 1:] *= count[1:] != count[:-1]
    return lengths


def pulse_section(pulses: Pulses, result: Result, name: str) -> Section:
    """The section of pulses; ``name`` must differ between the figures of a page."""
    lengths = pulse_lengths(pulses, result)
    if not np.any(lengths):
        return Section(title=pulses.title, findings=[Markup("No pulse was fired.")], notes=pulses.notes)
    return Section(
        title=pulses.title,
        plot=_figure(pulses, result, lengths, name),
        findings=[_findings(pulses, lengths)],
        notes=[_caption(pulses, result), *pulses.notes],
    )


def _figure(pulses: Pulses, result: Result, lengths: np.ndarray, name: str) -> Widths:
    heights = [LANE] * len(lengths) + [TOTAL] * (pulses.total is not None)
    reach = 1.1 * float(np.abs(lengths).max())
    rests = None if pulses.remainder is None else pulses.remainder.plot_values(result)
    if rests is not None:
        reach = max(reach, 1.1 * float(np.nanmax(np.abs(rests), initial=0.0)))

    def draw(figure: Figure) -> None:
        all_axes = figure.subplots(len(heights), 1, squeeze=False, sharex=True, height_ratios=heights)[:, 0]
        for index, axes in enumerate(all_axes[: len(lengths)]):
            remainder = None if rests is None else rests[index]
            _draw_lane(axes, result.time, lengths[index], remainder, reach)
            label = pulses.labels[index] or pulses.lengths.label
            axes.set_title(f"{label}, s", loc="left", pad=4)
        if pulses.total is not None:
            all_axes[-1].plot(result.time, pulses.total.plot_values(result)[0], color=BLUE)
            all_axes[-1].set_title(label_with_unit(pulses.total.label, pulses.total.unit_name), loc="left", pad=4)
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
    """All bars of one sign as a single path; a collection would repeat the style of each."""
    ends = np.stack([np.stack([time, time]), np.stack([np.zeros_like(lengths), lengths])])  # x and y, foot and head
    codes = np.tile(np.array([Path.MOVETO, Path.LINETO], dtype=np.uint8), time.size)
    path = Path(ends.transpose(2, 1, 0).reshape(-1, 2), codes)
    path.should_simplify = False  # it would drop bars
    return PathPatch(path, fill=False, edgecolor=colour, linewidth=BAR, capstyle="butt")


def _findings(pulses: Pulses, lengths: np.ndarray) -> Markup:
    text = _amount(lengths)
    if len(lengths) > 1:
        axes = (Markup("{} {}").format(label, _amount(row)) for label, row in zip(pulses.labels, lengths, strict=True))
        text = Markup("total {} ({})").format(text, Markup("; ").join(axes))
    return sentence(text)


def _amount(lengths: np.ndarray) -> Markup:
    """The number of pulses and their total duration."""
    count = int(np.count_nonzero(lengths))
    duration = exact(float(np.abs(lengths).sum()), digits=3)
    return Markup("{} {}, {} s").format(number(count), "pulse" if count == 1 else "pulses", duration)


def _caption(pulses: Pulses, result: Result) -> Markup:
    text = Markup("bars: {}, at the start of each pulse, height: its duration").format(pulses.lengths.label)
    if pulses.remainder is not None:
        is_zero = not np.any(pulses.remainder.values(result))
        line = Markup("{} is 0 throughout") if is_zero else Markup("thin line: {}")
        text = Markup("{}; {}").format(text, line.format(pulses.remainder.label))
    return sentence(text)
