"""Success probabilities of the variants of a batch with their confidence intervals."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ...campaigns.fly.results import BatchResult
from ...common.percent import percent
from ..common.panels import Widths, both_widths, is_slim
from ..common.style import INK, look, plain_ticks

LANE, SLIM_LANE = 0.36, 0.52  # in
RING: dict[str, Any] = {
    "linestyle": "", "marker": "o", "markersize": 11, "markerfacecolor": "none", "markeredgecolor": INK,
    "markeredgewidth": 1.2, "clip_on": False, "zorder": 4,
}  # fmt: skip


def rates_figure(result: BatchResult, published: Mapping[str, float] | None = None) -> Widths:
    """A mark per variant at its success probability, a bar over the interval, both labelled.

    ``published`` are rates to compare with, as fractions of 1, plotted as rings.
    """
    names = list(result.summary)
    others = [100.0 * rate for rate in (published or {}).values()]
    intervals = [[100.0 * end for end in result.summary[name].success_interval] for name in names]
    lowest = min([low for low, _ in intervals] + others)

    def draw(figure: Figure) -> None:
        slim = is_slim(figure)
        axes = figure.subplots()
        for index, (name, (low, high)) in enumerate(zip(names, intervals, strict=True)):
            rate = 100.0 * result.summary[name].success_rate
            _draw_rate(axes, index, rate, low, high)
            _write_rate(
                axes,
                index,
                name,
                f"{percent(rate / 100.0)} % ({percent(low / 100.0)} to {percent(high / 100.0)})",
                slim,
            )
            if published is not None and name in published:
                axes.plot(100.0 * published[name], index, **RING)
        axes.set_yticks(range(len(names)), [""] * len(names) if slim else names)
        axes.set_ylim(len(names) - 0.4, -0.8 if slim else -0.6)
        axes.set_xlim(max(-2.0, lowest - 0.06 * (100.0 - lowest) - 1.0), 100.0)
        axes.grid(visible=False, axis="y")
        axes.tick_params(axis="y", length=0, labelsize=9)
        plain_ticks(axes, x=5 if slim else 8)
        axes.set_xlabel(
            f"success probability, %, with {100.0 * result.summary[names[0]].confidence:g} % confidence interval"
        )
        if others:
            figure.legend([Line2D([], [], **RING)], ["published rate"], loc="outside upper right", borderpad=0.1)

    remainder = 0.75 + (0.25 if others else 0.0)
    description = "Success probabilities of " + ", ".join(names)
    return both_widths("rates", description, draw, remainder + LANE * len(names), remainder + SLIM_LANE * len(names))


def _draw_rate(axes: Axes, index: int, rate: float, low: float, high: float) -> None:
    colour, _, marker = look(index)
    axes.plot([low, high], [index, index], color=colour, linewidth=2.2, solid_capstyle="butt")
    for end in (low, high):
        axes.plot([end, end], [index - 0.16, index + 0.16], color=colour, linewidth=1.3, clip_on=False)
    axes.plot(rate, index, color=colour, marker=marker, markersize=7, clip_on=False, zorder=3)


def _write_rate(axes: Axes, index: int, name: str, label: str, slim: bool) -> None:
    """Write the rate next to its bar; on a narrow figure, name and rate above it."""
    if not slim:
        axes.annotate(label, (1.02, index), xycoords=("axes fraction", "data"), va="center")
        return
    for text, x, side in ((name, 0.0, "left"), (label, 1.0, "right")):
        axes.annotate(text, (x, index - 0.32), xycoords=("axes fraction", "data"), ha=side, va="bottom", fontsize=8.5)
