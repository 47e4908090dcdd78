"""One metric over another, a panel for each variant: the figures that a campaign asks for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from ...campaigns.fly.results import BatchResult
from ...campaigns.spec.campaign import Metric, Scatter
from ..common.page import exact
from ..common.panels import Panel, panel
from ..common.quantities import labelled, number, shown_factor, shown_unit
from ..common.style import INK, VERMILION, plain_ticks
from .failures import GOOD, MANY

SIDE = 3.4  # in


@dataclass(frozen=True)
class ScatterFigure:
    """A heading, a panel for each variant and what is to be read of them."""

    title: str
    panels: list[Panel]
    notes: list[Markup]


def scatter_figures(result: BatchResult) -> list[ScatterFigure]:
    """The figures of [scatter] in the order of the campaign."""
    return [_scatter_figure(result, scatter) for scatter in result.plan.campaign.scatters]


def _scatter_figure(result: BatchResult, scatter: Scatter) -> ScatterFigure:
    metrics = {metric.name: metric for metric in result.plan.campaign.metrics}
    pair = (metrics[scatter.x], metrics[scatter.y])
    points = {
        variant: np.stack([seen.dots.metrics[metric.name] * shown_factor(metric.unit) for metric in pair])
        for variant, seen in result.shown.items()
    }
    title = scatter.title or f"{scatter.y} over {scatter.x}"
    everything = np.concatenate(list(points.values()), axis=1)
    limits = _limits(everything, 0.0 if scatter.circle is None else shown_factor(pair[0].unit) * scatter.circle)
    to_scale = pair[0].unit == pair[1].unit
    if to_scale and limits is not None:
        limits = _square(limits)

    def drawing(variant: str) -> Callable[[Axes], None]:
        good = result.shown[variant].dots.success
        return lambda axes: _draw_panel(axes, points[variant], good, pair, scatter, limits, to_scale)

    panels = [
        panel(variant, f"scatter-{scatter.name}-{index}", f"{title}: {variant}", drawing(variant), SIDE)
        for index, variant in enumerate(points)
    ]
    return ScatterFigure(title, panels, _reading(scatter, pair[0], points))


def _limits(points: np.ndarray, radius: float) -> np.ndarray | None:
    """Low and high ends of both axes, a row each, with all finite points and the circle in them; None without any."""
    points = points[:, np.all(np.isfinite(points), axis=0)]
    ends = np.array([[-radius, radius]] * 2) if radius else np.empty((2, 0))
    everything = np.concatenate([points, ends], axis=1)
    if not everything.size:
        return None
    low, high = everything.min(axis=1), everything.max(axis=1)
    margin = np.where(high > low, 0.05 * (high - low), 0.5)
    return np.stack([low - margin, high + margin], axis=1)


def _square(limits: np.ndarray) -> np.ndarray:
    """Both axes as long as the longer one."""
    middle, half = limits.mean(axis=1), 0.5 * float(np.max(np.ptp(limits, axis=1)))
    return np.stack([middle - half, middle + half], axis=1)


def _draw_panel(
    axes: Axes,
    points: np.ndarray,
    good: np.ndarray,
    pair: tuple[Metric, Metric],
    scatter: Scatter,
    limits: np.ndarray | None,
    to_scale: bool,
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
    if limits is not None:
        axes.set_xlim(*limits[0])
        axes.set_ylim(*limits[1])
    if to_scale:
        axes.set_aspect("equal")
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
