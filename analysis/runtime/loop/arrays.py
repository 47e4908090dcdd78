"""Arguments of the loop: program, parameters, memory, simulated range, and recording.

Structures of `c/run.h`, which documents each member, are filled from attributes of the same names.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Program(NamedTuple):
    """System as arrays: i instructions, s slots, p parameter values, c connections, f faults."""

    instructions: np.ndarray  # uint64 [i, codes.COLUMNS]
    reset_end: int  # instructions before this one end a flight and reset the FMUs; a fresh instance skips them
    phases: np.ndarray  # int64 [m + 1]: instructions before the first initialise; step n executes section n modulo m
    reference: np.ndarray  # uint32 [s], value references
    initial: np.ndarray  # float64 [s], before anything is exchanged: starts of inputs, NaN for what is yet to come
    parameter_reference: np.ndarray  # uint32 [p]
    tolerance: np.ndarray  # float64, of each component's own solver, NaN where its FMU states none
    source: np.ndarray  # int64 [c], slots
    target: np.ndarray  # int64 [c], slots
    factor: np.ndarray  # float64 [c]
    offset: np.ndarray  # float64 [c]
    table: np.ndarray  # int64 [c, 2], first and count in table_from, table_to
    table_from: np.ndarray  # float64
    table_to: np.ndarray  # float64
    finished_slot: int  # -1: no `finished` connector
    fault_slot: np.ndarray  # int64 [f]
    fault_kind: np.ndarray  # int64 [f], OVERRIDE, BIAS, FREEZE or EXCITE
    fault_window: np.ndarray  # float64 [f, 2], from and until (s)
    fault_value: np.ndarray  # float64 [f]; of EXCITE the column of the excitation
    drive_slot: np.ndarray  # int64 [d], inputs driven over time
    drive_table: np.ndarray  # float64 [n, d]: values for the initialisation, then for every communication point


class Settings(NamedTuple):
    """Parameter values of one run."""

    real: np.ndarray  # float64 [p]
    whole: np.ndarray  # int32 [p]
    text: np.ndarray  # uint64 [p], addresses of C strings


class Span(NamedTuple):
    """Simulated range of a run. Times in s."""

    reset: bool  # whether the FMUs have flown before
    start: float
    step: float
    stop: float  # the stop time passed to FMUs; inf: none
    first: int  # communication point to go on from, with buffers and FMUs as they are; -1 initialises
    last: int  # communication point to fly to


class Recording(NamedTuple):
    """Recorded rows: ``slots`` at every ``stride``-th communication point and at the last one."""

    slots: np.ndarray  # int64 [k]
    stride: int
    record: np.ndarray  # float64 [k, r], what is kept of a slot side by side, since it is looked at slot by slot
    times: np.ndarray  # float64 [r], s
    offset: int  # the first row that is written


class RunGroup(NamedTuple):
    """Inputs and outcomes of n consecutive runs."""

    real: np.ndarray  # float64 [n, v], values of parameters
    real_position: np.ndarray  # int64 [v], their places in `Settings`
    whole: np.ndarray  # int32 [n, w]
    whole_position: np.ndarray  # int64 [w]
    fault_window: np.ndarray  # float64 [n, f, 2], of the first f faults, from and until (s)
    fault_value: np.ndarray  # float64 [n, f]
    ends: np.ndarray  # int64 [n], the rows in the record behind each flight
    endings: np.ndarray  # int64 [n], first word of the outcome of each flight


class Texts(NamedTuple):
    """Exchanged Strings: t texts with their sizes in bytes."""

    reference: np.ndarray  # uint32 [t], value references
    initial: np.ndarray  # uint8 [t, bytes], before anything is exchanged
    rows: np.ndarray  # uint8 [t, bytes], zero-terminated
    address: np.ndarray  # uint64 [t], of the rows
    given: np.ndarray  # uint64 [t], addresses that FMUs gave


class Transfers(NamedTuple):
    """Transfers of slots, parameters or texts to and from FMUs of FMI 3.0; each is one call."""

    rows: np.ndarray  # int64 [q, codes.TRANSFER_COLUMNS]
    reference: np.ndarray  # uint32, value references, one of a whole array
    functions: np.ndarray  # uint64 [components, library.FUNCTION_NAMES], addresses


class StoredValues(NamedTuple):
    """Values of FMUs of FMI 3.0, stored in their FMI types."""

    sent: np.ndarray  # uint64 [s], each transfer's values contiguous from its first slot on, as last set or read
    exact: np.ndarray  # uint64 [s], whole numbers of 64 bits, of which the float64 of a slot may be rounded
    flags: np.ndarray  # uint8 [8], what calls return
    time: np.ndarray  # float64 [2], likewise (s): the last is when an FMU has ended the simulation, or began a step


class Fmi3(NamedTuple):
    """Additional arrays of systems with FMUs of FMI 3.0."""

    transfers: Transfers
    start: np.ndarray  # uint64 [s], whole numbers of 64 bits before anything is exchanged
    stored: StoredValues
    given: np.ndarray  # uint64 [p], parameters: each transfer's values side by side from its first word on
    confirmed: np.ndarray  # uint64 [p], likewise, once they are read back
    binaries: Texts
    sizes: np.ndarray  # uint64 [t], bytes of each Binary
    initial_sizes: np.ndarray  # uint64 [t]


class Buffers(NamedTuple):
    """Working memory of one run."""

    values: np.ndarray  # float64 [s]
    whole: np.ndarray  # int32 [s]
    frozen: np.ndarray  # float64 [f], NaN until a freeze begins
    read_back: Settings  # what the FMUs have of the parameters, once initialised
    outcome: np.ndarray  # int64 [6]
    texts: Texts
    halt: np.ndarray  # int64 [1]; another thread makes it other than 0 to end the flight at its next point


def stored(slots: int) -> StoredValues:
    """Return zeroed `StoredValues` for a number of slots."""
    whole = np.zeros((2, slots), dtype=np.uint64)
    return StoredValues(whole[0], whole[1], np.zeros(8, dtype=np.uint8), np.zeros(2))


class Run(NamedTuple):
    """All arguments of one run of the loop."""

    program: Program
    buffers: Buffers
    settings: Settings
    span: Span
    recording: Recording
    excitation: np.ndarray  # float64 [r, e], added to the excited slots at the communication points after span.first
    fmi3: Fmi3 | None
    fused_steps: int  # address of the steps compiled for the system; 0: instructions are interpreted

    @property
    def has_fmi3(self) -> bool:
        """True if the system has FMUs of FMI 3.0."""
        return self.fmi3 is not None
