"""The memory of a system at an operating point, and how large everything is that it remembers."""

from __future__ import annotations

import copy

import numpy as np

from ...runtime.flight.memory import Cell, Memory
from .bench import Bench

LOOKS = 20  # communication points on the way to the operating point at which sizes are looked at
LEAST = 1e-6  # of the largest number with the same unit: what is smaller is rounding, or happens to be near 0
NEVER = 1e-3  # likewise, of a vector that has been 0 all the way
NOTHING = 1e-9  # in SI: what has a unit and is smaller has not been used yet, and tells no scale


class OperatingPoint:
    """A bench flown to its operating point and saved there.

    ``scale`` [cells] is what a change of each cell is measured by: the largest number that the cell, or another one of
    its vector, has held on the way, at least LEAST of the largest with its unit (NEVER, where the vector has held
    nothing yet), and 1 where nothing tells a scale. Vectors without a unit, such as covariances, mix quantities:
    there each cell is measured by itself.
    ``sizes``: likewise of the signals at the cuts, by loop.
    """

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.memory = Memory(bench.simulation)
        self.sizes: dict[str, float] = {}
        largest = np.zeros(len(self.memory.cells))
        last = -1
        for point in np.unique(np.linspace(0, bench.origin, LOOKS).astype(int)):
            signals = bench.fly(last, int(point))
            last = int(point)
            largest = np.maximum(largest, abs(self.memory.read()))
            for channel in bench.channels:
                size = float(np.max(abs(channel.injection_for(signals)), initial=0.0))
                self.sizes[channel.loop] = max(self.sizes.get(channel.loop, 0.0), size)
        self.snapshot = self.memory.take(last)
        self.sizes = {loop: size or 1.0 for loop, size in self.sizes.items()}
        self.scale = _scales(self.memory.cells, largest, self.memory.read())

    def one_period_on(self) -> OperatingPoint:
        """The same one hyperperiod later, measured by the same sizes; this one's snapshot stays as it is."""
        later = copy.copy(self)
        self.memory.put_back(self.snapshot)
        last = self.snapshot.point + self.bench.period
        self.bench.fly(self.snapshot.point, last)
        later.snapshot = self.memory.take(last)
        return later

    def release(self) -> None:
        """Free what was saved."""
        self.memory.release(self.snapshot)


def _scales(cells: list[Cell], largest: np.ndarray, now: np.ndarray) -> np.ndarray:
    vectors: dict[str, float] = {}
    minimum: dict[str, float] = {}
    units: dict[str, float] = {}
    names = [cell.name.partition("[")[0] for cell in cells]
    for cell, name, size, present in zip(cells, names, largest, abs(now), strict=True):
        vectors[name] = max(vectors.get(name, 0.0), float(size))
        if present > 0.0:
            minimum[name] = min(minimum.get(name, np.inf), float(present))
        if cell.unit is not None:
            units[cell.unit] = max(units.get(cell.unit, 0.0), float(size))
    scales = []
    for cell, name, present in zip(cells, names, abs(now), strict=True):
        if cell.unit is None:
            scales.append(float(present) or minimum.get(name, 1.0))
            continue
        like = units[cell.unit]
        scale = max(vectors[name], LEAST * like) if vectors[name] > 0.0 else NEVER * like
        scales.append(scale if scale >= NOTHING else 1.0)
    return np.array(scales)
