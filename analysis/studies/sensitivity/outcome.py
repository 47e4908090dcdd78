"""What a study of sensitivity comes to: text, document, table of flights."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...campaigns.draws.declared import input_names
from ...campaigns.fly.shards.files import write_parquet
from ...campaigns.spec.draw_space import DrawSpace
from ...campaigns.tables import align_columns, assumption_lines
from ...common.atomic import write_atomically
from ..evaluation.commands import Commands
from ..evaluation.flown import Flown, strict
from ..evaluation.noise import Noise, conditions, noise_line
from ..evaluation.units import with_unit
from .sobol import CONFIDENCE, Indices

NOISE = "noise realisation"  # the input that all random noise is
DRAWS = "draws.parquet"


@dataclass(frozen=True, eq=False)
class SensitivityResult:
    """Sobol' ``indices`` of the numbers ``told`` (None where there are none), and why others have none, ``untold``.

    ``ranks`` are rank correlations by number and draw; the noise has none. ``facts`` are what the result depends on,
    ``noise`` the random numbers that components draw themselves: one input more where they are random. ``units`` are
    those of draws and metrics by name, ``commands`` write the command lines that fly flights again, where known.
    """

    base: int
    space: DrawSpace
    told: tuple[str, ...]
    indices: Indices | None
    untold: Mapping[str, str]
    ranks: Mapping[str, Mapping[str, float | None]]
    flown: Flown
    facts: dict[str, Any]
    noise: Noise
    units: Mapping[str, str]
    commands: Commands | None = None

    @property
    def flights(self) -> int:
        """How many were flown."""
        return len(self.flown.values)

    @property
    def inputs(self) -> list[str]:
        """What varies: the draws, and the noise as one input where it is random."""
        return [*self.space.names, *([NOISE] if self.noise.sources else [])]

    @property
    def conditions(self) -> str:
        """What the numbers are conditional on, as the end of a line; empty where they are not."""
        return conditions(self.noise, self.space.held)

    def of(self, number: str) -> dict[str, dict[str, Any]]:
        """What each input does to a metric or to ``success``: ``first``, ``total``, their intervals, ``rank``.

        The noise has no rank: its realisations have no order.
        """
        rows: dict[str, dict[str, Any]] = {name: {"rank": self.ranks[number].get(name)} for name in self.inputs}
        if self.indices is not None and number in self.told:
            row = self.told.index(number)
            for index, name in enumerate(self.inputs):
                for order in ("first", "total"):
                    rows[name][order] = float(getattr(self.indices, order)[row, index])
                    ends = getattr(self.indices, f"{order}_interval")[:, row, index]
                    rows[name][f"{order}_interval"] = [strict(end) for end in ends]
        return rows

    def replay(self, folder: Path | None, flight: int) -> str:
        """The command that flies one of the flights again; empty where they are not written to a folder."""
        return "" if folder is None or self.commands is None else self.commands.replay(folder / DRAWS, flight)

    def document(self, folder: Path | None = None) -> dict[str, Any]:
        """The machine-readable result; ``folder`` is where it has been written, if it has."""
        replay = self.replay(folder, 0)
        return {
            **self.facts,
            "held": self.space.held,
            **self.noise.document(),
            "conditional": bool(self.conditions),
            "conditions": self.conditions.removeprefix(", "),
            "inputs": self.inputs,
            "units": dict(self.units),
            "base": self.base,
            "flights": self.flights,
            "confidence": CONFIDENCE,
            "sensitivity": {name: self.of(name) for name in self.ranks},
            "without_indices": dict(self.untold),
            **({"replay": replay} if replay else {}),
        }

    def text(self, folder: Path | None = None) -> str:
        """The result for a terminal: a table for each number, its inputs in order of their total index."""
        percent, under = f"{100 * CONFIDENCE:g} %", self.conditions
        lines = [f"{self.flights} flights: Sobol' indices and their {percent} intervals, rank correlations{under}"]
        lines += [line for line in (noise_line(self.noise),) if line]
        if self.noise.sources:
            lines.append(f"{NOISE}: all of these components as one input; rank correlations leave it out")
        lines += assumption_lines(self.facts)
        for number in self.told:
            indices = self.of(number)
            rows = [[with_unit(number, self.units), "total", percent, "first", percent, "rank"]]
            for name in sorted(indices, key=lambda name: -indices[name]["total"]):
                entry = indices[name]
                cells = [
                    cell
                    for order in ("total", "first")
                    for cell in (_text(entry[order]), " to ".join(map(_text, entry[f"{order}_interval"])))
                ]
                rows.append([f"  {with_unit(name, self.units)}", *cells, _text(entry["rank"])])
            lines += ["", *([f"{number}{under}"] if under else []), *align_columns(rows)]
        lines += ["", *(f"{name}: no indices, {why}" for name, why in self.untold.items())] if self.untold else []
        replay = self.replay(folder, 0)
        lines += [
            "",
            f"replay: {replay}" if replay else "replay: needs the folder of `output`",
        ]
        return "\n".join(line.rstrip() for line in lines)

    def write(self, folder: Path) -> None:
        """Write sensitivity.json, flights.parquet, and draws.parquet of all flights for `--draws`."""
        sampled = input_names(self.space.campaign)
        write_parquet(self.flown.given(sampled, np.arange(self.flights)), folder / DRAWS)
        write_parquet(self.flown.table("success"), folder / "flights.parquet")
        text = f"{json.dumps(self.document(folder), indent=1, allow_nan=False)}\n"
        write_atomically(folder / "sensitivity.json", text.encode())


def _text(value: float | None) -> str:
    return "-" if value is None else f"{round(value, 2) + 0.0:.2f}"
