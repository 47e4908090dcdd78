"""The page of one batch: rates, metrics, distributions, where it fails, what it was made of."""

from __future__ import annotations

from pathlib import Path

from ...campaigns.draws.declared import drawn_names
from ...campaigns.fly.results import BatchResult
from ..common.page import write_page
from .distributions import distribution_panels, legend_of, sort_metrics
from .failures import failure_panels, telling_scores
from .rates import rates_figure
from .replays import extremes_to_replay, failures_to_replay
from .scatters import scatter_figures
from .tables import HEADINGS, draw_rows, drivers, fmu_rows, group_rows, seen_statuses, variant_rows, verdict_rows


def write_batch_report(result: BatchResult, path: Path, title: str) -> None:
    """Write one self-contained HTML page about a batch; the same result gives the same bytes."""
    campaign = result.plan.campaign
    drawn, still, empty = sort_metrics(result)
    scores = {variant: telling_scores(result, variant) for variant in result.rows}
    write_page(
        path,
        Path(__file__).with_name("batch_report.html"),
        title=title,
        campaign=campaign,
        provenance=result.provenance,
        summary=result.summary,
        rows=variant_rows(result.summary),
        group_rows=group_rows(result.summary),
        requirements=verdict_rows(result.summary, campaign),
        statistics=HEADINGS,
        rates=rates_figure(result),
        left_out={variant: seen.note for variant, seen in result.shown.items() if seen.note},
        looks=legend_of(result),
        distributions=distribution_panels(result, drawn),
        still=still,
        empty=empty,
        scatters=scatter_figures(result),
        failures=failure_panels(result),
        failed=failures_to_replay(result),
        extremes=extremes_to_replay(result),
        stored=result.folder is not None,
        seen=seen_statuses(result),
        scores={variant: found for variant, found in scores.items() if found},
        drivers=drivers(result),
        drawn_names=drawn_names(campaign),
        draws=draw_rows(campaign),
        fmus=fmu_rows(result.provenance["fmus"]),
    )
