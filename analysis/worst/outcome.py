"""What a search for the worst case comes to: text, document, tables, trials to fly again."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..atomic import write_atomically
from ..batch.shards.files import write_parquet
from ..batch.tables import aligned
from ..campaign.draw_space import DrawSpace
from ..samples.flown import Flown
from .metric import Badness
from .search import Phase

WORST = "worst.parquet"


@dataclass(frozen=True, eq=False)
class WorstResult:
    """The worst flight of a box of draws: its ``value`` of ``badness``, infinite where it failed, and ``place`` in the
    unit cube.

    ``random`` is the number, in ``flown``, of the worst of the random trials that it is told beside; ``facts`` are what
    the result depends on, ``noise`` what is said of random numbers that components draw themselves, ``reason`` why the
    worst failed, where that is known. ``again`` gives the command that studies trial 0 of a file of draws again, where
    another than `perilune batch` does. ``phases`` are those of the search, the random trials first.
    """

    badness: Badness
    sigmas: float
    value: float
    place: np.ndarray
    random: int
    random_trials: int
    space: DrawSpace
    flown: Flown
    facts: dict[str, Any]
    noise: str
    noise_trial: int
    reason: str = ""
    again: Callable[[Path], str] | None = None
    phases: tuple[Phase, ...] = ()

    @property
    def flights(self) -> int:
        """How many were flown."""
        return len(self.flown.values)

    @property
    def worst(self) -> dict[str, Any]:
        """The worst flight: ``value`` (None where it failed), ``trial`` of worst.parquet, ``draws``, ``metrics``."""
        return {"trial": 0, "value": self._told(self.value), **self.flown.fact(self.places[0], self.badness.fact)}

    @property
    def worst_random(self) -> dict[str, Any]:
        """The worst of the random trials, and whether it is ``inside`` the box."""
        place = self.flown.points[self.random]
        inside = bool(np.all((place >= 0.0) & (place <= 1.0)))
        value = self._told(float(self.flown.values[self.random]))
        return {"trial": 1, "value": value, "inside": inside, **self.flown.fact(self.random, self.badness.fact)}

    def _told(self, value: float) -> float | str | None:
        """A value as JSON has it: null where it failed, of a margin a word where it is no number."""
        return self.badness.fact(self.badness.size(value))

    @property
    def places(self) -> list[int]:
        """Of the worst flight and of the worst random one, among those flown."""
        same = np.all(self.flown.points == self.place, axis=1) & (self.flown.values == self.value)
        return [int(np.argmax(same)), self.random]

    def values(self) -> dict[str, float]:
        """The numbers that requirements are about: worst, random, flights."""
        worst, random = (self.badness.size(float(value)) for value in (self.value, self.flown.values[self.random]))
        return {"worst": worst, "random": random, "flights": float(self.flights)}

    def document(self, folder: Path | None = None) -> dict[str, Any]:
        """The machine-readable result; ``folder`` is where it has been written, if it has."""
        replay = self._replay(folder)
        return {
            **self.facts,
            "metric": self.badness.text,
            "sigmas": self.sigmas,
            "held": self.space.held,
            "noise_trial": self.noise_trial if self.noise else None,
            "flights": self.flights,
            "random_trials": self.random_trials,
            "worst": self.worst,
            "worst_random": self.worst_random,
            **({"reason": self.reason} if self.reason else {}),
            **({"replay": replay} if replay else {}),
        }

    def _replay(self, folder: Path | None) -> str:
        return "" if folder is None or self.again is None else self.again(folder / WORST)

    def text(self, folder: Path | None = None) -> str:
        """The result for a terminal; ``folder`` as in `document`."""
        found, random = self.worst, self.worst_random
        within = f"within {self.sigmas:g} sigmas of normal draws and the ends of others"
        outside = "" if random["inside"] else ", outside the box"
        lines = [
            f"{self.badness.text}: worst {_shown(found['value'])} in {self.flights} flights, {within}",
            f"worst of {self.random_trials} random trials: {_shown(random['value'])}{outside}",
        ]
        lines += [f"failed: {self.reason}"] if self.reason else []
        lines += [self.noise] if self.noise else []
        if self.space.held:
            lines.append(f"held: {', '.join(f'{name} = {value:g}' for name, value in self.space.held.items())}")
        rows = [["", "trial 0: worst", "trial 1: random"]]
        for part in ("draws", "metrics"):
            names = self.space.names if part == "draws" else list(found[part])
            rows += [[name, _shown(found[part][name]), _shown(random[part][name])] for name in names]
        replay = self._replay(folder)
        lines += ["", *aligned(rows), *(["", f"again: {replay}"] if replay else [])]
        return "\n".join(line.rstrip() for line in lines)

    def write(self, folder: Path) -> None:
        """Write worst.json, flights.parquet, and worst.parquet for `--draws`: the worst trial, and the random one."""
        drawn = [name for draw in self.space.campaign.draws for name in draw.names]
        write_parquet(self.flown.given(drawn, np.array(self.places)), folder / WORST)
        write_parquet(self.flown.table("value"), folder / "flights.parquet")
        write_atomically(
            folder / "worst.json", f"{json.dumps(self.document(folder), indent=1, allow_nan=False)}\n".encode()
        )


def _shown(value: float | str | None) -> str:
    return value if isinstance(value, str) else "failed" if value is None else f"{value:.6g}"
