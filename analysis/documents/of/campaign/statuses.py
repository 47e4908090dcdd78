"""Statuses of a campaign's trials, and statuses reported by components."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

from ....campaigns.execute.evaluation import worst_statuses
from ....campaigns.summary import Summary
from ...cell import Bar, Percentage
from ...model import Table


def status_table(summary: Summary) -> Table:
    """Return a row for each status of each variant, with number and share of trials."""
    rows = [
        (variant, status, count, Percentage(count / entry.trials), Bar(count / entry.trials))
        for variant, entry in summary.items()
        for status, count in entry.statuses.items()
    ]
    return Table(("variant", "status", "trials", "trials, %", ""), rows, style="", is_grouped=True)


class ComponentStatus(NamedTuple):
    """The highest status reported by a signal of a variant, with its ``occurrences`` among ``trials``."""

    variant: str
    signal: str
    status: int
    occurrences: int
    trials: int


def component_statuses(summary: Summary) -> list[ComponentStatus]:
    """Return counts by variant, signal and status.

    The result is empty if no trial reported two statuses, since statuses of trials then suffice.
    """
    if not any(len(worst_statuses(text)) > 1 for entry in summary.values() for text in entry.statuses):
        return []
    rows = []
    for variant, entry in summary.items():
        counts: Counter[tuple[str, int]] = Counter()
        for text, trials in entry.statuses.items():
            counts.update(dict.fromkeys(worst_statuses(text).items(), trials))
        rows += [ComponentStatus(variant, *status, count, entry.trials) for status, count in sorted(counts.items())]
    return rows


def component_table(counts: Sequence[ComponentStatus]) -> Table:
    """Return a row for each status of each component."""
    rows = [
        (each.variant, each.signal, each.status, each.occurrences, Percentage(each.occurrences / each.trials))
        for each in counts
    ]
    return Table(("variant", "signal", "highest status", "trials", "trials, %"), rows, style="", is_grouped=True)
