"""The page of one batch: rates, metrics, distributions, where it fails, what it was made of."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ...campaigns.draws.declared import drawn_names
from ...campaigns.fly.results import BatchResult
from ...campaigns.spec.campaign import Campaign
from ..common.page import write_page
from .distributions import distribution_panels, legend_of, sort_metrics
from .drivers import drivers
from .failures import failure_panels, telling_scores
from .rates import rates_figure
from .replays import extremes_to_replay, failures_to_replay
from .rows import HEADINGS, group_rows, variant_rows, verdict_rows
from .scatters import scatter_figures
from .seen_statuses import seen_statuses


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


def draw_rows(campaign: Campaign) -> list[tuple[str, str, str]]:
    """Name, distribution and arguments of every draw, then every derived value with its expression."""
    rows = []
    for draw in campaign.draws:
        arguments = ", ".join(f"{key} {_plain(value)}" for key, value in draw.arguments.items())
        rows.append((", ".join(draw.names), draw.distribution.replace("_", " "), arguments))
    return rows + [(name, "derived", " ".join(formula.text.split())) for name, formula in campaign.derived.items()]


def _plain(value: Any) -> str:
    """A draw's argument: a number, or numbers in brackets, shortened where they are many."""
    if not isinstance(value, tuple | list):
        return f"{value:.10g}"
    inner = [_plain(entry) for entry in value]
    return f"[{', '.join(inner if len(inner) <= 12 else [*inner[:5], '…', *inner[-2:]])}]"


def fmu_rows(fmus: dict[str, dict[str, str]]) -> list[tuple[str, str, str]]:
    """Component, variants and hash of every FMU that flew, variants that share one brought together."""
    flown: dict[tuple[str, str], list[str]] = {}
    for variant, components in fmus.items():
        for component, digest in components.items():
            flown.setdefault((component, digest), []).append(variant)
    return [
        (component, "all" if len(variants) == len(fmus) else ", ".join(variants), digest)
        for (component, digest), variants in sorted(flown.items(), key=lambda item: item[0][0])
    ]
