"""What a study has flown, a row per flight, in the order of flight."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pyarrow

from ..campaigns.draws.given import stream_component


def strict(value: float) -> float | None:
    """A number as strict JSON can hold it."""
    return float(value) if np.isfinite(value) else None


def _is_stream(name: str) -> bool:
    return stream_component(name) is not None


class _Part(NamedTuple):
    points: np.ndarray
    draws: Mapping[str, np.ndarray]
    metrics: Mapping[str, np.ndarray]
    values: np.ndarray


class Flown:
    """Flights as they come: ``points`` (flights, dimensions) with what they are worth, ``values`` (flights,).

    ``draws`` and ``metrics`` are columns (flights,) by name. Drawn values come before derived ones.
    """

    def __init__(self) -> None:
        self._parts: list[_Part] = []
        self.points = np.empty((0, 0))
        self.draws: dict[str, np.ndarray] = {}
        self.metrics: dict[str, np.ndarray] = {}
        self.values = np.empty(0)

    def add(
        self,
        points: np.ndarray,
        draws: Mapping[str, np.ndarray],
        metrics: Mapping[str, np.ndarray],
        values: np.ndarray,
    ) -> None:
        self._parts.append(_Part(points, draws, metrics, values))

    def whole(self) -> Flown:
        """With all of them joined."""
        points, draws, metrics, values = zip(*self._parts, strict=True)
        self.points, self.values = np.concatenate(points), np.concatenate(values)
        self.draws = {name: np.concatenate([part[name] for part in draws]) for name in draws[0]}
        self.metrics = {name: np.concatenate([part[name] for part in metrics]) for name in metrics[0]}
        return self

    def fact(self, place: int, told: Callable[[float], float | str | None] = strict) -> dict[str, Any]:
        """Draws and metrics of one flight, as strict JSON has them: what is not finite is null, unless ``told``."""
        return {
            "draws": {name: strict(column[place]) for name, column in self.draws.items() if not _is_stream(name)},
            "metrics": {name: told(column[place]) for name, column in self.metrics.items()},
        }

    def given(self, drawn: list[str], places: np.ndarray) -> pyarrow.Table:
        """The draws of some flights, as `perilune batch --draws` takes them; ``drawn`` are the campaign's.

        Their random streams are columns of the table, too.
        """
        streams = filter(_is_stream, self.draws)
        return pyarrow.table({name: self.draws[name][places] for name in (*drawn, *streams)})

    def streams(self, place: int) -> dict[str, int]:
        """The trials whose random streams components had in one flight, by component; `ALL` stands for the others."""
        columns = ((stream_component(name), column) for name, column in self.draws.items())
        return {component: int(column[place]) for component, column in columns if component is not None}

    def table(self, worth: str) -> pyarrow.Table:
        """A row per flight: draws, metrics and, under the name ``worth``, the value."""
        columns = {f"draw.{name}": column for name, column in self.draws.items()}
        columns |= {f"metric.{name}": column for name, column in self.metrics.items()}
        return pyarrow.table(columns | {worth: self.values})


class Commands(NamedTuple):
    """``replay`` flies a trial of a file of draws again, ``monte_carlo`` so many trials of the campaign itself."""

    replay: Callable[[Path, int], str]
    monte_carlo: Callable[[int], str]
