"""Rows and headings of the tables on pages of a campaign: variants, groups, requirements, correlations, statuses."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple

from ...campaigns.draws.declared import drawn_names
from ...campaigns.fly.results import BatchResult
from ...campaigns.fly.workers.status_texts import worst_statuses
from ...campaigns.requirement_verdicts import RequirementVerdict
from ...campaigns.spec.campaign import Campaign
from ...campaigns.statistics import QUANTILES, STATISTICS
from ...campaigns.summary import Summary, SummaryRow, summary_rows
from ...campaigns.tables import bound_text, requirement_rows
from ...studies.sensitivity.ranks import rank_correlations
from ..common.quantities import in_shown_unit, number, shown_unit

HEADINGS = {name: f"{QUANTILES[name]} %" if name in QUANTILES else name for name in STATISTICS}


def variant_rows(summary: Summary) -> list[SummaryRow]:
    """A row per variant, over all its trials."""
    return [row for row in summary_rows(summary) if row.group is None]


def group_rows(summary: Summary) -> list[SummaryRow]:
    """A row per variant and group of its trials, groups of a variant together."""
    return [row for row in summary_rows(summary) if row.group is not None]


class RequirementRow(NamedTuple):
    """A requirement of a variant: ``found`` is its verdict in the summary, ``bound`` its tolerance bound in words."""

    variant: str
    name: str
    description: str
    found: RequirementVerdict
    bound: str


def verdict_rows(summary: Summary, campaign: Campaign) -> list[RequirementRow]:
    """A row per requirement and variant, variants of a requirement together."""
    described = {requirement.name: requirement.description for requirement in campaign.requirements}
    units = {metric.name: metric.unit for metric in campaign.metrics}
    return [
        RequirementRow(variant, name, described[name], found, _bound(found, units))
        for variant, name, found in requirement_rows(summary)
    ]


def _bound(result: RequirementVerdict, units: Mapping[str, str]) -> str:
    if result.bound is None:
        return ""
    unit = units[result.bound.metric]
    return bound_text(result, f"{number(in_shown_unit(result.bound.value, unit))} {shown_unit(unit)}".strip())


TOLD = 3  # draws of a metric


class Driver(NamedTuple):
    """A metric of a variant, and the draws that it goes with most: their names and rank correlations."""

    variant: str
    metric: str
    draws: list[tuple[str, float]]


def drivers(result: BatchResult) -> list[Driver]:
    """A row for every metric of every variant that has any rank correlation, the largest first."""
    names = drawn_names(result.plan.campaign)
    rows = []
    for variant, seen in result.shown.items():
        trials = seen.first
        draws = {name: trials.draws[name] for name in names}
        for metric, found in rank_correlations(draws, trials.metrics).items():
            known = [(name, rho) for name, rho in found.items() if rho is not None]
            known.sort(key=lambda item: -abs(item[1]))
            if known:
                rows.append(Driver(variant, metric, known[:TOLD]))
    return rows


class SeenStatus(NamedTuple):
    """A status as the worst that a signal of a variant reported, in ``seen`` of ``trials``."""

    variant: str
    signal: str
    status: int
    seen: int
    trials: int


def seen_statuses(result: BatchResult) -> list[SeenStatus]:
    """Counts by variant, signal and status; none where no trial reported two, as the table of ends tells all then."""
    if not any(len(worst_statuses(text)) > 1 for entry in result.summary.values() for text in entry.statuses):
        return []
    found = []
    for variant, entry in result.summary.items():
        counts: Counter[tuple[str, int]] = Counter()
        for text, trials in entry.statuses.items():
            counts.update(dict.fromkeys(worst_statuses(text).items(), trials))
        found += [SeenStatus(variant, *status, count, entry.trials) for status, count in sorted(counts.items())]
    return found


def draw_rows(campaign: Campaign) -> list[tuple[str, str, str]]:
    """Name, distribution and arguments of every draw, then every derived value with its expression."""
    rows = []
    for draw in campaign.draws:
        distribution = draw.distribution
        rows.append((", ".join(draw.names), distribution.keyword.replace("_", " "), distribution.describe()))
    return rows + [(name, "derived", " ".join(formula.text.split())) for name, formula in campaign.derived.items()]


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
