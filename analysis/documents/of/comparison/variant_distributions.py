"""Distributions of a comparison's metrics, one line per variant."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ....campaigns.compare.campaign_comparison import CampaignComparison
from ....campaigns.definition.campaign import Metric
from ....campaigns.definition.expressions import Expression
from ...cell import LegendEntry
from ...common.colours import COLOURS, DASHES, MARKERS, Look, look
from ...pictures import Figure, Figures
from ..campaign.distributions import distribution_figure
from ..campaign.recorded_names import variable_of
from .sigma import is_over_sigma

MASS = "kg"
NOT_EVALUATED = Expression("0")


def all_values(comparison: CampaignComparison, metric: Metric) -> dict[str, np.ndarray]:
    """Return a metric in every trial of every variant.

    An error over sigma of exactly 0 means that there is no sigma, and becomes NaN.
    """
    by_label = {label: comparison.values(label, metric.name) for label in comparison.contenders}
    if is_over_sigma(metric):
        return {label: np.where(values == 0.0, np.nan, values) for label, values in by_label.items()}
    return by_label


def metric_distributions(comparison: CampaignComparison) -> dict[Metric, dict[str, np.ndarray]]:
    """Return metrics by variant, NaN in failed trials.

    If no metric is in kg, the result contains final masses, too, since they show the propellant.
    """
    contenders = comparison.contenders
    distributions = {
        metric: all_values(comparison, metric) for metric in comparison.metrics if not is_over_sigma(metric)
    } | _final_masses(comparison)
    return {
        metric: {
            label: np.where(contenders[label].trials.success, values, np.nan) for label, values in displayed.items()
        }
        for metric, displayed in distributions.items()
    }


def _final_masses(comparison: CampaignComparison) -> dict[Metric, dict[str, np.ndarray]]:
    """Return final masses that all variants have, by metric name; empty if a metric is in kg."""
    contenders = comparison.contenders
    masses: dict[Metric, dict[str, np.ndarray]] = {}
    if any(metric.unit == MASS for metric in comparison.metrics):
        return masses
    common = [
        name
        for name in dict.fromkeys(name for contender in contenders.values() for name in contender.trials.final)
        if all(name in contender.trials.final for contender in contenders.values())
    ]
    for name in common:
        if any(variable_of(contender.stored.document, name) == "mass" for contender in contenders.values()):
            metric = Metric(f"final {name}", NOT_EVALUATED, "final", unit=MASS)
            masses[metric] = {label: contender.trials.final[name] for label, contender in contenders.items()}
    return masses


def sort_metrics(
    distributed: Mapping[Metric, Mapping[str, np.ndarray]],
) -> tuple[list[Metric], list[tuple[Metric, float]], list[Metric]]:
    """Return the metrics that vary, constant metrics with their values, and metrics without a finite value."""
    plotted, still, empty = [], [], []
    for metric, by_label in distributed.items():
        values = np.concatenate(list(by_label.values()))
        finite = values[np.isfinite(values)]
        if not finite.size:
            empty.append(metric)
        elif finite.size > 1 and np.ptp(finite) == 0.0:
            still.append((metric, float(finite[0])))
        else:
            plotted.append(metric)
    return plotted, still, empty


def metric_figures(
    distributions: Mapping[Metric, Mapping[str, np.ndarray]], metrics: Sequence[Metric], styles: Mapping[str, Look]
) -> list[Figure]:
    """Return a figure of each metric's distributions; figures of errors over sigma include the normal distribution."""
    return [
        distribution_figure(
            metric,
            values,
            [styles[label] for label in values],
            f"distribution-{''.join(letter if letter.isalnum() else '-' for letter in metric.name)}",
            is_normal=is_over_sigma(metric),
        )
        for metric in metrics
        for values in [distributions[metric]]
    ]


def overlaid_figures(draw: Callable[[], Sequence[Figure]], styles: Mapping[str, Look]) -> Figures:
    """Return figures of all variants with a legend, in the order of each figure's first lines."""
    return Figures(draw, [LegendEntry(style, [label]) for label, style in styles.items()], is_in_order=True)


def looks_of(comparison: CampaignComparison) -> dict[str, Look]:
    """Return a look per variant; with several batches colours identify variants, and dashes batches."""
    if len(comparison.batches) == 1:
        return {label: look(contender.variant) for label, contender in comparison.contenders.items()}
    several = len({contender.variant for contender in comparison.contenders.values()}) > 1
    styles = {}
    for label, contender in comparison.contenders.items():
        hue = contender.variant if several else contender.batch
        marker = MARKERS[contender.batch % len(MARKERS)]
        styles[label] = Look(COLOURS[hue % len(COLOURS)], DASHES[contender.batch % len(DASHES)], marker)
    return styles
