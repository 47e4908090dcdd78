"""Groups of consecutive simulations: inputs and records of the loop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..loop import arrays
from ..system.passing.flight_table import FlightTable
from .orders.injections import NEVER
from .parameters import Key, Parameters
from .results import Flight

RECORD_BYTES = 2**23  # size of a group's record: dozens of long flights, or thousands of short flights


def group_of(table: FlightTable, keys: Mapping[str, Key], parameters: Parameters, margin: float) -> arrays.RunGroup:
    """Return a table as arrays for the loop; ``margin`` (s) is subtracted from fault windows to allow for rounding."""
    real = [name for name in table.values if parameters.types[keys[name]] == "Real"]
    whole = [name for name in table.values if name not in real]
    window = np.empty((table.flights, len(table.faults), 2))
    value = np.empty((table.flights, len(table.faults)))
    for number, fault in enumerate(table.faults):
        window[:, number, 0] = np.where(fault.flies, fault.start - margin, NEVER[0])
        window[:, number, 1] = np.where(fault.flies, fault.end - margin, NEVER[1])
        value[:, number] = fault.value
    return arrays.RunGroup(
        real=_columns(table, real, np.float64),
        real_position=_positions(real, keys, parameters),
        whole=_columns(table, whole, np.int32),
        whole_position=_positions(whole, keys, parameters),
        fault_window=window,
        fault_value=value,
        ends=np.zeros(table.flights, dtype=np.int64),
        endings=np.zeros(table.flights, dtype=np.int64),
    )


def _columns(table: FlightTable, names: Sequence[str], dtype: type) -> np.ndarray:
    columns: np.ndarray = np.empty((table.flights, len(names)), dtype=dtype)
    for column, name in enumerate(names):
        columns[:, column] = table.values[name]
    return columns


def flights_in_group(signals: int, rows: int) -> int:
    """Return the number of flights of ``rows`` rows that fit into the record of a group, at least one."""
    return max(1, RECORD_BYTES // (8 * rows * (signals + 1)))


def _positions(names: Sequence[str], keys: Mapping[str, Key], parameters: Parameters) -> np.ndarray:
    return np.array([parameters.positions[keys[name]] for name in names], dtype=np.int64)


@dataclass
class FlightGroup:
    """Records of consecutive flights, concatenated; the rows of flight k end before row ``ends[k]``."""

    time: np.ndarray
    signals: Mapping[str, np.ndarray]
    ends: np.ndarray
    statuses: list[str]
    complete: np.ndarray  # bool, True for flights that completed
    messages: list[str]

    @classmethod
    def of(cls, flight: Flight) -> Self:
        """Return a group that consists of a single flight."""
        ends, complete = np.array([flight.time.size]), np.array([flight.complete])
        return cls(flight.time, flight.signals, ends, [flight.status], complete, [flight.message])

    @property
    def starts(self) -> np.ndarray:
        """First row of each flight."""
        return np.concatenate([[0], self.ends[:-1]])

    def last(self, values: np.ndarray) -> np.ndarray:
        """Return each flight's last entry in a column of rows; NaN for a flight without rows."""
        if not values.size:
            return np.full(self.ends.size, np.nan)
        return np.where(self.ends > self.starts, values[self.ends - 1], np.nan)

    def rows(self, flight: int) -> slice:
        """Return the slice of the rows of a flight, by the flight's number in the group."""
        return slice(int(self.starts[flight]), int(self.ends[flight]))
