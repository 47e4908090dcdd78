"""Test of an FMU, simulated alone, for the cheapest way to restore it between simulations."""

from __future__ import annotations

import hashlib
import math
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy import fmi2
from fmpy.fmi1 import FMICallException

from ..fmi.variable import ScalarVariable
from ..system.fmu import Fmu
from .fmu_library import LOADING
from .instance import Instance, instantiate
from .renewal import RESETS, Renewal, ResetVerdict, store_verdict, verdict_in_cache
from .traces import read_traces
from .trial import KINDS, Number, begin, declared, read, step

STEPS = 10


_trying = threading.Lock()
_noted: set[str] = set()  # digests of FMUs with a reported note


def reset_verdict(fmu: Fmu) -> ResetVerdict:
    """Return the verdict on an FMU in this process; the first call tests it.

    In this verdict `Renewal.PROCESS` stands for every FMU that a new instance does not restore.
    """
    with _trying:
        verdict = verdict_in_cache(fmu)
        if verdict is None:
            verdict = try_renewals(fmu)
            store_verdict(fmu.digest, verdict)
        if verdict.needs_process and fmu.digest not in _noted:
            _noted.add(fmu.digest)
            problem = f"a simulation in this process depends on earlier ones: {verdict.reason}"
            warnings.warn(f"{fmu.label}: {problem}; leave out `in_process`", stacklevel=2)
        return verdict


def try_renewals(
    fmu: Fmu, simulated: Callable[[str], None] = lambda digest: None, *, with_reset: bool = True
) -> ResetVerdict:
    """Test a reset (unless ``with_reset`` is false because it is known to fail), then a new instance.

    A first instance is simulated with the declared values. A second instance is simulated with other parameters and
    inputs, reset, and simulated with the declared values. If the reset fails, a third instance is simulated with the
    declared values. Outputs and parameters must be equal to the first instance's bit for bit, and process and folder
    must be unchanged. ``simulated`` is called with the SHA-256 of the first instance's outputs and parameters.
    """
    with LOADING, chdir(Path.cwd()):  # restores the folder if the FMU changes it
        before = read_traces(fmu.folder)
        first = _simulate_anew(fmu, simulated)
        reason, is_usable = first.failure, first.is_usable
        if with_reset and first.is_complete:
            reason, is_usable = _try_reset(fmu, first.rows)
        verdict = RESETS
        if reason or not with_reset:
            is_as_good = is_usable and _simulate_anew(fmu).rows == first.rows
            verdict = ResetVerdict(Renewal.INSTANCE if is_as_good else Renewal.PROCESS, reason)
        changes = read_traces(fmu.folder).changes_since(before)
        if changes:
            verdict = ResetVerdict(Renewal.PROCESS, changes)
    return verdict


@dataclass(frozen=True)
class _Simulation:
    """Output rows of a new instance with declared values, followed by its parameters; or the failure that ended it."""

    rows: list[bytes]
    failure: str = ""
    is_usable: bool = True  # False after a fatal error, which permits no further instance (FMI 2.0, fmi2Fatal)

    @property
    def is_complete(self) -> bool:
        return not self.failure


def _simulate_anew(fmu: Fmu, simulated: Callable[[str], None] = lambda digest: None) -> _Simulation:
    """Simulate a new instance; ``simulated`` is called with the SHA-256 of its rows before the instance is freed."""
    instance = instantiate(fmu, fmu.name)
    rows: list[bytes] = []
    try:
        for row in _simulate(instance, {}):
            rows.append(row)
        failed = None
    except FMICallException as error:
        failed = error
        rows.append(_words(error).encode())
    simulated(hashlib.sha256(repr(rows).encode()).hexdigest())
    _free(instance, failed)
    if failed is None:
        return _Simulation(rows)
    failure = f"its reset cannot be tested with its declared start values: {_words(failed)}"
    return _Simulation(rows, failure, is_usable=not _is_fatal(failed))


