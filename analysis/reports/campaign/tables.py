"""Rows and headings of the tables on pages of a campaign: variants, requirements, correlations, statuses, replays."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from markupsafe import Markup

from ...campaigns.definition.campaign import Metric
from ...campaigns.statistics import QUANTILES, STATISTICS
from ...campaigns.summary import Summary, SummaryRow, summary_rows
from ..common.page import exact
from ..common.quantities import display_unit
from .verdict_table import JudgedMetric, VerdictRow

HEADINGS = {name: f"{QUANTILES[name]} %" if name in QUANTILES else name for name in STATISTICS}


def variant_rows(summary: Summary) -> list[SummaryRow]:
    """A row per variant, over all its trials."""
    return [row for row in summary_rows(summary) if row.group is None]


def group_rows(summary: Summary) -> list[SummaryRow]:
    """A row per variant and group of its trials, groups of a variant together."""
    return [row for row in summary_rows(summary) if row.group is not None]


def fmu_rows(fmus: dict[str, dict[str, str]]) -> list[tuple[str, str, str]]:
    """Component, variants and SHA-256 of every FMU, variants with the same FMU in one row."""
    variants_of: dict[tuple[str, str], list[str]] = {}
    for variant, components in fmus.items():
        for component, digest in components.items():
            variants_of.setdefault((component, digest), []).append(variant)
    return [
        (component, "all" if len(variants) == len(fmus) else ", ".join(variants), digest)
        for (component, digest), variants in sorted(variants_of.items(), key=lambda item: item[0][0])
    ]


FAILURES = 3  # of a variant, the first ones


@dataclass(frozen=True)
class Replay:
    """A trial of a variant, the reasons to replay it, and the command that does."""

    variant: str
    trial: int
    reasons: list[Markup]
    command: str
    anchor: str = ""


def with_anchors(replays: Sequence[Replay]) -> list[Replay]:
    """Return rows with an anchor each, no two of one variant and trial."""
    return [replace(each, anchor=f"replay-{number}") for number, each in enumerate(replays)]


def anchors_of(replays: Iterable[Replay]) -> dict[tuple[str, int], str]:
    """Return the anchors of rows by variant and trial."""
    return {(each.variant, each.trial): each.anchor for each in replays}


def worst_reasons(row: VerdictRow, metrics: Sequence[JudgedMetric]) -> list[tuple[int, Markup]]:
    """Return the worst trials of a variant, each with the metric and its value there."""
    return [
        (cell.trial, _reason(Markup("worst "), judged.metric, cell.worst))
        for judged, cell in zip(metrics, row.numbers, strict=True)
        if cell.trial is not None
    ]


def _reason(which: Markup, metric: Metric, value: float | None) -> Markup:
    return Markup("{}{}: {} {}").format(which, metric.name, exact(value, metric.unit), display_unit(metric.unit))
