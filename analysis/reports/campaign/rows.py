"""Rows and columns of the tables that pages have of a summary: variants, groups of their trials, statistics."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from ...campaigns.spec.campaign import Campaign
from ...campaigns.statistics import QUANTILES, STATISTICS
from ...campaigns.summary import SummaryRow, summary_rows
from ...campaigns.tables import bound_text, requirement_rows
from ..common.quantities import in_shown_unit, number, shown_unit

HEADINGS = {name: f"{QUANTILES[name]} %" if name in QUANTILES else name for name in STATISTICS}


def variant_rows(summary: Mapping[str, Any]) -> list[SummaryRow]:
    """A row per variant, over all its trials."""
    return [row for row in summary_rows(summary) if row.group is None]


def group_rows(summary: Mapping[str, Any]) -> list[SummaryRow]:
    """A row per variant and group of its trials, groups of a variant together."""
    return [row for row in summary_rows(summary) if row.group is not None]


class RequirementRow(NamedTuple):
    """A requirement of a variant: ``found`` is its verdict in the summary, ``bound`` its tolerance bound in words."""

    variant: str
    name: str
    description: str
    found: dict[str, Any]
    bound: str


def verdict_rows(summary: Mapping[str, Any], campaign: Campaign) -> list[RequirementRow]:
    """A row per requirement and variant, variants of a requirement together."""
    described = {requirement.name: requirement.description for requirement in campaign.requirements}
    units = {metric.name: metric.unit for metric in campaign.metrics}
    return [
        RequirementRow(variant, name, described[name], found, _bound(found, units))
        for variant, name, found in requirement_rows(summary)
    ]


def _bound(found: Mapping[str, Any], units: Mapping[str, str]) -> str:
    if found["bound"] is None:
        return ""
    value, unit = found["bound"]["value"], units[found["bound"]["metric"]]
    known = float(value) if isinstance(value, str) else value
    return bound_text(found, f"{number(in_shown_unit(known, unit))} {shown_unit(unit)}".strip())
