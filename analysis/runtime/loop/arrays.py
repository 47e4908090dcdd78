"""Arguments of the loop: program, parameters, memory, simulated range, and recording.

Structures of `c/run.h`, which documents each member, are filled from attributes of the same names.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Program(NamedTuple):
    """System as arrays, for i instructions, s slots, p parameter values, c connections and f faults."""

    instructions: np.ndarray  # uint64 [i, codes.COLUMNS]
    reset_end: int  # instructions before this index end a flight and reset the FMUs; fresh instances skip them
    phases: np.ndarray  # int64 [m + 1], ends of initialisation and m sections; step n executes section n modulo m
    reference: np.ndarray  # uint32 [s], value references
    initial: np.ndarray  # float64 [s], before the first exchange: start values of inputs, NaN for values not known yet
    parameter_reference: np.ndarray  # uint32 [p]
    tolerance: np.ndarray  # float64 [components], relative tolerance of the FMU's solver, NaN if the FMU states none
    source: np.ndarray  # int64 [c], slots
    target: np.ndarray  # int64 [c], slots
    factor: np.ndarray  # float64 [c]
    offset: np.ndarray  # float64 [c]
    table: np.ndarray  # int64 [c, 2], first entry and number of entries in table_from and table_to
    table_from: np.ndarray  # float64
    table_to: np.ndarray  # float64
    finished_slot: int  # slot of the connector `finished`; -1 if there is none
    fault_slot: np.ndarray  # int64 [f]
    fault_kind: np.ndarray  # int64 [f], OVERRIDE, BIAS, FREEZE or EXCITE
    fault_window: np.ndarray  # float64 [f, 2], start and end (s)
    fault_value: np.ndarray  # float64 [f]; for EXCITE the column of the excitation
    drive_slot: np.ndarray  # int64 [d], inputs driven over time
    drive_table: np.ndarray  # float64 [n, d]: values for the initialisation, then for every communication point


class Settings(NamedTuple):
    """Parameter values of one run."""

    real: np.ndarray  # float64 [p]
    whole: np.ndarray  # int32 [p]
    text: np.ndarray  # uint64 [p], addresses of C strings


class Span(NamedTuple):
    """Simulated range of a run. Times in s."""

    reset: bool  # True if the FMUs were simulated before
    start: float
    step: float
    stop: float  # stop time passed to FMUs; inf: no stop time
    first: int  # communication point at which to continue with current buffers and FMUs; -1 initialises them
    last: int  # last communication point to simulate


class Recording(NamedTuple):
    """Recorded rows: ``slots`` at every ``stride``-th communication point and at the last one."""

    slots: np.ndarray  # int64 [k]
    stride: int
    record: np.ndarray  # float64 [k, r], with the rows of a slot contiguous, since they are read slot by slot
    times: np.ndarray  # float64 [r], s
    offset: int  # the first row to write


class RunGroup(NamedTuple):
    """Inputs and outcomes of n consecutive runs."""

    real: np.ndarray  # float64 [n, v], values of parameters
    real_position: np.ndarray  # int64 [v], their indices in `Settings`
    whole: np.ndarray  # int32 [n, w]
    whole_position: np.ndarray  # int64 [w]
    fault_window: np.ndarray  # float64 [n, f, 2], start and end (s) of the first f faults
    fault_value: np.ndarray  # float64 [n, f]
    ends: np.ndarray  # int64 [n], the row of the record after each flight's last row
    endings: np.ndarray  # int64 [n], first word of the outcome of each flight


class Texts(NamedTuple):
    """Exchanged Strings: t texts with their sizes in bytes."""

    reference: np.ndarray  # uint32 [t], value references
    initial: np.ndarray  # uint8 [t, bytes], before the first exchange
    rows: np.ndarray  # uint8 [t, bytes], zero-terminated
    address: np.ndarray  # uint64 [t], addresses of the rows
    given: np.ndarray  # uint64 [t], addresses returned by FMUs


class Transfers(NamedTuple):
    """Transfers of slots, parameters or texts to and from FMUs of FMI 3.0, q in all; each transfer is one call."""

    rows: np.ndarray  # int64 [q, codes.TRANSFER_COLUMNS]
    reference: np.ndarray  # uint32, value references, a single one for a whole array
    functions: np.ndarray  # uint64 [components, library.FUNCTION_NAMES], addresses


class StoredValues(NamedTuple):
    """Values of FMUs of FMI 3.0, stored in their FMI types."""

    sent: np.ndarray  # uint64 [s], values last set or read, contiguous for each transfer from its first slot on
    exact: np.ndarray  # uint64 [s], 64-bit integers, which may be rounded in the float64 of their slot
    flags: np.ndarray  # uint8 [8], flags returned by calls
    time: np.ndarray  # float64 [2], returned by calls (s); the last is the end set by an FMU, or the start of a step


class Fmi3(NamedTuple):
    """Additional arrays of systems with FMUs of FMI 3.0."""

    transfers: Transfers
    start: np.ndarray  # uint64 [s], 64-bit integers before the first exchange
    stored: StoredValues
    given: np.ndarray  # uint64 [p], parameters to set, contiguous for each transfer from its first word on
    confirmed: np.ndarray  # uint64 [p], the same parameters as read back
    binaries: Texts
    sizes: np.ndarray  # uint64 [t], size of each Binary in bytes
    initial_sizes: np.ndarray  # uint64 [t]


class Buffers(NamedTuple):
    """Working memory of one run."""

    values: np.ndarray  # float64 [s]
    whole: np.ndarray  # int32 [s]
    frozen: np.ndarray  # float64 [f], NaN until a freeze begins
    read_back: Settings  # parameters read back from the initialised FMUs
    outcome: np.ndarray  # int64 [6]
    texts: Texts
    halt: np.ndarray  # int64 [1]; another thread sets it to nonzero to end the flight at its next communication point


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
    fused_steps: int  # address of the system's compiled steps; 0 if instructions are interpreted

    @property
    def has_fmi3(self) -> bool:
        """True if the system has FMUs of FMI 3.0."""
        return self.fmi3 is not None
