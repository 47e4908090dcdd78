"""When a flight was in which phase, and what each used up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...runtime.flight.results import Flight
from .declaration.stages import Phase, Phases


@dataclass(frozen=True)
class Span:
    """A phase from ``begin`` to ``end`` (s); ``spent`` is what it used up, None where that is not told."""

    name: str
    begin: float
    end: float
    spent: float | None


def spans_of(phases: Phases, flight: Flight) -> list[Span]:
    """The phases as they were flown, one after the other; a value without a name is its own.

    A phase is from the row in which its value stands first to that of the next one, the last to the end.
    """
    values = phases.signal.values(flight)[0]
    starts = [(0, values[0]), *((int(row) + 1, values[row + 1]) for row in np.flatnonzero(np.diff(values)))]
    ends = [row for row, _ in starts[1:]] + [values.size]
    firsts: list[tuple[int, str]] = []
    for (begin, value), end in zip(starts, ends, strict=True):
        named = [phase for phase in phases.phases if phase.value == value]
        firsts += _parts(named, flight, begin, end) if named else [(begin, f"{phases.signal.label} {value:g}")]
    spent = None if phases.spent is None else phases.spent.values(flight)[0]
    lasts = [row for row, _ in firsts[1:]] + [values.size - 1]
    return [
        Span(
            name=name,
            begin=float(flight.time[first]),
            end=float(flight.time[last]),
            spent=None if spent is None else float(spent[first] - spent[last]),
        )
        for (first, name), last in zip(firsts, lasts, strict=True)
    ]


def _parts(named: Sequence[Phase], flight: Flight, begin: int, end: int) -> list[tuple[int, str]]:
    """First row and name of the phases that share a value, between two rows; one that takes no row is left out."""
    found: list[tuple[int, str]] = []
    for phase in named:
        over = end
        if phase.until is not None:
            over = begin + int(np.argmax(np.append(phase.until.values(flight)[0][begin:end] != 0.0, True)))
        if over > begin:
            found.append((begin, phase.name))
        begin = over
    return found


def statuses_of(phases: Phases, flight: Flight) -> list[tuple[int, float]] | None:
    """Each status and when (s) it was there first, in order of time; None where statuses are not told."""
    if phases.status_times is not None:
        times = phases.status_times.values(flight)[:, -1]
        found = [(index, float(time)) for index, time in enumerate(times, 1) if time >= 0.0]
        return sorted(found, key=lambda entry: entry[1])
    if phases.status is None:
        return None
    values = phases.status.values(flight)[0]
    before = np.maximum.accumulate(np.concatenate([[0.0], values[:-1]]))
    return [(int(values[row]), float(flight.time[row])) for row in np.flatnonzero(values > before)]
