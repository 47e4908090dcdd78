"""One metric over another, a panel for each variant: the figures that a campaign asks for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from ...batch.results import BatchResult
from ...campaign.campaign import Metric, Scatter
from ..kit.page import exact
from ..kit.quantities import labelled, number, shown_factor, shown_unit
from ..kit.style import INK, VERMILION, WIDTH, house_style, new_figure, plain_ticks
from ..kit.svg import inline_svg
from .failures import GOOD, MANY

COLUMNS = 3
SIDE = 3.6  # in


@dataclass(frozen=True)
class ScatterFigure:
    """A heading, a figure and what is to be read of it."""

    title: str
    figure: Markup
    notes: list[Markup]


def scatter_figures(result: BatchResult) -> list[ScatterFigure]:
    """The figures of [scatter] in the order of the campaign."""
    return [_scatter_figure(result, scatter) for scatter in result.plan.campaign.scatters]


def _scatter_figure(result: BatchResult, scatter: Scatter) -> ScatterFigure:
    metrics = {metric.name: metric for metric in result.plan.campaign.metrics}
    pair = (metrics[scatter.x], metrics[scatter.y])
    points = {
        variant: np.stack([trials.metrics[metric.name] * shown_factor(metric.unit) for metric in pair])
        for variant, trials in result.trials.items()
    }
    title = scatter.title or f"{scatter.y} over {scatter.x}"
    columns = min(COLUMNS, len(points))
    rows = -(-len(points) // columns)
    with house_style():
        figure = new_figure(SIDE * rows + 0.2, WIDTH if columns > 1 else WIDTH / 2)
        all_axes = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).flatten()
        for axes, (variant, found) in zip(all_axes, points.items(), strict=False):
            _draw_panel(axes, variant, found, np.asarray(result.trials[variant].success, dtype=bool), pair, scatter)
        for axes in all_axes[len(points) :]:
            axes.remove()
        if pair[0].unit == pair[1].unit:
            _square(all_axes[0], np.concatenate(list(points.values()), axis=1), scatter, shown_factor(pair[0].unit))
        drawn = inline_svg(figure, f"scatter-{scatter.name}", f"{title}: {', '.join(points)}")
    return ScatterFigure(title, drawn, _reading(scatter, pair[0], points))


def _square(axes: Axes, points: np.ndarray, scatter: Scatter, factor: float) -> None:
    """All panels, which share their axes, to one scale of both, with all points and the circle in them."""
    points = points[:, np.all(np.isfinite(points), axis=0)]
    radius = 0.0 if scatter.circle is None else factor * scatter.circle
    ends = np.array([[-radius, radius]] * 2) if radius else np.empty((2, 0))
    everything = np.concatenate([points, ends], axis=1)
    if not everything.size:
        return
    low, high = everything.min(axis=1), everything.max(axis=1)
    middle, half = (low + high) / 2.0, 0.53 * float(np.max(high - low)) or 1.0
    axes.set_xlim(middle[0] - half, middle[0] + half)
    axes.set_ylim(middle[1] - half, middle[1] + half)
    for panel in axes.get_shared_x_axes().get_siblings(axes):
        panel.set_aspect("equal")


def _draw_panel(
    axes: Axes, variant: str, points: np.ndarray, good: np.ndarray, pair: tuple[Metric, Metric], scatter: Scatter
) -> None:
    image = good.size > MANY
    size = max(0.5, min(1.0, (500.0 / good.size) ** 0.5))
    axes.plot(
        *points[:, good], "o", markersize=3.4 * size, color=GOOD, markeredgewidth=0.0, rasterized=image,
        label=f"{int(good.sum())} successes",
    )  # fmt: skip
    axes.plot(
        *points[:, ~good], "x", markersize=5.0, color=VERMILION, markeredgewidth=1.3, rasterized=image,
        label=f"{int((~good).sum())} failures",
    )  # fmt: skip
    if scatter.circle is not None:
        radius = scatter.circle * shown_factor(pair[0].unit)
        axes.add_patch(Circle((0.0, 0.0), radius, fill=False, edgecolor=INK, linewidth=1.0, linestyle=(0, (4, 2))))
        axes.plot(0.0, 0.0, "+", color=INK, markersize=8)
    plain_ticks(axes, x=5, y=6)
    axes.set_xlabel(labelled(pair[0].name, pair[0].unit))
    axes.set_ylabel(labelled(pair[1].name, pair[1].unit))
    axes.set_title(variant, loc="left", pad=24, fontweight="bold")
    axes.legend(
        loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=2, borderpad=0.2, handletextpad=0.2, columnspacing=1.0
    )


def _reading(scatter: Scatter, metric: Metric, points: dict[str, np.ndarray]) -> list[Markup]:
    """What the circle is, and how many trials have no point."""
    notes = []
    if scatter.circle is not None:
        radius = exact(scatter.circle, metric.unit)
        notes.append(Markup("Dashed: {} {} around the origin.").format(radius, shown_unit(metric.unit)))
    for variant, found in points.items():
        lacking = int(np.count_nonzero(~np.all(np.isfinite(found), axis=0)))
        if lacking:
            words = Markup("{}: {} of {} trials have no finite value and no mark.")
            notes.append(words.format(variant, number(lacking), number(found.shape[1])))
    return notes
