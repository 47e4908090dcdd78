"""The co-simulation loop: one compiled function that initialises the FMUs and flies them.

Every exchanged variable has a slot in one float64 array; Integer, Boolean and Enumeration values
pass through an int32 array of the same layout. The slots of a component are contiguous by type
and direction (`RANGES`), so that each FMI call takes a piece of the arrays as it stands.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from .fmi_calls import change_mode, do_step, exchange, setup_experiment

# Columns of Program.address; the first six also number Program.ranges.
SET_REAL, GET_REAL, SET_INTEGER, GET_INTEGER, SET_BOOLEAN, GET_BOOLEAN = range(6)
DO_STEP, RESET, SETUP_EXPERIMENT, ENTER_INITIALISATION, EXIT_INITIALISATION = range(6, 11)
RANGES = 6
FUNCTION_NAMES = (
    "fmi2SetReal",
    "fmi2GetReal",
    "fmi2SetInteger",
    "fmi2GetInteger",
    "fmi2SetBoolean",
    "fmi2GetBoolean",
    "fmi2DoStep",
    "fmi2Reset",
    "fmi2SetupExperiment",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
)

# How a run ends: Outcome.code
STOP_TIME, FINISHED, NONFINITE, FAILED = range(4)
OVERRIDE, BIAS, FREEZE = range(3)
LINEAR, TABLE = range(2)
FMI_WARNING = 1


class Program(NamedTuple):
    """A system as arrays; n components, s slots, p parameter values, c connections."""

    instance: np.ndarray  # int64 [n], fmi2Component
    address: np.ndarray  # int64 [n, 11], functions in the order of FUNCTION_NAMES
    ranges: np.ndarray  # int64 [n, 6, 2], first slot and count per exchange function
    reference: np.ndarray  # uint32 [s], value references
    initial: np.ndarray  # float64 [s], values before anything is exchanged
    parameter_ranges: np.ndarray  # int64 [n, 3, 2], first and count per type, in the parameter arrays
    parameter_reference: np.ndarray  # uint32 [p]
    connection_ranges: np.ndarray  # int64 [n + 1, 2], those that feed a component; last: system connectors
    source: np.ndarray  # int64 [c], slots
    target: np.ndarray  # int64 [c], slots
    kind: np.ndarray  # int64 [c], LINEAR or TABLE
    factor: np.ndarray  # float64 [c]
    offset: np.ndarray  # float64 [c]
    table: np.ndarray  # int64 [c, 2], first and count in table_from, table_to
    table_from: np.ndarray  # float64
    table_to: np.ndarray  # float64
    initial_order: np.ndarray  # int64 [n], components in the order that settles initialisation
    sources_first: np.ndarray  # int64, class S: no output depends directly on an input
    followers: np.ndarray  # int64, class F in topological order
    finished_slot: int  # -1: no `finished` connector
    fault_slot: np.ndarray  # int64 [f]
    fault_kind: np.ndarray  # int64 [f], OVERRIDE, BIAS or FREEZE
    fault_window: np.ndarray  # float64 [f, 2], from and until (s)
    fault_value: np.ndarray  # float64 [f]


class Buffers(NamedTuple):
    """Memory of one run in flight."""

    values: np.ndarray  # float64 [s]
    whole: np.ndarray  # int32 [s]
    frozen: np.ndarray  # float64 [f], NaN until a freeze begins
    outcome: np.ndarray  # int64 [5]: code, component or slot, function, fmi2Status, row


@njit(cache=True)
def _fail(buffers, component, function, status):  # type: ignore[no-untyped-def]
    buffers.outcome[0] = FAILED
    buffers.outcome[1] = component
    buffers.outcome[2] = function
    buffers.outcome[3] = status
    return False


@njit(cache=True)
def _inject(program, buffers, first, count, time):  # type: ignore[no-untyped-def]
    for k in range(program.fault_slot.size):
        slot = program.fault_slot[k]
        active = program.fault_window[k, 0] <= time < program.fault_window[k, 1]
        if first <= slot < first + count and active:
            if program.fault_kind[k] == OVERRIDE:
                buffers.values[slot] = program.fault_value[k]
            elif program.fault_kind[k] == BIAS:
                buffers.values[slot] += program.fault_value[k]
            else:
                if np.isnan(buffers.frozen[k]):
                    buffers.frozen[k] = buffers.values[slot]
                buffers.values[slot] = buffers.frozen[k]


@njit(cache=True)
def _connect(program, buffers, component):  # type: ignore[no-untyped-def]
    values = buffers.values
    first = program.connection_ranges[component, 0]
    for k in range(first, first + program.connection_ranges[component, 1]):
        value = values[program.source[k]]
        if program.kind[k] == LINEAR:
            values[program.target[k]] = value * program.factor[k] + program.offset[k]
        else:
            entry = program.table[k, 0]
            for _ in range(program.table[k, 1]):
                if program.table_from[entry] == value:
                    values[program.target[k]] = program.table_to[entry]
                entry += 1


@njit(cache=True)
def _set(program, buffers, component, time):  # type: ignore[no-untyped-def]
    _connect(program, buffers, component)
    for function in (SET_REAL, SET_INTEGER, SET_BOOLEAN):
        first = program.ranges[component, function, 0]
        count = program.ranges[component, function, 1]
        if count > 0:
            _inject(program, buffers, first, count, time)
            address = program.address[component, function]
            instance = program.instance[component]
            if function == SET_REAL:
                status = exchange(address, instance, program.reference, buffers.values, first, count)
            else:
                for slot in range(first, first + count):
                    buffers.whole[slot] = np.int32(buffers.values[slot])
                status = exchange(address, instance, program.reference, buffers.whole, first, count)
            if status > FMI_WARNING:
                return _fail(buffers, component, function, status)
    return True


@njit(cache=True)
def _get(program, buffers, component, time):  # type: ignore[no-untyped-def]
    for function in (GET_REAL, GET_INTEGER, GET_BOOLEAN):
        first = program.ranges[component, function, 0]
        count = program.ranges[component, function, 1]
        if count > 0:
            address = program.address[component, function]
            instance = program.instance[component]
            if function == GET_REAL:
                status = exchange(address, instance, program.reference, buffers.values, first, count)
            else:
                status = exchange(address, instance, program.reference, buffers.whole, first, count)
                for slot in range(first, first + count):
                    buffers.values[slot] = buffers.whole[slot]
            if status > FMI_WARNING:
                return _fail(buffers, component, function, status)
            _inject(program, buffers, first, count, time)
            for slot in range(first, first + count):
                if not np.isfinite(buffers.values[slot]):
                    buffers.outcome[0] = NONFINITE
                    buffers.outcome[1] = slot
                    return False
    return True


@njit(cache=True)
def _step(program, buffers, component, time, step):  # type: ignore[no-untyped-def]
    status = do_step(program.address[component, DO_STEP], program.instance[component], time, step)
    if status > FMI_WARNING:
        return _fail(buffers, component, DO_STEP, status)
    return True


@njit(cache=True)
def _initialise(program, buffers, parameters, whole_parameters, reset, start, stop):  # type: ignore[no-untyped-def]
    for component in range(program.instance.size):
        instance = program.instance[component]
        if reset:
            status = change_mode(program.address[component, RESET], instance)
            if status > FMI_WARNING:
                return _fail(buffers, component, RESET, status)
        for kind in range(3):
            first = program.parameter_ranges[component, kind, 0]
            count = program.parameter_ranges[component, kind, 1]
            if count > 0:
                address = program.address[component, 2 * kind]
                if kind == 0:
                    status = exchange(address, instance, program.parameter_reference, parameters, first, count)
                else:
                    status = exchange(address, instance, program.parameter_reference, whole_parameters, first, count)
                if status > FMI_WARNING:
                    return _fail(buffers, component, 2 * kind, status)
        status = setup_experiment(program.address[component, SETUP_EXPERIMENT], instance, start, stop)
        if status > FMI_WARNING:
            return _fail(buffers, component, SETUP_EXPERIMENT, status)
        status = change_mode(program.address[component, ENTER_INITIALISATION], instance)
        if status > FMI_WARNING:
            return _fail(buffers, component, ENTER_INITIALISATION, status)
    for component in program.initial_order:
        if not _set(program, buffers, component, start) or not _get(program, buffers, component, start):
            return False
    for component in range(program.instance.size):
        status = change_mode(program.address[component, EXIT_INITIALISATION], program.instance[component])
        if status > FMI_WARNING:
            return _fail(buffers, component, EXIT_INITIALISATION, status)
    return True


@njit(cache=True)
def _advance_sequential(program, buffers, time, after, step):  # type: ignore[no-untyped-def]
    for component in program.sources_first:
        if not _set(program, buffers, component, time) or not _step(program, buffers, component, time, step):
            return False
    for component in program.sources_first:
        if not _get(program, buffers, component, after):
            return False
    for component in program.followers:
        if (
            not _set(program, buffers, component, after)
            or not _step(program, buffers, component, time, step)
            or not _get(program, buffers, component, after)
        ):
            return False
    return True


@njit(cache=True)
def _advance_jacobi(program, buffers, time, after, step):  # type: ignore[no-untyped-def]
    for component in range(program.instance.size):
        if not _set(program, buffers, component, time):
            return False
    for component in range(program.instance.size):
        if not _step(program, buffers, component, time, step):
            return False
    for component in range(program.instance.size):  # noqa: SIM110 - numba compiles loops, not generators
        if not _get(program, buffers, component, after):
            return False
    return True


def _fly(  # type: ignore[no-untyped-def]
    program, buffers, parameters, whole_parameters, reset, start, step, steps, jacobi, recorded, stride, record, times
):
    """Initialise and run; returns the number of rows recorded, buffers.outcome says how it ended.

    ``record`` takes the slots ``recorded`` of every stride-th communication point and always
    those of the last one.
    """
    buffers.values[:] = program.initial
    buffers.frozen[:] = np.nan
    buffers.outcome[:] = 0
    if not _initialise(program, buffers, parameters, whole_parameters, reset, start, start + steps * step):
        return 0
    rows = 0
    n = 0
    while True:
        time = start + n * step
        buffers.outcome[4] = n
        _connect(program, buffers, program.instance.size)
        finished = program.finished_slot >= 0 and buffers.values[program.finished_slot] != 0.0
        last = finished or n == steps
        if last or n % stride == 0:
            times[rows] = time
            for k in range(recorded.size):
                record[rows, k] = buffers.values[recorded[k]]
            rows += 1
        if last:
            buffers.outcome[0] = FINISHED if finished else STOP_TIME
            return rows
        after = start + (n + 1) * step
        if jacobi:
            good = _advance_jacobi(program, buffers, time, after, step)
        else:
            good = _advance_sequential(program, buffers, time, after, step)
        if not good:
            buffers.outcome[4] = n + 1
            return rows
        n += 1


# For Python FMUs, which need the interpreter lock at every call, and for native ones, which run without.
fly_locked = njit(cache=True)(_fly)
fly_unlocked = njit(cache=True, nogil=True)(_fly)
