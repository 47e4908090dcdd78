"""Scatter plots of successes and failures, a panel per variant: over declared metrics, and over influential inputs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from ...campaigns.draws.declared import input_names
from ...campaigns.fly.results import BatchResult
from ...campaigns.spec.campaign import Metric, Scatter
from ..common.page import exact
from ..common.panels import Panel, panel
from ..common.quantities import display_factor, display_unit, label_with_unit, number
from ..common.style import INK, VERMILION, plain_ticks
from ..interactive.lines import TrialDots

SIDE = 3.4  # in, of a panel over metrics
HEIGHT = 3.2  # in, of a panel over inputs
SUCCESS = "#9a9a9a"
MANY = 3000  # points of a panel from which they are stored as an image


def plot_outcomes(
    axes: Axes,
    variant: str,
    points: tuple[np.ndarray, np.ndarray],
    names: tuple[str, str],
    success: np.ndarray,
    minimum_size: float,
) -> None:
    """Successes as dots and failures as crosses, with their numbers in a legend; marks shrink as points grow many.

    ``points`` are abscissas and ordinates of the trials of a ``variant``, ``names`` the columns that they are from.
    """
    size = max(minimum_size, min(1.0, (500.0 / success.size) ** 0.5))
    for outcome, marker, diameter, edge, colour, text in (
        (True, "o", 3.2, 0.0, SUCCESS, "successes"), (False, "x", 4.5, 1.3, VERMILION, "failures")
    ):  # fmt: skip
        rows = success if outcome else ~success
        dots = TrialDots(
            points[0][rows], points[1][rows], variant=variant, names=names, success=outcome, color=colour, linestyle="",
            marker=marker, markersize=diameter * size, markeredgewidth=edge * size, rasterized=success.size > MANY,
            label=f"{int(rows.sum())} {text}",
        )  # fmt: skip
        axes.add_line(dots)
    axes.autoscale_view()
    plain_ticks(axes, x=5, y=6)
    axes.legend(
        loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=2, borderpad=0.2, handletextpad=0.2, columnspacing=1.0,
        markerscale=1.0 / size,
    )  # fmt: skip


@dataclass(frozen=True)
class ScatterFigure:
    """A heading, a panel for each variant, and captions."""

    title: str
    panels: list[Panel]
    notes: list[Markup]


def scatter_figures(result: BatchResult) -> list[ScatterFigure]:
    """The plots of [scatter] in the order of the campaign."""
    return [_scatter_figure(result, scatter) for scatter in result.plan.campaign.scatters]


def _scatter_figure(result: BatchResult, scatter: Scatter) -> ScatterFigure:
    metrics = {metric.name: metric for metric in result.plan.campaign.metrics}
    pair = (metrics[scatter.x], metrics[scatter.y])
    points = {
        variant: np.stack([sample.dots.metrics[metric.name] * display_factor(metric.unit) for metric in pair])
        for variant, sample in result.plotted.items()
    }
    title = scatter.title or f"{scatter.y} vs. {scatter.x}"
    everything = np.concatenate(list(points.values()), axis=1)
    limits = _limits(everything, 0.0 if scatter.circle is None else display_factor(pair[0].unit) * scatter.circle)
    to_scale = pair[0].unit == pair[1].unit
    if to_scale and limits is not None:
        limits = _square(limits)

    panels = []
    for index, (variant, values) in enumerate(points.items()):

        def draw(axes: Axes, variant: str = variant, values: np.ndarray = values) -> None:
            success = result.plotted[variant].dots.success
            columns = (f"metric.{scatter.x}", f"metric.{scatter.y}")
            plot_outcomes(axes, variant, (values[0], values[1]), columns, success, minimum_size=0.5)
            _frame(axes, pair, scatter, limits, to_scale)

        panels.append(panel(variant, f"scatter-{scatter.name}-{index}", f"{title}: {variant}", draw, SIDE))
    return ScatterFigure(title, panels, _notes(scatter, pair[0], points))


def _limits(points: np.ndarray, radius: float) -> np.ndarray | None:
    """Limits of both axes, a row each, that contain all finite points and the circle; None without any."""
    points = points[:, np.all(np.isfinite(points), axis=0)]
    ends = np.array([[-radius, radius]] * 2) if radius else np.empty((2, 0))
    everything = np.concatenate([points, ends], axis=1)
    if not everything.size:
        return None
    low, high = everything.min(axis=1), everything.max(axis=1)
    margin = np.where(high > low, 0.05 * (high - low), 0.5)
    return np.stack([low - margin, high + margin], axis=1)


def _square(limits: np.ndarray) -> np.ndarray:
    """Limits of equal length."""
    middle, half = limits.mean(axis=1), 0.5 * float(np.max(np.ptp(limits, axis=1)))
    return np.stack([middle - half, middle + half], axis=1)


def _frame(
    axes: Axes, pair: tuple[Metric, Metric], scatter: Scatter, limits: np.ndarray | None, to_scale: bool
) -> None:
    if scatter.circle is not None:
        radius = scatter.circle * display_factor(pair[0].unit)
        axes.add_patch(Circle((0.0, 0.0), radius, fill=False, edgecolor=INK, linewidth=1.0, linestyle=(0, (4, 2))))
        axes.plot(0.0, 0.0, "+", color=INK, markersize=8)
    axes.set_xlabel(label_with_unit(pair[0].name, pair[0].unit))
    axes.set_ylabel(label_with_unit(pair[1].name, pair[1].unit))
    if limits is not None:
        axes.set_xlim(*limits[0])
        axes.set_ylim(*limits[1])
    if to_scale:
        axes.set_aspect("equal")


def _notes(scatter: Scatter, metric: Metric, points: dict[str, np.ndarray]) -> list[Markup]:
    """The caption of the circle, and the number of trials without a point."""
    notes = []
    if scatter.circle is not None:
        radius = exact(scatter.circle, metric.unit)
        notes.append(Markup("Dashed: {} {} around the origin.").format(radius, display_unit(metric.unit)))
    for variant, values in points.items():
        lacking = int(np.count_nonzero(~np.all(np.isfinite(values), axis=0)))
        if lacking:
            text = Markup("{}: {} of {} trials have no finite value and are not plotted.")
            notes.append(text.format(variant, number(lacking), number(values.shape[1])))
    return notes


def influence_on_success(result: BatchResult, variant: str) -> dict[str, float]:
    """The influence of each dispersed input on success, 0 to 1, largest first.

    It is the larger absolute correlation with success, of the input or of its distance from its mean; the latter sees
    failures at both ends. Inputs that do not vary and derived values are left out; so are all inputs without both
    failures and successes.
    """
    success = result.plotted[variant].dots.success.astype(float)
    if success.min() == success.max():
        return {}
    influence = {}
    for name in input_names(result.plan.campaign):
        values = result.plotted[variant].dots.draws[name]
        columns = [column for column in (values, np.abs(values - values.mean())) if np.ptp(column) > 0.0]
        if columns:
            influence[name] = max(abs(float(np.corrcoef(success, column)[0, 1])) for column in columns)
    return dict(sorted(influence.items(), key=lambda item: -item[1]))


def failure_panels(result: BatchResult) -> list[Panel]:
    """Failures and successes over the two most influential inputs of each variant that has both."""
    panels = []
    for index, variant in enumerate(result.rows):
        names = list(influence_on_success(result, variant))[:2]

        def draw(axes: Axes, variant: str = variant, names: list[str] = names) -> None:
            sample = result.plotted[variant]
            draws, success = sample.dots.draws, sample.dots.success
            columns = (f"draw.{names[0]}", f"draw.{names[1]}" if len(names) > 1 else "trial")
            points = (draws[names[0]], draws[names[1]] if len(names) > 1 else sample.numbers.astype(float))
            plot_outcomes(axes, variant, points, columns, success, minimum_size=0.35)
            axes.set_xlabel(names[0])
            axes.set_ylabel(names[1] if len(names) > 1 else "trial")

        if names:
            description = f"Failures of {variant} over {' and '.join(names)}"
            panels.append(panel(variant, f"failures-{index}", description, draw, HEIGHT))
    return panels
