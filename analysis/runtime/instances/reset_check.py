"""Whether an FMU's fmi2Reset makes an instance as good as new: tried, once, on the FMU alone."""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy import fmi2
from fmpy.fmi1 import FMICallException

from ..fmi.variable import Variable
from ..system.fmu import Fmu
from .instance import Instance, instantiate
from .library import LOADING
from .trial import KINDS, Number, begin, declared, read, step

STEPS = 10


@dataclass(frozen=True)
class ResetVerdict:
    """Whether an FMU resets; ``reason`` says what showed that it does not."""

    resets: bool
    reason: str = ""


_verdicts: dict[str, ResetVerdict] = {}  # by the FMUs' digests
_trying = threading.Lock()


def verdict_in_cache(fmu: Fmu) -> ResetVerdict | None:
    """The verdict on an FMU, if there is one yet; our own reset, which their tests show."""
    return ResetVerdict(True) if fmu.is_self_contained else _verdicts.get(fmu.digest)


def store_verdict(digest: str, verdict: ResetVerdict) -> None:
    """Keep what a flight, or another process, has shown of the FMU with this SHA-256."""
    _verdicts[digest] = verdict


def reset_verdict(fmu: Fmu, flown: Callable[[], None] = lambda: None) -> ResetVerdict:
    """Whether an FMU resets, tried at the first call: it does not depend on who asks, nor on what has flown.

    One instance flies with other parameters and inputs than declared, is reset and flies with the declared ones;
    outputs and parameters must be those of a fresh instance, to the last bit. ``flown`` is called as soon as a first
    instance has flown with the declared values.
    """
    with _trying:
        verdict = verdict_in_cache(fmu)
        if verdict is None:
            with LOADING, chdir(Path.cwd()):  # back, should the FMU have gone elsewhere
                verdict = _verdicts[fmu.digest] = _try_reset(fmu, flown)
        return verdict


def _try_reset(fmu: Fmu, flown: Callable[[], None]) -> ResetVerdict:
    fresh = instantiate(fmu, fmu.name)
    try:
        expected = [*_simulate(fresh, {}), read(fresh, "parameter")]
    except FMICallException as error:
        _free(fresh, error)
        return ResetVerdict(False, f"it cannot be tried on its declared starts: {_words(error)}")
    flown()
    _free(fresh)
    for changes in _changes(fmu):
        used = instantiate(fmu, fmu.name)
        try:
            _simulate(used, changes)
        except FMICallException as error:  # does not fly with these
            _free(used, error)
            continue
        try:
            used.slave.terminate()
            used.slave.reset()
            state = [*_simulate(used, {}), read(used, "parameter")]
        except FMICallException as error:
            _free(used, error)
            return ResetVerdict(False, f"after a flight {_words(error)}")
        _free(used)
        if state[:-1] != expected[:-1]:
            return ResetVerdict(False, "after its reset it flies other than a fresh instance")
        if state != expected:
            return ResetVerdict(False, "after its reset parameters have other values than in a fresh instance")
        return ResetVerdict(True)
    return ResetVerdict(False, "it cannot be tried: it flies only once")


def _words(error: FMICallException) -> str:
    return f"{error.function} returned status {error.status}"


def _free(instance: Instance, error: FMICallException | None = None) -> None:
    """Free an instance, but not after a fatal error (FMI 2.0, fmi2Fatal)."""
    if error is None or 0 <= error.status < fmi2.fmi2Fatal:
        instance.free()
    else:
        instance.abandon()


def _changes(fmu: Fmu) -> list[dict[str, Number]]:
    """Other values than the declared ones: of all Real parameters and inputs, of the inputs, none.

    Whole numbers are changed where there is no Real parameter only: as sizes they could do harm.
    """
    given = [
        variable
        for variable in fmu.variables.values()
        if variable.causality in ("parameter", "input") and variable.variability != "constant"
    ]
    has_reals = any(variable.type == "Real" and variable.causality == "parameter" for variable in given)
    changed = {}
    for variable in given:
        if variable.type == "Real" or (variable.type in KINDS and not has_reals):
            value = _other(variable)
            if value is not None:
                changed[variable.name] = value
    inputs = {name: value for name, value in changed.items() if fmu.variables[name].causality == "input"}
    return [changed, inputs, {}]


def _other(variable: Variable) -> Number | None:
    """A value near the start, within the declared bounds; None where there is no other."""
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


def _simulate(instance: Instance, changes: dict[str, Number]) -> list[bytes]:
    """The outputs after initialisation and after every step, as bytes.

    Raises FMICallException where a call fails. A discarded step ends the flight, which is a row, too.
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
    start, size = start or 0.0, size or 0.01
    begin(instance, changes, start, tolerance)
    rows = [read(instance, "output")]
    for n in range(STEPS):
        if not step(instance, start + n * size, size):
            rows.append(b"ended")
            break
        rows.append(read(instance, "output"))
    return rows
