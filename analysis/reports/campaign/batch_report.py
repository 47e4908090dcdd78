"""The page of one batch: a row of verdicts per variant, then distributions, flights, failures; digits are folded."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ...campaigns.columns import describe_metric
from ...campaigns.draws.declared import input_names
from ...campaigns.execute.results import BatchResult
from ...campaigns.judged import worst_trial
from ...campaigns.lost_trials import lost_of
from ...commands.campaigns import batch_command
from ..common.page import write_page
from .distributions import distribution_panels, legend_of, sort_metrics
from .embedded_flights import embedded_flights
from .embedded_trials import trials_document, trials_notes
from .scatters import failure_panels, influence_on_success, legend_of_outcomes, scatter_figures
from .tables import (
    HEADINGS,
    anchors_of,
    component_statuses,
    draw_rows,
    drivers,
    extremes_to_replay,
    fmu_rows,
    group_rows,
    trials_to_replay,
    variant_rows,
    verdict_rows,
)
from .verdict_table import VerdictTable, verdict_table


def verdicts_of(result: BatchResult) -> VerdictTable:
    """Return the verdicts on a batch, with the metrics that vary and are no truths."""
    return verdict_table(
        result.summary,
        [metric for metric in sort_metrics(result)[0] if not metric.expression.is_truth],
        result.plan.campaign.judged_expressions(),
        lambda variant, metric, limits: worst_trial(result.rows[variant], metric.name, limits.excess),
    )


def write_batch_report(result: BatchResult, path: Path, title: str) -> None:
    """Write one self-contained HTML page about a batch; the same result gives the same bytes."""
    campaign = result.plan.campaign
    varying, constant, empty = sort_metrics(result)
    influences = {variant: influence_on_success(result, variant) for variant in result.rows}
    flights = embedded_flights(result)
    verdicts = verdicts_of(result)
    variants = legend_of(result)
    first = [each.metric for each in verdicts.metrics] or varying
    replays = trials_to_replay(result, verdicts)
    system = ("system", "all", result.provenance["system_sha256"])
    write_page(
        path,
        Path(__file__).with_name("batch_report.html"),
        title=title,
        campaign=campaign,
        metrics=[
            replace(metric, description=describe_metric(result.provenance["metrics"][metric.name]))
            for metric in campaign.metrics
        ],
        provenance=result.provenance,
        summary=result.summary,
        verdicts=verdicts,
        command=batch_command(result.plan),
        rows=variant_rows(result.summary),
        group_rows=group_rows(result.summary),
        lost=lost_of(result.summary),
        requirements=verdict_rows(result.summary, campaign),
        statistics=HEADINGS,
        samples={variant: sample.note for variant, sample in result.plotted.items() if sample.note},
        looks=variants,
        swatches={variant: mark for mark, variant in variants},
        distributions=distribution_panels(result, first),
        other_distributions=distribution_panels(result, [metric for metric in varying if metric not in first]),
        constant=constant,
        empty=empty,
        scatters=scatter_figures(result),
        failures=failure_panels(result),
        outcomes=legend_of_outcomes(),
        replays=replays,
        anchors=anchors_of(replays),
        extremes=extremes_to_replay(result),
        stored=result.folder is not None,
        statuses=component_statuses(result),
        influences={variant: values for variant, values in influences.items() if values},
        drivers=drivers(result),
        input_names=input_names(campaign),
        draws=draw_rows(campaign),
        trials=trials_document(result),
        trials_notes=trials_notes(result),
        flights=flights,
        hash_rows=[system, *fmu_rows(result.provenance["fmus"])],
    )
