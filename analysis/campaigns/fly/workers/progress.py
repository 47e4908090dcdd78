"""How far a campaign is: flights done and failed, their rate, the time that is left; nothing where nobody looks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from tqdm.std import tqdm as text_bar

from ....common.progress import progress_bar
from ...trials import Trials


class FlightProgress:
    """A bar over flights."""

    def __init__(self, bar: text_bar) -> None:
        self._bar = bar
        self._failed = 0

    def add(self, trials: Mapping[str, Trials]) -> None:
        """Count trials that have flown, by variant; those that failed did not come to their end."""
        self._failed += sum(len(rows.messages) for rows in trials.values())
        self._bar.set_postfix_str(f"{self._failed} failed", refresh=False)
        self._bar.update(sum(len(rows) for rows in trials.values()))


@contextmanager
def flight_progress(flights: int) -> Iterator[FlightProgress]:
    """A bar of so many flights, which goes at the end."""
    with progress_bar(total=flights, unit="flight") as bar:
        yield FlightProgress(bar)
