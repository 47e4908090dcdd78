"""Points of a study of a rare failure: normal draws, and the random streams of the components that have noise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Points:
    """``draws`` (points, dimensions), standard normal, and ``streams`` (points, sources), a number each.

    Points with the same number in a column have the same noise of that source; other numbers are independent of it.
    """

    draws: np.ndarray
    streams: np.ndarray

    def rows(self, rows: np.ndarray) -> Points:
        """Some of the points, by their numbers or by whether they are among them."""
        return Points(self.draws[rows], self.streams[rows])

    def __len__(self) -> int:
        return len(self.draws)


MarginOf = Callable[[Points], np.ndarray]


class FreshStreams:
    """Numbers of streams, each given once, from 0 on: the noise of trials that nothing has flown before."""

    def __init__(self) -> None:
        self._next = 0

    def take(self, count: int) -> np.ndarray:
        """The next ``count`` numbers."""
        self._next += count
        return np.arange(self._next - count, self._next)
