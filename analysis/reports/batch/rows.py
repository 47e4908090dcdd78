"""Rows and columns of the tables that pages have of a summary: variants, groups of their trials, statistics."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...batch.statistics import QUANTILES, STATISTICS
from ...batch.summary import SummaryRow, summary_rows

HEADINGS = {name: f"{QUANTILES[name]} %" if name in QUANTILES else name for name in STATISTICS}


def variant_rows(summary: Mapping[str, Any]) -> list[SummaryRow]:
    """A row per variant, over all its trials."""
    return [row for row in summary_rows(summary) if row.group is None]


def group_rows(summary: Mapping[str, Any]) -> list[SummaryRow]:
    """A row per variant and group of its trials, groups of a variant together."""
    return [row for row in summary_rows(summary) if row.group is not None]
