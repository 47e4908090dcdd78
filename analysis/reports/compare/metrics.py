"""Metrics of a comparison: distributions, one line per variant; errors over the filter's standard deviation."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.stats import norm

from ...campaigns.compare.comparison import Comparison
from ...campaigns.definition.campaign import Metric
from ...campaigns.definition.expressions import Expression
from ...campaigns.summary import success_interval
from ..campaign.distributions import CUMULATIVE, distribution_chart, distribution_plot
from ..campaign.recorded_names import RATIO, variable_of
from ..chart.lines import line
from ..chart.panel import chart_panel
from ..common.colours import COLOURS, DASHES, INK, MARKERS, Look, look
from ..common.panels import Panel
from ..interactive.measures import FAILED_DASHES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MASS = "kg"
NORMAL_REACH = 3.5  # deviations that are shown at least
NOT_EVALUATED = Expression("0")


def all_values(comparison: Comparison, metric: Metric) -> dict[str, np.ndarray]:
    """A metric in every trial of every contender; of errors over sigma nan for 0, which stands for no sigma."""
    by_label = {label: comparison.values(label, metric.name) for label in comparison.contenders}
    if is_over_sigma(metric):
        return {label: np.where(values == 0.0, np.nan, values) for label, values in by_label.items()}
    return by_label


def make_distribution(comparison: Comparison) -> dict[Metric, dict[str, np.ndarray]]:
    """Metrics by contender, nan in failed trials; without one in kg also the final masses: they tell the propellant."""
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


def _final_masses(comparison: Comparison) -> dict[Metric, dict[str, np.ndarray]]:
    """Final masses that all contenders have, under the names of metrics; none if a metric is in kg."""
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
    """Metrics worth a panel; those that are the same wherever they are finite, and it; those that are nowhere."""
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


def distribution_panel(metric: Metric, values: Mapping[str, np.ndarray], styles: Mapping[str, Look]) -> Panel:
    """The empirical distribution of a metric in every contender; with the normal one for errors over sigma."""
    half_range = NORMAL_REACH if is_over_sigma(metric) else 0.0
    chart = distribution_chart(metric, values, [styles[label] for label in values], half_range)
    if half_range:
        x = np.linspace(*chart.x.ends, 121)
        normal = line(x, 100.0 * norm.cdf(x), INK, width=1.0, dashes=FAILED_DASHES, name="normal", unit="%")
        chart = replace(chart, curves=[*chart.curves, normal])
    slug = "".join(letter if letter.isalnum() else "-" for letter in metric.name)
    description = f"Distributions of {metric.name}"
    return chart_panel(metric.name, f"distribution-{slug}", description, chart, title=CUMULATIVE)


def varying_metrics(comparison: Comparison) -> list[Metric]:
    """Metrics that are finite somewhere and not the same everywhere."""
    return sort_metrics(make_distribution(comparison))[0]


def metric_plot(comparison: Comparison, metrics: Sequence[Metric]) -> Figure:
    """Empirical distributions over the successful trials, a panel per metric, a line per contender."""
    displayed = make_distribution(comparison)
    return distribution_plot({metric: displayed[metric] for metric in metrics}, looks_of(comparison))


def looks_of(comparison: Comparison) -> dict[str, Look]:
    """One look per contender. Of several batches a variant has one colour, and a batch one kind of dashes."""
    if len(comparison.batches) == 1:
        return {label: look(contender.variant) for label, contender in comparison.contenders.items()}
    several = len({contender.variant for contender in comparison.contenders.values()}) > 1
    analyses = {}
    for label, contender in comparison.contenders.items():
        hue = contender.variant if several else contender.batch
        marker = MARKERS[contender.batch % len(MARKERS)]
        analyses[label] = Look(COLOURS[hue % len(COLOURS)], DASHES[contender.batch % len(DASHES)], marker)
    return analyses


SUFFIXES = ("_over_sigma", RATIO)
LIMITS = (1, 2, 3)
NORMAL = {limit: float(norm.cdf(limit) - norm.cdf(-limit)) for limit in LIMITS}


@dataclass(frozen=True)
class Share:
    """Trials within so many standard deviations: their share and its 95 % interval."""

    rate: float
    interval: tuple[float, float]


@dataclass(frozen=True)
class SigmaRow:
    """One error over its sigma in the trials of one contender: mean, deviation, shares within 1, 2 and 3.

    ``count`` is of trials with a finite value other than 0; without such nothing can be told, as where
    there is no covariance.
    """

    metric: str
    label: str
    count: int
    mean: float | None
    std: float | None
    within: list[Share]


def is_over_sigma(metric: Metric) -> bool:
    """Whether a metric is an error over the filter's standard deviation, by its name."""
    return metric.unit == "1" and metric.name.endswith(SUFFIXES)


def sigma_rows(comparison: Comparison) -> list[SigmaRow]:
    """A row per such metric and contender."""
    rows = []
    for metric, label in itertools.product(filter(is_over_sigma, comparison.metrics), comparison.contenders):
        values = comparison.values(label, metric.name)
        reported = values[np.isfinite(values) & (values != 0.0)]
        count = int(reported.size)
        inside = [int(np.sum(np.abs(reported) <= limit)) for limit in LIMITS] if count else []
        within = [Share(number / count, success_interval(number, count)) for number in inside]
        mean = float(reported.mean()) if count else None
        deviation = float(reported.std(ddof=1)) if count > 1 else None
        rows.append(SigmaRow(metric.name, label, count, mean, deviation, within))
    return rows
