"""How many trials saw each status, whichever others they saw beside it."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

from ...batch.results import BatchResult
from ...batch.status_texts import worst_statuses


class SeenStatus(NamedTuple):
    """A status as the worst that a signal of a variant reported, in ``seen`` of ``trials``."""

    variant: str
    signal: str
    status: int
    seen: int
    trials: int


def seen_statuses(result: BatchResult) -> list[SeenStatus]:
    """Counts by variant, signal and status; none where no trial reported two, as the table of ends tells all then."""
    reports = {name: [worst_statuses(text) for text in trials.statuses] for name, trials in result.trials.items()}
    if not any(len(found) > 1 for rows in reports.values() for found in rows):
        return []
    return [
        SeenStatus(variant, signal, status, count, len(rows))
        for variant, rows in reports.items()
        for (signal, status), count in sorted(Counter(entry for found in rows for entry in found.items()).items())
    ]
