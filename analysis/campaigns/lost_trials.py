"""Trials that crashed, hung or ran out of memory, counted in the text of every result that includes them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from ..runtime.flight.results import LOST
from .summary import Summary


def lost_status(status: str) -> str:
    """Return ``crashed``, ``hung`` or ``out_of_memory`` if a trial's status begins with this word, else ""."""
    beginning = status.partition(" (")[0]
    return beginning if beginning in LOST else ""


def count_lost(statuses: Mapping[str, int]) -> Counter[str]:
    """Return the numbers of trials that crashed, hung or ran out of memory, from the counts of all statuses."""
    counts: Counter[str] = Counter()
    for status, count in statuses.items():
        if lost_status(status):
            counts[lost_status(status)] += count
    return counts


def lost_words(counts: Mapping[str, int]) -> str:
    """Return the counts of lost trials as text, such as "2 crashed, 1 out of memory"; "" if there are none."""
    return ", ".join(f"{counts[status]} {status.replace('_', ' ')}" for status in LOST if counts.get(status))


def lost_lines(statuses: Mapping[str, Mapping[str, int]]) -> list[str]:
    """Return a line for each variant with lost trials, from the counts of the variant's statuses."""
    words = {variant: lost_words(count_lost(counts)) for variant, counts in statuses.items()}
    return [
        f"{variant}: {text} of {sum(statuses[variant].values())} trials, counted as failures"
        for variant, text in words.items()
        if text
    ]


def describe_lost_trials(summary: Summary) -> list[str]:
    """Return a line for each variant of a summary with lost trials."""
    return lost_lines({variant: entry.statuses for variant, entry in summary.items()})
