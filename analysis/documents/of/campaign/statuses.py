"""Statuses at which the trials of a campaign ended."""

from __future__ import annotations

from ....campaigns.summary import Summary
from ...cell import Bar, Percentage
from ...model import Table


def status_table(summary: Summary) -> Table:
    """Return a row for each status of each variant, with its number of trials and their share."""
    rows = [
        (variant, status, count, Percentage(count / entry.trials), Bar(count / entry.trials))
        for variant, entry in summary.items()
        for status, count in entry.statuses.items()
    ]
    return Table(("variant", "status", "trials", "trials, %", ""), rows, style="", is_grouped=True)
