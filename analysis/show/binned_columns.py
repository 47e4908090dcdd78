"""Columns of a campaign, binned on first use: two bytes per row, the most recently used ones in memory."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from threading import Lock

import numpy as np

from .opened_campaign import OpenCampaign
from .scale import ColumnScale, make_scale

MEMORY = 300_000_000  # bytes of binned columns
READING = 100_000_000  # bytes of doubles that are read at a time


@dataclass(frozen=True)
class Binned:
    """A column as ``codes`` (rows,): bins of ``scale``, which is None if no number is finite."""

    scale: ColumnScale | None
    codes: np.ndarray


class BinnedColumns:
    """Cache of the binned columns of one campaign."""

    def __init__(self, campaign: OpenCampaign, memory: float = MEMORY) -> None:
        self.campaign = campaign
        self.limit = max(1, int(memory // (2 * campaign.rows)))  # columns in memory
        self._columns: OrderedDict[str, Binned] = OrderedDict()
        self._lock = Lock()

    @cached_property
    def success(self) -> np.ndarray:
        """The success of each row, boolean (rows,). Raises as `get` does."""
        return self.campaign.read(["success"])["success"] != 0.0

    def get(self, names: Sequence[str]) -> dict[str, Binned]:
        """Return columns by name; missing ones are read, several per pass through the shards.

        Raises InputError for damaged files, StoppedError after the server stopped.
        """
        with self._lock:
            needed = dict.fromkeys(names)
            columns = {name: self._columns[name] for name in needed if name in self._columns}
            missing = iter([name for name in needed if name not in columns])
            while group := list(islice(missing, max(1, READING // (8 * self.campaign.rows)))):
                for name, numbers in self._read(group).items():
                    scale = make_scale(numbers)
                    columns[name] = Binned(scale, (scale or ColumnScale(0.0, 1.0)).bin(numbers))
            for name in needed:
                self._columns[name] = columns[name]
                self._columns.move_to_end(name)
            while len(self._columns) > self.limit:
                self._columns.popitem(last=False)
            return columns

    def _read(self, names: list[str]) -> dict[str, np.ndarray]:
        """Read columns as doubles; the first call also reads the successes."""
        if "success" in self.__dict__:
            return self.campaign.read(names)
        columns = self.campaign.read([*names, "success"])
        self.__dict__["success"] = columns.pop("success") != 0.0
        return columns
