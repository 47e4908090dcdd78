"""What a study has flown: points, draws, metrics and margins, a row per flight, in the order of flight."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pyarrow

APART = 1.0  # standard deviations: failures nearer to each other than that are told once


class Flown:
    """Flights as they come: ``points`` (flights, dimensions), ``margins`` (flights,), draws and metrics by name."""

    def __init__(self) -> None:
        self._parts: list[tuple[np.ndarray, Mapping[str, np.ndarray], Mapping[str, np.ndarray], np.ndarray]] = []
        self.points = np.empty((0, 0))
        self.draws: dict[str, np.ndarray] = {}
        self.metrics: dict[str, np.ndarray] = {}
        self.margins = np.empty(0)

    def add(
        self,
        points: np.ndarray,
        draws: Mapping[str, np.ndarray],
        metrics: Mapping[str, np.ndarray],
        margins: np.ndarray,
    ) -> None:
        self._parts.append((points, draws, metrics, margins))

    def whole(self) -> Flown:
        """With all of them joined."""
        points, draws, metrics, margins = zip(*self._parts, strict=True)
        self.points, self.margins = np.concatenate(points), np.concatenate(margins)
        self.draws = {name: np.concatenate([part[name] for part in draws]) for name in draws[0]}
        self.metrics = {name: np.concatenate([part[name] for part in metrics]) for name in metrics[0]}
        return self

    def likeliest_failures(self, most: int) -> np.ndarray:
        """The places of up to ``most`` failed flights, the likeliest first: those nearest to the origin.

        The density of points falls with their distance from it. One within `APART` of a likelier one is left out.
        """
        failed = np.flatnonzero(self.margins >= 0.0)
        chosen: list[int] = []
        for place in failed[np.argsort(np.linalg.norm(self.points[failed], axis=1), kind="stable")]:
            gaps = [np.linalg.norm(self.points[place] - self.points[other]) for other in chosen]
            if all(gap > APART for gap in gaps):
                chosen.append(int(place))
            if len(chosen) == most:
                break
        return np.array(chosen, dtype=int)

    def table(self) -> pyarrow.Table:
        """A row per flight: draws, metrics and margin."""
        columns = {f"draw.{name}": values for name, values in self.draws.items()}
        columns |= {f"metric.{name}": values for name, values in self.metrics.items()}
        return pyarrow.table(columns | {"margin": self.margins})
