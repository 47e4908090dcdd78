"""Central differences of a simulation over one hyperperiod, for changes of its initial memory and signals at cuts."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from .bench import OperatingPoint, StudyError
from .lifted import SampledChannel

STEPS = tuple(10.0**-power for power in range(3, 15))  # in units of a cell's scale or a signal's size
LEVELS = 4  # successive steps, from the largest one with which the simulation completes
SCREEN = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)  # the first with which the simulation completes determines the relevant cells
GOOD = 1e-3  # relative change between neighbouring steps below which a derivative has a plateau


class Jacobian:
    """Derivatives about the simulation of one hyperperiod from an operating point.

    Memory is changed at the communication point before the operating point; an excitation lasts one sample of its
    channel. A column consists of the memory after the period, in units of its scale, followed by u and v of all
    channels, each at its samples. ``start`` and ``end`` are the undisturbed memory before and after the period.
    """

    def __init__(self, operating_point: OperatingPoint) -> None:
        self.bench = operating_point.bench
        self.memory, self.snapshot = operating_point.memory, operating_point.snapshot
        self.scale, self.sizes = operating_point.scale, operating_point.sizes
        self.first, self.last = self.snapshot.point, self.snapshot.point + self.bench.period
        self.memory.restore(self.snapshot)
        self.start = self.memory.read()
        self.base = self.bench.fly(self.first, self.last)
        self.end = self.memory.read()
        ports: list[SampledChannel] = []
        for channel in self.bench.channels:
            first = ports[-1].first + ports[-1].count if ports else 0
            seconds = channel.period * self.bench.prepared.step
            ports.append(SampledChannel(channel, seconds, first, self.bench.period // channel.period))
        self.ports = tuple(ports)

    def _after(self, excitation: np.ndarray | None = None) -> np.ndarray:
        """Return memory, u and v after a simulation from the current memory."""
        bench = self.bench
        signals = bench.fly(self.first, self.last, excitation)
        added = np.zeros((bench.period, len(bench.connectors))) if excitation is None else excitation
        inside, back = [], []
        for channel in bench.channels:
            rows = slice(0, bench.period, channel.period)
            inside.append(channel.injection_for(signals)[rows])
            back.append(channel.return_signal(signals, added[:, bench.columns(channel)])[rows])
        return np.concatenate([self.memory.read() / self.scale, *inside, *back])

    def cell_column(self, cell: int, step: float) -> np.ndarray:
        """Return the derivative with respect to one cell; derivative and ``step`` are in units of the cell's scale."""
        high = self.start[cell] + step * self.scale[cell]
        low = self.start[cell] - step * self.scale[cell]
        self.memory.restore(self.snapshot, self.memory.cells[cell], high)
        above = self._after()
        self.memory.restore(self.snapshot, self.memory.cells[cell], low)
        return (above - self._after()) * (self.scale[cell] / (high - low))

    def input_column(self, port: SampledChannel, sample: int, step: float) -> np.ndarray:
        """Return the derivative with respect to an excitation at one sample of a channel.

        ``step`` is in units of the signal's magnitude.
        """
        channel = port.channel
        size = step * (channel.amplitude or self.sizes[channel.loop])
        ends = []
        for sign in (1.0, -1.0):
            added = np.zeros(self.bench.period)
            added[sample * channel.period : (sample + 1) * channel.period] = sign * size
            excitation = np.zeros((self.bench.period, len(self.bench.connectors)))
            excitation[:, self.bench.columns(channel)] = channel.excitation(self.base, added)
            self.memory.restore(self.snapshot)
            ends.append(self._after(excitation))
        return (ends[0] - ends[1]) / (2.0 * size)

    def screen(self, cell: int) -> np.ndarray:
        """Return the derivative with respect to a cell from one step, to find the cells that it affects.

        The step is smaller if the simulation would fail.
        """
        for step in SCREEN[:-1]:
            try:
                return self.cell_column(cell, step)
            except StudyError:
                continue
        return self.cell_column(cell, SCREEN[-1])


def plateau(column: Callable[[float], np.ndarray], steps: Sequence[float] = STEPS) -> tuple[np.ndarray, np.ndarray]:
    """Return each element of a column at the two neighbouring steps between which it changes least.

    Large steps are nonlinear, small ones are dominated by rounding; in between is a plateau. A pair of zeros only
    counts if there is no plateau elsewhere, since rounding can swallow a change completely. With a single step both
    results are the same. Raises StudyError if the simulation fails for every step.
    """
    values: list[np.ndarray] = []
    for step in steps:
        try:
            values.append(column(step))
        except StudyError:
            if step == steps[-1] and not values:
                raise
            continue  # the step is too large, for instance because a variance becomes negative
        if len(values) == LEVELS:
            break
    if len(values) == 1:
        return values[0], values[0]
    levels = np.array(values)
    size = np.maximum(abs(levels[:-1]), abs(levels[1:]))
    with np.errstate(invalid="ignore", divide="ignore"):
        change = np.where(size > 0.0, abs(np.diff(levels, axis=0)) / size, 0.0)
    moving = size > 0.0
    flat = np.any(moving & (change < GOOD), axis=0)
    change = np.where(~moving & flat, np.inf, change)
    every = np.arange(levels.shape[1])
    chosen = np.argmin(change, axis=0)
    return levels[chosen, every], levels[chosen + 1, every]
