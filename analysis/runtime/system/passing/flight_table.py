"""Inputs of consecutive flights: each the same parameters and faults, with separate values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class FaultColumns:
    """A fault in n flights: whether it ``flies`` [n], ``value`` [n] in the connector's unit, ``start``, ``end`` (s)."""

    flies: np.ndarray
    value: np.ndarray
    start: np.ndarray
    end: np.ndarray


@dataclass(frozen=True)
class FlightTable:
    """Inputs of n flights: values of varied parameters by name [n], and all faults of the simulation in order."""

    flights: int
    values: Mapping[str, np.ndarray]
    faults: Sequence[FaultColumns]