def _try_reset(fmu: Fmu, expected: list[bytes]) -> tuple[str, bool]:
    """Return why a reset does not restore an instance ("" if it does), and whether the FMU may still be used."""
    for changes in _make_value_sets(fmu):
        used = instantiate(fmu, fmu.name)
        try:
            list(_simulate(used, changes))
        except FMICallException as error:  # the FMU fails with these values
            _free(used, error)
            continue
        try:
            used.slave.terminate()
            used.slave.reset()
            state = list(_simulate(used, {}))
        except FMICallException as error:
            _free(used, error)
            return f"after a simulation {_words(error)}", not _is_fatal(error)
        _free(used)
        if state[:-1] != expected[:-1]:
            return "after a reset its results differ from those of a fresh instance", True
        if state != expected:
            return "after a reset its parameters differ from those of a fresh instance", True
        return "", True
    return "its reset cannot be tested: it can be simulated only once", True


def _words(error: FMICallException) -> str:
    return f"{error.function} returned status {error.status}"


def _is_fatal(error: FMICallException) -> bool:
    """Return True if no further instance of the FMU may be used (FMI 2.0, fmi2Fatal)."""
    return not 0 <= error.status < fmi2.fmi2Fatal


def _free(instance: Instance, error: FMICallException | None = None) -> None:
    """Free an instance, unless it failed with a fatal error."""
    if error is None or not _is_fatal(error):
        instance.free()
    else:
        instance.abandon()


def _make_value_sets(fmu: Fmu) -> list[dict[str, Number]]:
    """Return sets of changed values: first for all Real parameters and inputs, then for inputs only, then for none.

    Integers are changed only if there is no Real parameter: they may be sizes, and other values harmful.
    """
    settable = [
        variable
        for variable in fmu.variables.values()
        if variable.causality in ("parameter", "input") and variable.variability != "constant"
    ]
    has_reals = any(variable.type == "Real" and variable.causality == "parameter" for variable in settable)
    changed = {}
    for variable in settable:
        if variable.type == "Real" or (variable.type in KINDS and not has_reals):
            value = _choose_other_value(variable)
            if value is not None:
                changed[variable.name] = value
    inputs = {name: value for name, value in changed.items() if fmu.variables[name].causality == "input"}
    return [changed, inputs, {}]


def _choose_other_value(variable: ScalarVariable) -> Number | None:
    """Return a value near the start value within the declared bounds, or None."""
    start = declared(variable)
    if start is None:
        return None
    if variable.type == "Boolean":
        return not start
    if variable.type == "Enumeration":
        return next((item for item in variable.items.values() if item != start), None)
    low = -np.inf if variable.minimum is None else float(variable.minimum)
    high = np.inf if variable.maximum is None else float(variable.maximum)
    low, high = max(low, variable.representation.limits[0]), min(high, variable.representation.limits[1])
    span = 1.0 if variable.type == "Integer" else 0.1 * abs(start) or 0.1
    return next((KINDS[variable.type](value) for value in (start + span, start - span) if low <= value <= high), None)


def _simulate(instance: Instance, changes: dict[str, Number]) -> Iterator[bytes]:
    """Yield the outputs after initialisation and after every step, then the parameters, as bytes.

    A discarded step ends the simulation. Raises FMICallException if a call fails.
    """
    experiment = instance.fmu.description.defaultExperiment
    start, size, tolerance = (
        None if value is None else float(value)
        for value in (
            getattr(experiment, "startTime", None),
            getattr(experiment, "stepSize", None),
            getattr(experiment, "tolerance", None),
        )
    )
    start, size = start or 0.0, size if size is not None and 0.0 < size < math.inf else 0.01
    begin(instance, changes, start, tolerance)
    yield read(instance, "output")
    for n in range(STEPS):
        if not step(instance, start + n * size, size):
            yield b"ended"
            break
        yield read(instance, "output")
    yield read(instance, "parameter")
