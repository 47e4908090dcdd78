"""How many trials saw each status, whichever others they saw beside it."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

from ...campaigns.fly.results import BatchResult
from ...campaigns.fly.workers.status_texts import worst_statuses


class SeenStatus(NamedTuple):
    """A status as the worst that a signal of a variant reported, in ``seen`` of ``trials``."""

    variant: str
    signal: str
    status: int
    seen: int
    trials: int


def seen_statuses(result: BatchResult) -> list[SeenStatus]:
    """Counts by variant, signal and status; none where no trial reported two, as the table of ends tells all then."""
    if not any(len(worst_statuses(text)) > 1 for entry in result.summary.values() for text in entry["statuses"]):
        return []
    found = []
    for variant, entry in result.summary.items():
        counts: Counter[tuple[str, int]] = Counter()
        for text, trials in entry["statuses"].items():
            counts.update(dict.fromkeys(worst_statuses(text).items(), trials))
        found += [SeenStatus(variant, *status, count, entry["trials"]) for status, count in sorted(counts.items())]
    return found
