"""Rows recorded by the reference loop."""

from __future__ import annotations

from typing import NamedTuple


class Rows(NamedTuple):
    """Signals by name, with one number for each ``time`` (s), and the status, as in `flight.results.Flight`."""

    time: list[float]
    signals: dict[str, list[float]]
    status: str
