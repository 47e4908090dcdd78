"""Scatter plots of successes and failures by variant, over declared metrics or over influential inputs."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from ....campaigns.definition.campaign import Metric, Scatter
from ....campaigns.draws.interfaces import input_names
from ....campaigns.execute.campaign_result import CampaignResult
from ...cell import Inline, LegendEntry, Quantity, Rich
from ...chart.axes import linear_axis
from ...chart.equal import Ends, to_scale
from ...chart.marks import dashed_circle
from ...chart.panel import POINTS
from ...chart.symbols import mark, marker
from ...chart.ticks import axis_ends
from ...chart.write_svg import TrialPositions
from ...common.colours import INK, VERMILION
from ...common.panels import PANEL_WIDTH
from ...common.quantities import display_factor, label_with_unit, number
from ...interactive.charts import NO_BOX, Chart, Dots
from ...model import Node, Note
from ...pictures import Figure, Figures

SIDE = 3.4  # in, of a panel over metrics
HEIGHT = 3.2  # in, of a panel over inputs
SUCCESS = "#9a9a9a"
CROSS, DOT = 4.5, 3.2  # pt


def outcome_dots(variant: str, names: tuple[str, str], success: np.ndarray, minimum_size: float) -> list[Dots]:
    """Return the marks of a ``variant``'s trials: dots of successes, crosses of failures, small if there are many.

    ``names`` are the columns of abscissa and ordinate.
    """
    size = max(minimum_size, min(1.0, (500.0 / success.size) ** 0.5))
    good = Dots(variant=variant, names=names, success=True, colour=SUCCESS, size=DOT * size)
    return [good, Dots(variant=variant, names=names, colour=VERMILION.lower(), size=CROSS * size, cross=True)]


def outcome_marks() -> list[Inline]:
    """Return the marks of successes and failures with their names, for a legend."""
    success, failure = marker("o", DOT, SUCCESS), marker("x", CROSS, VERMILION, width=1.3)
    return [LegendEntry(success, ["success"]), " ", LegendEntry(failure, ["failure"])]


def positions(x: np.ndarray, y: np.ndarray, success: np.ndarray) -> TrialPositions:
    """Return a function that returns abscissas and ordinates of successes or failures.

    The arguments ``x`` and ``y`` contain the displayed coordinates of all trials, [trials].
    """
    return lambda dots: (x[success == dots.success], y[success == dots.success])


def count_failures(variant: str, success: np.ndarray) -> str:
    """Return the label of a figure: the variant with its number of failures."""
    return f"{variant}: {number(int(np.count_nonzero(~success)))} of {number(success.size)} failed"


def scatter_title(scatter: Scatter) -> str:
    """Return the heading of a declared scatter plot."""
    return scatter.title or f"{scatter.y} vs. {scatter.x}"


def scatter_nodes(batch: CampaignResult, scatter: Scatter) -> list[Node]:
    """Return the figures of a declared scatter plot, one per variant, and notes on their marks."""
    metrics = {metric.name: metric for metric in batch.plan.campaign.metrics}
    pair = (metrics[scatter.x], metrics[scatter.y])
    points = {
        variant: np.stack([sample.dots.metrics[metric.name] * display_factor(metric.unit) for metric in pair])
        for variant, sample in batch.plotted.items()
    }
    notes = _notes(scatter, pair[0], points)
    return [Figures(partial(_scatter_figures, batch, scatter, pair, points)), *map(Note, notes)]


def _scatter_figures(
    batch: CampaignResult, scatter: Scatter, pair: tuple[Metric, Metric], points: dict[str, np.ndarray]
) -> list[Figure]:
    title = scatter_title(scatter)
    ordinate = label_with_unit(pair[1].name, pair[1].unit)
    x_ends, y_ends = _limits(np.concatenate(list(points.values()), axis=1), _radius(scatter, pair[0]))
    figures = []
    for index, (variant, values) in enumerate(points.items()):
        success = batch.plotted[variant].dots.success
        chart_of = partial(scatter_chart, variant, success, scatter, pair)
        if pair[0].unit == pair[1].unit:
            chart = to_scale(chart_of, x_ends, y_ends, POINTS * PANEL_WIDTH, POINTS * SIDE, title=ordinate)
        else:
            chart = chart_of(x_ends, y_ends)
        figures.append(
            Figure(
                count_failures(variant, success),
                f"scatter-{scatter.name}-{index}",
                f"{title}: {variant}",
                chart,
                SIDE,
                is_narrow=True,
                trials=positions(values[0], values[1], success),
            )
        )
    return figures


def scatter_chart(
    variant: str, success: np.ndarray, scatter: Scatter, pair: tuple[Metric, Metric], x_ends: Ends, y_ends: Ends
) -> Chart:
    """Return the chart of a variant's trials over two metrics; the ends of axes are in displayed units."""
    radius = _radius(scatter, pair[0])
    columns = (f"metric.{scatter.x}", f"metric.{scatter.y}")
    return Chart(
        NO_BOX,
        linear_axis(x_ends, 5, label=label_with_unit(pair[0].name, pair[0].unit)),
        linear_axis(y_ends, 6),
        label_with_unit(pair[1].name, pair[1].unit),
        dots=outcome_dots(variant, columns, success, minimum_size=0.5),
        areas=[dashed_circle(radius, INK, 1.0)] if radius else [],
        curves=[mark(0.0, 0.0, marker("+", 8.0, INK))] if radius else [],
    )


