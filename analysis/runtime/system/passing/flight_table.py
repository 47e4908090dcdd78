"""Inputs of consecutive simulations, which set the same parameters and faults to different values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class FaultColumns:
    """Fault in n simulations: whether it acts (``flies``), its value and its window, each of shape [n].

    ``value`` is in the connector's unit, ``start`` and ``end`` are in s.
    """

    flies: np.ndarray
    value: np.ndarray
    start: np.ndarray
    end: np.ndarray


@dataclass(frozen=True)
class FlightTable:
    """Inputs of n simulations: values of varied parameters by name, [n] each, and all faults in order."""

    flights: int
    values: Mapping[str, np.ndarray]
    faults: Sequence[FaultColumns]
