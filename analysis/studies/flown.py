"""Simulations of a study, a row each, and the base of the results of all studies."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar, NamedTuple, TypedDict

import numpy as np
import pyarrow

from ...common.atomic import write_atomically
from ..campaigns.draws.declared import input_names
from ..campaigns.draws.given import stream_component
from ..campaigns.folder.files import write_parquet
from ..campaigns.lost_trials import lost_words
from .draw_space import DrawSpace
from .flights import StudyProvenance
from .noise import Noise, conditions

Columns = Mapping[str, np.ndarray]


def strict(value: float) -> float | None:
    """Return a number as strict JSON can hold it."""
    return float(value) if np.isfinite(value) else None


def _is_stream(name: str) -> bool:
    return stream_component(name) is not None


class FlightDocument(TypedDict):
    """Draws and metrics of one flight as strict JSON."""

    draws: dict[str, float]
    metrics: dict[str, float | str | None]


class Flown:
    """Flights as they come: ``points`` (flights, dimensions) with what they are worth, ``values`` (flights,).

    ``draws`` and ``metrics`` are columns (flights,) by name. Drawn values come before derived ones.
    """

    def __init__(self) -> None:
        self._parts: list[tuple[np.ndarray, Columns, Columns, np.ndarray]] = []
        self.points = np.empty((0, 0))
        self.draws: dict[str, np.ndarray] = {}
        self.metrics: dict[str, np.ndarray] = {}
        self.values = np.empty(0)

    def add(self, points: np.ndarray, draws: Columns, metrics: Columns, values: np.ndarray) -> None:
        self._parts.append((points, draws, metrics, values))

    def whole(self) -> Flown:
        points, draws, metrics, values = zip(*self._parts, strict=True)
        self.points, self.values = np.concatenate(points), np.concatenate(values)
        self.draws = {name: np.concatenate([part[name] for part in draws]) for name in draws[0]}
        self.metrics = {name: np.concatenate([part[name] for part in metrics]) for name in metrics[0]}
        return self

    def fact(self, row: int, number: Callable[[float], float | str | None] = strict) -> FlightDocument:
        """Return draws and metrics of one flight as strict JSON: values that are not finite are
        null, unless by ``number``."""
        return {
            "draws": {name: float(column[row]) for name, column in self.draws.items() if not _is_stream(name)},
            "metrics": {name: number(column[row]) for name, column in self.metrics.items()},
        }

    def draw_table(self, names: list[str], rows: np.ndarray) -> pyarrow.Table:
        """Return the draws of some flights, as `perilune batch --draws` takes them; ``names`` are the campaign's.

        Their random streams are columns of the table, too.
        """
        streams = filter(_is_stream, self.draws)
        return pyarrow.table({name: self.draws[name][rows] for name in (*names, *streams)})

    def streams(self, row: int) -> dict[str, int]:
        """Return the trials whose random streams components had in one flight, by component;
        `ALL` stands for the others."""
        columns = ((stream_component(name), column) for name, column in self.draws.items())
        return {component: int(column[row]) for component, column in columns if component is not None}

    def table(self, value_name: str) -> pyarrow.Table:
        """Return a row per flight: draws, metrics and, under the name ``value_name``, the value."""
        columns = {f"draw.{name}": column for name, column in self.draws.items()}
        columns |= {f"metric.{name}": column for name, column in self.metrics.items()}
        return pyarrow.table(columns | {value_name: self.values})


class StudyCommands(NamedTuple):
    """Commands: ``replay`` repeats a trial of a file of draws, ``monte_carlo`` simulates a
    number of trials of the campaign."""

    replay: Callable[[Path, int], str]
    monte_carlo: Callable[[int], str] | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class StudyResult:
    """Base of results of studies: the draws as a ``space``, and every simulation in ``flown``.

    ``facts`` are the inputs of the numbers, ``noise`` the random numbers that components draw themselves, ``units``
    those of draws and metrics by name. ``commands`` write the command lines that repeat simulations, where known.
    ``lost`` counts simulations that crashed, hung or ran out of memory: they are failures, and no successes.
    """

    DRAWS: ClassVar[str]  # the file of draws with which flights are flown again

    space: DrawSpace
    flown: Flown
    facts: StudyProvenance
    noise: Noise
    units: Mapping[str, str]
    lost: Mapping[str, int] = field(default_factory=dict)
    commands: StudyCommands | None = None

    @property
    def flights(self) -> int:
        return len(self.flown.values)

    @property
    def conditions(self) -> str:
        """Conditions of the numbers, as the end of a line; empty where there are none."""
        words = lost_words(self.lost)
        lost = f", {words} of {self.flights} simulations counted as failures" if words else ""
        return f"{conditions(self.noise, self.space.held)}{lost}"

    def replay(self, folder: Path | None, trial: int) -> str:
        """Return the command that repeats a row of the file of draws; empty where it is not written to a folder."""
        return "" if folder is None or self.commands is None else self.commands.replay(folder / self.DRAWS, trial)

    def json_document(self, folder: Path | None = None) -> dict[str, object]:
        """Return the machine-readable result; ``folder`` is where it has been written, if it has."""
        raise NotImplementedError

    def _condition_document(self) -> dict[str, object]:
        return {
            "held": self.space.held,
            **({"lost": dict(self.lost)} if self.lost else {}),
            **self.noise.document(),
            "conditional": bool(self.conditions),
            "conditions": self.conditions.removeprefix(", "),
        }

    def _write(self, folder: Path, name: str, value_name: str, rows: np.ndarray) -> None:
        """Write the draws of some flights for `--draws`, all flights, and the document."""
        if rows.size:
            write_parquet(self.flown.draw_table(input_names(self.space.campaign), rows), folder / self.DRAWS)
        write_parquet(self.flown.table(value_name), folder / "flights.parquet")
        text = f"{json.dumps(self.json_document(folder), indent=1, allow_nan=False)}\n"
        write_atomically(folder / f"{name}.json", text.encode())
