"""Nodes of a batch in a notebook: success rates, requirements, statistics and distributions of metrics."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath

from .....common.percent import short_percent
from ....campaigns.summary import CONFIDENCE, SummaryRow, summary_rows
from ....campaigns.tables import group_cells, group_headings, requirement_rows
from ...cell import Cell
from ...model import Node, Table, Text
from ..campaign.metrics import metric_summary
from ..campaign.variants import interval_head
from ..campaign.verdicts import unjudged_node
from .content import BatchContent
from .distribution_sections import distribution_figures


def notebook_nodes(content: BatchContent) -> list[Node]:
    """Return the campaign's name, faults, tables of rates, requirements and metrics, and distributions."""
    campaign, rows = content.campaign, summary_rows(content.batch.summary)
    faults = content.batch.plan.fault_texts()
    return [
        Text(PurePath(campaign.file).name),
        *([Text(f"with faults: {'; '.join(faults)}")] if faults else []),
        _rate_table(rows, campaign.group),
        _requirement_table(content) if content.verdicts.has_verdicts else unjudged_node(),
        metric_summary(rows, campaign.metrics, campaign.group),
        *([distribution_figures(content, varying)] if (varying := content.sorted_metrics[0]) else []),
    ]


def _rate_table(rows: Sequence[SummaryRow], group: str | None) -> Table:
    body: list[Sequence[Cell]] = [
        (
            *group_cells(row, group),
            row.entry.trials,
            short_percent(row.entry.success_rate),
            " to ".join(short_percent(end) for end in row.entry.success_interval),
            ", ".join(f"{count} {status}" for status, count in row.entry.statuses.items()),
        )
        for row in rows
    ]
    return Table((*group_headings(group), "trials", "success, %", interval_head(CONFIDENCE), "statuses"), body)


def _requirement_table(content: BatchContent) -> Table:
    rows = [
        (f"{name}: {entry.text}", variant, entry.verdict, entry.flights, entry.failures)
        for variant, name, entry in requirement_rows(content.batch.summary)
    ]
    return Table(("requirement", "variant", "verdict", "flights", "failures"), rows)
