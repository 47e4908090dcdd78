"""The rows of a reference flight."""

from __future__ import annotations

from typing import NamedTuple


class Rows(NamedTuple):
    """Signals by name, a number for each ``time`` (s), and the status, one of the words of `flight.results.Flight`."""

    time: list[float]
    signals: dict[str, list[float]]
    status: str
