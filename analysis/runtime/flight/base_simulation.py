"""A system that flies again and again, wherever its FMUs are: what all simulations have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping, Sequence
from typing import Any, Self, TypedDict, Unpack

import numpy as np

from ...options.fault import Fault
from ..instances.instance import Log
from ..ssp.given_values import ParameterValue
from ..system.passing.flight_table import FlightTable
from ..system.prepared import PreparedSystem
from .base_memory import BaseMemory
from .group import FlightGroup
from .program import Layout
from .recorder import FlightRecorder
from .results import Flight, Provenance, Result, provenance_of
from .selection import Selection

NOTHING = np.zeros((0, 0))  # no excitation


class Choices(TypedDict, total=False):
    """``varied`` names the parameters (``component.variable``) that simulations may change; ``wanted`` the signals to
    record (None: all outputs, connected inputs and system connectors), ``more`` other variables to record; ``faults``
    those that act unless `set_faults` says otherwise; ``excited`` the connectors that `advance` may add signals to;
    ``open_end``: `advance` may pass the stop time, of which FMUs then receive none; ``log`` receives the FMUs'
    messages."""

    varied: Collection[str]
    wanted: Collection[str] | None
    more: Sequence[str]
    faults: Sequence[Fault]
    excited: Sequence[str]
    open_end: bool
    log: Log | None


class BaseSimulation(ABC):
    """Use it as a context manager: it frees the instances. Not shared between threads, but for `interrupt`, `give_up`.

    Raises InputError for names that the system does not have.
    """

    recorder: FlightRecorder
    layout: Layout
    signal_names: list[str]
    flights = 0  # since its process began, of one in a separate process

    def __init__(self, prepared: PreparedSystem, **choices: Unpack[Choices]) -> None:
        self.prepared = prepared
        wanted, faults = choices.get("wanted"), tuple(choices.get("faults", ()))
        self._selection = Selection(
            tuple(choices.get("varied", ())),
            None if wanted is None else tuple(wanted),
            tuple(choices.get("more", ())),
            faults,
            tuple(choices.get("excited", ())),
            choices.get("open_end", False),
        )
        self._selection.check_faults(prepared.network)
        self._varied = self._selection.keys(prepared.network)
        self.settings = self._selection.settings(prepared, self._varied)
        self._faults: Sequence[Fault | None] = faults
        self._log = choices.get("log")

    def fly(self, values: Mapping[str, ParameterValue] | None = None, *, every: int = 1) -> Result:
        """Simulate one flight from the start, with ``values`` for varied parameters; every n-th row is kept.

        The arrays of the result are the simulation's own and are overwritten by the next flight.
        """
        flight = self.run(values or {}, every=every)
        return Result(
            **vars(flight),
            units={name: self.layout.units[name] for name in self.signal_names},
            provenance=self.provenance(),
        )

    def run(self, values: Mapping[str, ParameterValue], *, every: int = 1) -> Flight:
        """Simulate and return the flight alone, for batches; see `fly`."""
        self.set(values)
        return self.advance(-1, self.prepared.steps, every=every)

    @property
    def group_size(self) -> int:
        """Maximum number of flights for `fly_group`, which takes less time for each than `run`; 0: none."""
        return 0

    def fly_group(self, table: FlightTable) -> FlightGroup:
        """Fly the first flights of a table, each from its start, at least one of them.

        A flight that does not reach its end is the last. Arrays as in `fly`.
        """
        raise NotImplementedError(f"{type(self).__name__} has flights one at a time")

    def fuse(self) -> None:
        """Fly from now on with steps compiled as one function, as `FUSED` does, where the system allows it."""
        return

    @abstractmethod
    def announce(self, values: Mapping[str, ParameterValue], faults: Sequence[Fault | None]) -> None:
        """Say what flies behind what was announced before, two flights at most: `run` takes as long as ever, or less.

        The arrays of the last flight are left alone by the first announcement, and not by the second.
        """

    def set(self, values: Mapping[str, ParameterValue]) -> None:
        """Give varied parameters other values, from the next start on."""
        for name, value in values.items():
            self.layout.parameters[self._varied[name]] = value

    @abstractmethod
    def set_faults(self, faults: Sequence[Fault | None]) -> None:
        """Set other values and windows of faults, from the next start on.

        There is one for each that the simulation was made with, on its connector and of its kind, or None where that
        one does not fly.
        """

    @abstractmethod
    def advance(self, first: int, last: int, excitation: np.ndarray = NOTHING, *, every: int = 1) -> Flight:
        """Simulate from communication point ``first`` to ``last``, as FMUs and buffers are; rows first + 1 to last.

        -1 restarts, which adds row 0. ``excitation`` [r, e] is added to the excited connectors at the r
        communication points after ``first``. ``last`` may be after the stop time where the simulation has an
        open end; every n-th row is kept. Arrays as in `fly`.
        """

    def interrupt(self, halt: bool = True) -> None:
        """End the flight that is under way in another thread at its next communication point, and all later ones."""
        self.recorder.halt[0] = halt

    @abstractmethod
    def give_up(self, why: str) -> bool:
        """End a flight in another thread that reaches no communication point; returns whether that can be done."""

    @abstractmethod
    def memory(self) -> BaseMemory[Any]:
        """Return the memory of the FMUs. Raises InputError where one does not describe its serialisation."""

    def provenance(self) -> Provenance:
        """Return parameter values, hashes, options and version: what the result depends on."""
        return provenance_of(self.prepared, self.settings, self.layout.parameters, self._faults, self.signal_names)

    @abstractmethod
    def close(self) -> None:
        """Free the instances."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
