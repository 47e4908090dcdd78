"""What a study of a rare failure comes to: text, document, tables, trials to fly again."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ..atomic import write_atomically
from ..batch.shards.files import write_parquet
from ..batch.tables import aligned
from ..campaign.draw_space import DrawSpace
from ..campaign.failure import Failure
from ..samples.flown import Flown, strict
from .subset_simulation import Level, SubsetSimulation
from .uncertainty import CONFIDENCE

TOLD = 5  # failures
APART = 1.0  # standard deviations: a failure nearer to a likelier one is not told


@dataclass(frozen=True, eq=False)
class RareResult:
    """The probability of a ``failure``, and the flights that it was found by.

    ``simulation`` has the numbers, ``flown`` every flight, ``facts`` what they depend on, ``noise`` what is said of
    random numbers that components draw themselves.
    """

    failure: Failure
    simulation: SubsetSimulation
    space: DrawSpace
    flown: Flown
    facts: dict[str, Any]
    noise: str
    noise_trial: int
    samples: int

    @property
    def probability(self) -> float | None:
        """Of the failure; None where it was not reached."""
        return self.simulation.probability

    @property
    def interval(self) -> tuple[float, float]:
        """The 95 % interval of the probability."""
        return self.simulation.interval.low, self.simulation.interval.high

    @property
    def flights(self) -> int:
        """How many were flown."""
        return self.simulation.evaluations

    @property
    def brute_force(self) -> float | None:
        """How many flights of the campaign itself would have had as small a deviation; None where nothing says."""
        share, variation = self.probability, self.simulation.interval.variation
        return None if share is None or variation == 0.0 else (1.0 - share) / (share * variation**2)

    @cached_property
    def failures(self) -> list[dict[str, Any]]:
        """The likeliest failed flights: number in failures.parquet, ``distance``, ``margin``, ``draws``, ``metrics``.

        The distance is in standard deviations from the medians of the draws, as independent normal ones.
        """
        return [
            {
                "trial": trial,
                "distance": float(np.linalg.norm(self.flown.points[place])),
                "margin": strict(self.flown.values[place]),
                **self.flown.fact(place),
            }
            for trial, place in enumerate(self._places)
        ]

    @cached_property
    def _places(self) -> np.ndarray:
        """Of the likeliest failures among those flown: nearest to the origin first, where points are densest."""
        failed = np.flatnonzero(self.flown.values >= 0.0)
        points = self.flown.points
        chosen: list[int] = []
        for place in failed[np.argsort(np.linalg.norm(points[failed], axis=1), kind="stable")]:
            if all(np.linalg.norm(points[place] - points[other]) > APART for other in chosen):
                chosen.append(int(place))
            if len(chosen) == TOLD:
                break
        return np.array(chosen, dtype=int)

    def values(self) -> dict[str, float]:
        """The numbers that requirements are about: probability, interval[1] and [2], flights."""
        share = math.nan if self.probability is None else self.probability
        low, high = self.interval
        return {"probability": share, "interval[1]": low, "interval[2]": high, "flights": float(self.flights)}

    def document(self) -> dict[str, Any]:
        """The machine-readable result."""
        simulation = self.simulation
        return {
            **self.facts,
            "failure": self.failure.text,
            "samples": self.samples,
            "held": self.space.held,
            "noise_trial": self.noise_trial if self.noise else None,
            "probability": self.probability,
            "interval": list(self.interval),
            "confidence": CONFIDENCE,
            "variation": simulation.interval.variation,
            "flights": self.flights,
            "brute_force_flights": self.brute_force,
            "families": simulation.families,
            "levels": [_level_fact(level) for level in simulation.levels],
            "failures": self.failures,
        }

    def text(self) -> str:
        """The result for a terminal."""
        low, high = self.interval
        percent = f"{100 * CONFIDENCE:g} %"
        found = f"not reached; probability below {high:.3g}, {percent}"
        price = f"{self.flights} flights in {len(self.simulation.levels)} levels"
        if self.probability is not None:
            found = f"probability {self.probability:.3g}, {percent} interval {low:.3g} to {high:.3g}"
        if self.brute_force is not None:
            price += f"; trials of the campaign that say as much: {self.brute_force:.2g}"
        lines = [f"{self.failure.text}: {found}", price]
        if self.noise:
            lines.append(self.noise)
        if self.space.held:
            lines.append(f"held: {', '.join(f'{name} = {value:g}' for name, value in self.space.held.items())}")
        levels = [_level_cells(place, level) for place, level in enumerate(self.simulation.levels)]
        lines += ["", *aligned([LEVEL_HEADS, *levels])]
        if self.failures:
            rows = [["likeliest failures", "sigmas", "margin", *self.space.names]]
            for entry in self.failures:
                margin = "-" if entry["margin"] is None else f"{entry['margin']:.4g}"
                drawn = [f"{entry['draws'][name]:.6g}" for name in self.space.names]
                rows.append([f"trial {entry['trial']}", f"{entry['distance']:.2f}", margin, *drawn])
            lines += ["", *aligned(rows)]
        return "\n".join(line.rstrip() for line in lines)

    def write(self, folder: Path) -> None:
        """Write rare.json, flights.parquet and, where there are failures, failures.parquet for `--draws`."""
        if self.failures:
            drawn = [name for draw in self.space.campaign.draws for name in draw.names]
            write_parquet(self.flown.given(drawn, self._places), folder / "failures.parquet")
        write_parquet(self.flown.table("margin"), folder / "flights.parquet")
        write_atomically(folder / "rare.json", f"{json.dumps(self.document(), indent=1, allow_nan=False)}\n".encode())


LEVEL_HEADS = ["level", "margin from", "flown", "probability", "taken", "gamma", "deviation"]


def _level_fact(level: Level) -> dict[str, Any]:
    return vars(level) | {"threshold": None if level.threshold is None else strict(level.threshold)}


def _level_cells(place: int, level: Level) -> list[str]:
    return [
        str(place + 1),
        "-" if level.threshold is None else f"{level.threshold:.4g}",
        str(level.samples),
        f"{level.probability:.4f}",
        "-" if level.taken is None else f"{level.taken:.2f}",
        f"{level.correlation:.2f}",
        f"{level.deviation:.3f}",
    ]
