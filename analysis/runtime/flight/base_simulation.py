"""Interface of all simulations, in this process or in a child: a system that can be simulated repeatedly."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping, Sequence
from typing import Any, Self, TypedDict, Unpack

import numpy as np

from ...options.fault import Fault
from ..instances.instance import Log
from ..ssp.parameter_values import ParameterValue
from ..system.passing.flight_table import FlightTable
from ..system.prepared import PreparedSystem
from .base_memory import BaseMemory
from .group import FlightGroup
from .program import Layout
from .recorder import FlightRecorder
from .results import Flight, FlightResult, Provenance, provenance_of
from .selection import Selection

NOTHING = np.zeros((0, 0))  # no excitation


class Choices(TypedDict, total=False):
    """Options of a simulation.

    ``varied`` names the parameters (``component.variable``) that may change between simulations. ``requested`` names
    the signals to record (None: all outputs, connected inputs and system connectors), and ``additional`` names further
    signals. ``faults`` act unless `set_faults` replaces them. ``excited`` names the connectors to which `advance` may
    add signals. With ``open_end``, `advance` may pass the stop time, and FMUs receive no stop time. ``log`` receives
    the FMUs' messages.
    """

    varied: Collection[str]
    requested: Collection[str] | None
    additional: Sequence[str]
    faults: Sequence[Fault]
    excited: Sequence[str]
    open_end: bool
    log: Log | None


class BaseSimulation(ABC):
    """System that can be simulated repeatedly. A context manager, which frees the instances on exit.

    Only `interrupt` and `abort` may be called from another thread. Raises InputError for names that do not exist in the
    system.
    """

    recorder: FlightRecorder
    layout: Layout
    signal_names: list[str]
    flights = 0  # runs in the current child process, for simulations in child processes

    def __init__(self, prepared: PreparedSystem, **choices: Unpack[Choices]) -> None:
        self.prepared = prepared
        requested, faults = choices.get("requested"), tuple(choices.get("faults", ()))
        self._selection = Selection(
            tuple(choices.get("varied", ())),
            None if requested is None else tuple(requested),
            tuple(choices.get("additional", ())),
            faults,
            tuple(choices.get("excited", ())),
            choices.get("open_end", False),
        )
        self._selection.check_faults(prepared.network)
        self._varied = self._selection.keys(prepared.network)
        self.settings = self._selection.settings(prepared, self._varied)
        self._faults: Sequence[Fault | None] = faults
        self._log = choices.get("log")

    def fly(self, values: Mapping[str, ParameterValue] | None = None, *, every: int = 1) -> FlightResult:
        """Simulate from the start with these ``values`` of varied parameters, and record every ``every``-th row.

        The arrays of the result belong to the simulation, which overwrites them in its next run.
        """
        flight = self.run(values or {}, every=every)
        return FlightResult(
            **vars(flight),
            units={name: self.layout.units[name] for name in self.signal_names},
            provenance=self.provenance(),
        )

    def run(self, values: Mapping[str, ParameterValue], *, every: int = 1) -> Flight:
        """Simulate as `fly` does, but return the flight without units and provenance, as batches need it."""
        self.set(values)
        return self.advance(-1, self.prepared.steps, every=every)

    @property
    def group_size(self) -> int:
        """Maximum number of simulations in one call of `fly_group`, which is faster than `run`; 0 if unsupported."""
        return 0

    def fly_group(self, table: FlightTable) -> FlightGroup:
        """Simulate the first row of a table and as many of the following rows as fit, each from the start.

        Stops after a simulation that does not complete. Arrays are overwritten as in `fly`.
        """
        raise NotImplementedError(f"{type(self).__name__} runs one simulation at a time")

    def fuse(self) -> None:
        """Compile the steps into one function for later simulations, as with `FUSED`, if the system allows it."""
        return

    @abstractmethod
    def queue_run(self, values: Mapping[str, ParameterValue], faults: Sequence[Fault | None]) -> None:
        """Announce the values and faults of a coming `run`, so that it may start earlier; at most two runs are pending.

        The arrays of the last flight are unchanged by the first announcement; the second may overwrite them.
        """

    def set(self, values: Mapping[str, ParameterValue]) -> None:
        """Set varied parameters for all later starts."""
        for name, value in values.items():
            self.layout.parameters[self._varied[name]] = value

    @abstractmethod
    def set_faults(self, faults: Sequence[Fault | None]) -> None:
        """Set values and windows of faults for all later starts.

        ``faults`` has an entry for each fault with which the simulation was created: a fault of the same connector and
        kind, or None to disable it.
        """

    @abstractmethod
    def advance(self, first: int, last: int, excitation: np.ndarray = NOTHING, *, every: int = 1) -> Flight:
        """Simulate from communication point ``first`` on to ``last``; return rows ``first`` + 1 to ``last``.

        With ``first`` = -1 the simulation restarts, and row 0 is included. ``excitation`` [r, e] is added to the e
        excited connectors at the r communication points after ``first``. ``last`` may be beyond the stop time if the
        simulation has an open end. Every ``every``-th row is recorded. Arrays are overwritten as in `fly`.
        """

    def interrupt(self, halt: bool = True) -> None:
        """End the simulation running in another thread, and all later ones, at their next communication points.

        ``halt=False`` withdraws the request.
        """
        self.recorder.halt[0] = halt

    @abstractmethod
    def abort(self, why: str) -> bool:
        """End a simulation in another thread between communication points; return False if this is impossible."""

    @abstractmethod
    def memory(self) -> BaseMemory[Any]:
        """Return the memory of the FMUs. Raises InputError if an FMU does not describe its serialised state."""

    def provenance(self) -> Provenance:
        """Return the inputs that determine the result: parameter values, hashes, options and version."""
        return provenance_of(self.prepared, self.settings, self.layout.parameters, self._faults, self.signal_names)

    @abstractmethod
    def close(self) -> None:
        """Free the instances."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
