"""Trials that ended with their process, or whose FMU did not return: counted with a campaign's result."""

from __future__ import annotations

from ..runtime.flight.results import LOST
from .summary import Summary


def lost_status(status: str) -> str:
    """``crashed``, ``hung`` or ``out_of_memory`` if that is what a trial's status begins with, else nothing."""
    beginning = status.partition(" (")[0]
    return beginning if beginning in LOST else ""


def lost_lines(summary: Summary) -> list[str]:
    """A line for each variant that has any: how many crashed, hung or ran out of memory."""
    lines = []
    for variant, entry in summary.items():
        counts = dict.fromkeys(LOST, 0)
        for status, count in entry.statuses.items():
            if lost_status(status):
                counts[lost_status(status)] += count
        words = [f"{count} {status.replace('_', ' ')}" for status, count in counts.items() if count]
        if words:
            lines.append(f"{variant}: {', '.join(words)} of {entry.trials} trials, which are no successes")
    return lines
