"""What a study of sensitivity comes to: text, document, table of flights."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..atomic import write_atomically
from ..batch.shards.files import write_parquet
from ..batch.tables import aligned
from ..campaign.draw_space import DrawSpace
from ..samples.flown import Flown, strict
from .sobol import CONFIDENCE, Indices


@dataclass(frozen=True, eq=False)
class SensitivityResult:
    """Sobol' ``indices`` of the numbers ``told`` (None where there are none), and why others have none, ``untold``.

    ``ranks`` are rank correlations by number and draw. ``facts`` are what the result depends on, ``noise`` what is said
    of random numbers that components draw themselves.
    """

    base: int
    space: DrawSpace
    told: tuple[str, ...]
    indices: Indices | None
    untold: Mapping[str, str]
    ranks: Mapping[str, Mapping[str, float | None]]
    flown: Flown
    facts: dict[str, Any]
    noise: str
    noise_trial: int

    @property
    def flights(self) -> int:
        """How many were flown."""
        return len(self.flown.values)

    def of(self, number: str) -> dict[str, dict[str, Any]]:
        """What each draw does to a metric or to ``success``: ``first``, ``total``, their intervals, ``rank``."""
        found: dict[str, dict[str, Any]] = {name: {"rank": self.ranks[number][name]} for name in self.space.names}
        if self.indices is not None and number in self.told:
            row = self.told.index(number)
            for place, name in enumerate(self.space.names):
                for order in ("first", "total"):
                    found[name][order] = float(getattr(self.indices, order)[row, place])
                    ends = getattr(self.indices, f"{order}_interval")[:, row, place]
                    found[name][f"{order}_interval"] = [strict(end) for end in ends]
        return found

    def document(self) -> dict[str, Any]:
        """The machine-readable result."""
        return {
            **self.facts,
            "held": self.space.held,
            "noise_trial": self.noise_trial if self.noise else None,
            "base": self.base,
            "flights": self.flights,
            "confidence": CONFIDENCE,
            "sensitivity": {name: self.of(name) for name in self.ranks},
            "without_indices": dict(self.untold),
        }

    def text(self) -> str:
        """The result for a terminal: a table for each number, its draws in order of their total index."""
        percent = f"{100 * CONFIDENCE:g} %"
        lines = [f"{self.flights} flights: Sobol' indices and their {percent} intervals, rank correlations"]
        lines += [self.noise] if self.noise else []
        if self.space.held:
            lines.append(f"held: {', '.join(f'{name} = {value:g}' for name, value in self.space.held.items())}")
        for number in self.told:
            found = self.of(number)
            rows = [[number, "total", percent, "first", percent, "rank"]]
            for name in sorted(found, key=lambda name: -found[name]["total"]):
                entry = found[name]
                cells = [
                    cell
                    for order in ("total", "first")
                    for cell in (_told(entry[order]), " to ".join(map(_told, entry[f"{order}_interval"])))
                ]
                rows.append([f"  {name}", *cells, _told(entry["rank"])])
            lines += ["", *aligned(rows)]
        lines += ["", *(f"{name}: no indices, {why}" for name, why in self.untold.items())] if self.untold else []
        return "\n".join(line.rstrip() for line in lines)

    def write(self, folder: Path) -> None:
        """Write sensitivity.json and flights.parquet."""
        write_parquet(self.flown.table("success"), folder / "flights.parquet")
        text = f"{json.dumps(self.document(), indent=1, allow_nan=False)}\n"
        write_atomically(folder / "sensitivity.json", text.encode())


def _told(value: float | None) -> str:
    return "-" if value is None else f"{value:.2f}"