def _radius(scatter: Scatter, metric: Metric) -> float:
    """Return the radius of the circle as displayed; 0 without one."""
    return 0.0 if scatter.circle is None else display_factor(metric.unit) * scatter.circle


def _limits(points: np.ndarray, radius: float) -> tuple[Ends, Ends]:
    """Return the ends of both axes, which enclose all finite points and the circle."""
    points = points[:, np.all(np.isfinite(points), axis=0)]
    circle = np.array([[-radius, radius]] * 2) if radius or not points.size else np.empty((2, 0))
    everything = np.concatenate([points, circle], axis=1)
    low, high = everything.min(axis=1), everything.max(axis=1)
    margin = np.where(high > low, 0.05 * (high - low), 0.5)
    x, y = np.stack([low - margin, high + margin], axis=1).tolist()
    return tuple(x), tuple(y)


def _notes(scatter: Scatter, metric: Metric, points: dict[str, np.ndarray]) -> list[Rich]:
    """Return the captions of marks and circle, and the number of trials without a point."""
    notes: list[Rich] = [outcome_marks()]
    if scatter.circle is not None:
        notes.append(["Dashed: ", Quantity(scatter.circle, metric.unit), " around the origin."])
    for variant, values in points.items():
        lacking = int(np.count_nonzero(~np.all(np.isfinite(values), axis=0)))
        if lacking:
            of = f"{number(lacking)} of {number(values.shape[1])} trials"
            notes.append(f"{variant}: {of} have no finite value and are not plotted.")
    return notes


def influence_on_success(batch: CampaignResult, variant: str) -> dict[str, float]:
    """Return the influence of each dispersed input on success, 0 to 1, largest first.

    It is the larger absolute correlation of success with the input or with its distance from its mean; the latter
    detects failures at both ends. Constant inputs and derived values are omitted; without both failures and successes
    the result is empty.
    """
    success = batch.plotted[variant].dots.success.astype(float)
    if success.min() == success.max():
        return {}
    influence = {}
    for name in input_names(batch.plan.campaign):
        values = batch.plotted[variant].dots.draws[name]
        columns = [column for column in (values, np.abs(values - values.mean())) if np.ptp(column) > 0.0]
        if columns:
            influence[name] = max(abs(float(np.corrcoef(success, column)[0, 1])) for column in columns)
    return dict(sorted(influence.items(), key=lambda item: -item[1]))


def failure_figures(batch: CampaignResult) -> list[Figure]:
    """Return a figure of failures and successes over the two most influential inputs for each variant that has both."""
    figures = []
    for index, variant in enumerate(batch.rows):
        names = list(influence_on_success(batch, variant))[:2]
        if names:
            success = batch.plotted[variant].dots.success
            figures.append(
                Figure(
                    count_failures(variant, success),
                    f"failures-{index}",
                    f"Failures of {variant} over {' and '.join(names)}",
                    failure_chart(batch, variant, names),
                    HEIGHT,
                    is_narrow=True,
                    trials=positions(*_inputs(batch, variant, names), success),
                )
            )
    return figures


def _inputs(batch: CampaignResult, variant: str, names: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """Return the coordinates of trials over two inputs; for a single input the ordinate is the trial's number."""
    sample = batch.plotted[variant]
    draws = sample.dots.draws
    return draws[names[0]], draws[names[1]] if len(names) > 1 else sample.dots.trial.astype(float)


def failure_chart(batch: CampaignResult, variant: str, names: Sequence[str]) -> Chart:
    """Return the chart of a variant's trials over one or two dispersed inputs."""
    x, y = _inputs(batch, variant, names)
    columns = (f"draw.{names[0]}", f"draw.{names[1]}" if len(names) > 1 else "trial")
    return Chart(
        NO_BOX,
        linear_axis(axis_ends(x), 5, label=names[0]),
        linear_axis(axis_ends(y), 6),
        names[1] if len(names) > 1 else "trial",
        dots=outcome_dots(variant, columns, batch.plotted[variant].dots.success, minimum_size=0.35),
    )
