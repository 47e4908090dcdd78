"""The page of one batch: success probability, requirements, metrics, distributions, failure region, provenance."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ...campaigns.columns import describe_metric
from ...campaigns.draws.declared import input_names
from ...campaigns.execute.results import BatchResult
from ...campaigns.lost_trials import lost_of
from ..common.page import write_page
from .distributions import distribution_panels, legend_of, rates_figure, sort_metrics
from .embedded_flights import embedded_flights
from .embedded_trials import trials_document, trials_notes
from .scatters import failure_panels, influence_on_success, legend_of_outcomes, scatter_figures
from .tables import (
    HEADINGS,
    component_statuses,
    draw_rows,
    drivers,
    extremes_to_replay,
    failures_to_replay,
    fmu_rows,
    group_rows,
    variant_rows,
    verdict_rows,
)


def write_batch_report(result: BatchResult, path: Path, title: str) -> None:
    """Write one self-contained HTML page about a batch; the same result gives the same bytes."""
    campaign = result.plan.campaign
    varying, constant, empty = sort_metrics(result)
    influences = {variant: influence_on_success(result, variant) for variant in result.rows}
    flights = embedded_flights(result)
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
        rows=variant_rows(result.summary),
        group_rows=group_rows(result.summary),
        lost=lost_of(result.summary),
        requirements=verdict_rows(result.summary, campaign),
        statistics=HEADINGS,
        rates=rates_figure(result),
        samples={variant: sample.note for variant, sample in result.plotted.items() if sample.note},
        looks=legend_of(result),
        distributions=distribution_panels(result, varying),
        constant=constant,
        empty=empty,
        scatters=scatter_figures(result),
        failures=failure_panels(result),
        outcomes=legend_of_outcomes(),
        failed=failures_to_replay(result),
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
