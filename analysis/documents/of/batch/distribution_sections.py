"""Empirical distributions of a batch's metrics: metrics of success and requirements first, then the others."""

from __future__ import annotations

from collections.abc import Sequence

from ....campaigns.definition.campaign import Metric
from ...cell import LegendEntry, Quantity
from ...model import ForScript, Missing, Node, Note, Section
from ...pictures import Figure, Figures
from ..campaign.distributions import distribution_figure, distribution_note, metric_values
from .content import BatchContent
from .embedded_trials import trials_document, trials_notes


def distribution_section(content: BatchContent) -> Section:
    """Return the section of distributions of the metrics of success and requirements, with data on marked trials."""
    batch = content.batch
    samples = {variant: sample.note for variant, sample in batch.plotted.items() if sample.note}
    nodes: list[Node] = [
        ForScript("trials", "curves", trials_document(batch)),
        *(
            Note(
                f"{variant}: plots and rank correlations use {text}. Tables, success probabilities and requirements "
                "use all trials."
            )
            for variant, text in samples.items()
        ),
    ]
    if content.judged_metrics:
        nodes += [
            distribution_figures(content, content.judged_metrics),
            distribution_note(of_successes=False),
        ]
    nodes.append(ForScript("", "curves", None, [Note(each) for each in trials_notes(batch)], "screen answers"))
    if not content.metrics:
        nodes.append(Missing("the campaign declares no metrics"))
    return Section("Distributions", nodes)


def other_distribution_sections(content: BatchContent) -> list[Section]:
    """Return the section on all other metrics: distributions, constant metrics, and metrics without a finite value."""
    varying, constant, empty = content.sorted_metrics
    others = [metric for metric in varying if metric not in content.judged_metrics]
    nodes: list[Node] = [
        *([distribution_figures(content, others)] if others else []),
        *(
            Note([f"{metric.name} is ", Quantity(value, metric.unit), " in every trial of every variant."])
            for metric, value in constant
        ),
        *(Missing(["", f"{metric.name} has no finite value in any trial"]) for metric in empty),
    ]
    return [Section("Other distributions", nodes, is_folded=True)] if nodes else []


def distribution_figures(content: BatchContent, metrics: Sequence[Metric]) -> Figures:
    """Return figures of the empirical distributions of metrics over all trials, with one legend."""
    numbers = {metric: number for number, metric in enumerate(content.campaign.metrics)}
    styles = list(content.styles.values())

    def draw() -> list[Figure]:
        return [
            distribution_figure(
                metric, metric_values(content.batch, metric.name), styles, f"distribution-{numbers[metric]}"
            )
            for metric in metrics
        ]

    return Figures(draw, [LegendEntry(look, [variant]) for variant, look in content.styles.items()], is_in_order=True)
