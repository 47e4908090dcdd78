"""Table of a study's simulations, and the base class of the results of all studies."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar, NamedTuple, TypedDict

import numpy as np
import pyarrow

from ...common.atomic import write_atomically
from ..campaigns.draws.interfaces import input_names
from ..campaigns.draws.supplied import stream_component
from ..campaigns.folder.shard_files import write_parquet
from ..campaigns.lost_trials import lost_words
from .draw_space import DrawSpace
from .noise import Noise, conditions
from .sample_flights import StudyProvenance

Columns = Mapping[str, np.ndarray]


def strict_number(value: float) -> float | None:
    """Return a number for strict JSON: None if it is not finite."""
    return float(value) if np.isfinite(value) else None


def _is_stream(name: str) -> bool:
    return stream_component(name) is not None


class FlightDocument(TypedDict):
    """Draws and metrics of one simulation as strict JSON."""

    draws: dict[str, float]
    metrics: dict[str, float | str | None]


class Flown:
    """Simulations of a study in order: ``points`` (flights, dimensions) and objective ``values`` (flights,).

    ``draws`` and ``metrics`` are columns (flights,) by name. Drawn values precede derived ones.
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

    def simulation_json(
        self, row: int, number: Callable[[float], float | str | None] = strict_number
    ) -> FlightDocument:
        """Return draws and metrics of one simulation as strict JSON; ``number`` converts the metrics."""
        return {
            "draws": {name: float(column[row]) for name, column in self.draws.items() if not _is_stream(name)},
            "metrics": {name: number(column[row]) for name, column in self.metrics.items()},
        }

    def draw_table(self, names: list[str], rows: np.ndarray) -> pyarrow.Table:
        """Return draws by ``names`` and random streams of some simulations as input for `perilune batch --draws`."""
        streams = filter(_is_stream, self.draws)
        return pyarrow.table({name: self.draws[name][rows] for name in (*names, *streams)})

    def streams(self, row: int) -> dict[str, int]:
        """Return, by component, the trial whose random streams one simulation used; `ALL`: all other components."""
        columns = ((stream_component(name), column) for name, column in self.draws.items())
        return {component: int(column[row]) for component, column in columns if component is not None}

    def table(self, value_name: str) -> pyarrow.Table:
        """Return a row per simulation: draws, metrics and, in the column ``value_name``, the objective value."""
        columns = {f"draw.{name}": column for name, column in self.draws.items()}
        columns |= {f"metric.{name}": column for name, column in self.metrics.items()}
        return pyarrow.table(columns | {value_name: self.values})


class StudyCommands(NamedTuple):
    """Command lines of a study: ``replay`` repeats a trial of a file of draws, ``monte_carlo`` simulates trials."""

    replay: Callable[[Path, int], str]
    monte_carlo: Callable[[int], str] | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class StudyResult:
    """Base class of the results of studies: the ``space`` of draws, and all simulations in ``flown``.

    ``facts`` are the inputs that determine the numbers, ``noise`` describes the random numbers that components
    generate, and ``units`` contains the units of draws and metrics by name. ``commands``, if known, returns the command
    lines that repeat simulations. ``lost`` counts simulations that crashed, hung or ran out of memory; these are
    failures.
    """

    DRAWS: ClassVar[str]  # file of draws for repeated simulations

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
        """Conditions under which the numbers hold, as the end of a line; "" if there are none."""
        words = lost_words(self.lost)
        lost = f", {words} of {self.flights} simulations counted as failures" if words else ""
        return f"{conditions(self.noise, self.space.held)}{lost}"

    def replay(self, folder: Path | None, trial: int) -> str:
        """Return the command that repeats a row of the file of draws; "" if there is no such file in a folder."""
        return "" if folder is None or self.commands is None else self.commands.replay(folder / self.DRAWS, trial)

    def json_document(self, folder: Path | None = None) -> dict[str, object]:
        """Return the result as JSON; ``folder`` is the folder to which it has been written, or None."""
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
        """Write the draws of some simulations for `--draws`, all simulations, and the document."""
        if rows.size:
            write_parquet(self.flown.draw_table(input_names(self.space.campaign), rows), folder / self.DRAWS)
        write_parquet(self.flown.table(value_name), folder / "flights.parquet")
        text = f"{json.dumps(self.json_document(folder), indent=1, allow_nan=False)}\n"
        write_atomically(folder / f"{name}.json", text.encode())
