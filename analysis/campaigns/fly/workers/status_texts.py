"""How a trial ended, as the text that results and tables have of it."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ....runtime.flight.results import Flight

WORST = re.compile(r"([^\s(),]+) (-?\d+)[,)]")


def trial_status(result: Flight, statuses: Iterable[str]) -> str:
    """How a trial ended, with the worst status of every component that reported other than 0.

    For instance ``finished`` or ``finished (guidance.status 2)``.
    """
    worst: list[str] = []
    for name in statuses:
        values = result.signals[name]
        status = int(values.max()) if values.size else 0
        if status:
            worst.append(f"{name} {status}")
    return f"{result.status} ({', '.join(worst)})" if worst else result.status


def worst_statuses(text: str) -> dict[str, int]:
    """What `trial_status` says in its brackets: the worst status other than 0 by the signal that reported it."""
    return {name: int(value) for name, value in WORST.findall(text)}
