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
from fmpy.model_description import ScalarVariable

from ..system.fmu import Fmu
from .instance import Instance, instantiate
from .library import LOADING

STEPS = 10
Number = float | int | bool
CALLS = {
    "Real": ("setReal", "getReal", float),
    "Integer": ("setInteger", "getInteger", int),
    "Enumeration": ("setInteger", "getInteger", int),
    "Boolean": ("setBoolean", "getBoolean", bool),
}


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
        expected = [*_simulate(fresh, {}), _read(fresh.slave, fmu, "parameter")]
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
            state = [*_simulate(used, {}), _read(used.slave, fmu, "parameter")]
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
        if variable.type == "Real" or (variable.type in CALLS and not has_reals):
            value = _other(variable)
            if value is not None:
                changed[variable.name] = value
    inputs = {name: value for name, value in changed.items() if fmu.variables[name].causality == "input"}
    return [changed, inputs, {}]


def _other(variable: ScalarVariable) -> Number | None:
    """A value near the start, within the declared bounds; None where there is no other."""
    if variable.start is None:
        return None
    if variable.type == "Boolean":
        return str(variable.start).lower() not in ("true", "1")
    if variable.type == "Enumeration":
        items = variable.declaredType.items if variable.declaredType is not None else None
        return next((int(item.value) for item in items or () if int(item.value) != int(variable.start)), None)
    start = float(variable.start)
    low, high = (float(bound) if bound is not None else np.inf for bound in (variable.min, variable.max))
    low = low if variable.min is not None else -np.inf
    span = 1.0 if variable.type == "Integer" else 0.1 * abs(start) or 0.1
    return next(
        (CALLS[variable.type][2](value) for value in (start + span, start - span) if low <= value <= high), None
    )


def _simulate(instance: Instance, changes: dict[str, Number]) -> list[bytes]:
    """The outputs after initialisation and after every step, as bytes.

    Raises FMICallException where a call fails. A discarded step ends the flight, which is a row, too.
    """
    fmu, slave = instance.fmu, instance.slave
    experiment = fmu.description.defaultExperiment
    start, step, tolerance = (
        None if value is None else float(value)
        for value in (
            getattr(experiment, "startTime", None),
            getattr(experiment, "stepSize", None),
            getattr(experiment, "tolerance", None),
        )
    )
    start, step = start or 0.0, step or 0.01
    _set(slave, fmu, changes)
    slave.setupExperiment(tolerance=tolerance, startTime=start)
    slave.enterInitializationMode()
    _set(slave, fmu, changes)
    slave.exitInitializationMode()
    rows = [_read(slave, fmu, "output")]
    for n in range(STEPS):
        try:
            slave.doStep(start + n * step, step)
        except FMICallException as error:
            if error.status != fmi2.fmi2Discard:
                raise
            rows.append(b"discarded")
            break
        rows.append(_read(slave, fmu, "output"))
    return rows


def _set(slave: fmi2.FMU2Slave, fmu: Fmu, changes: dict[str, Number]) -> None:
    for name, value in changes.items():
        variable = fmu.variables[name]
        getattr(slave, CALLS[variable.type][0])([variable.valueReference], [value])


def _read(slave: fmi2.FMU2Slave, fmu: Fmu, causality: str) -> bytes:
    """The values of variables, type by type; of those that cannot be read, that they cannot."""
    references: dict[str, list[int]] = {}
    for variable in fmu.variables.values():
        if variable.causality == causality and variable.type in CALLS:
            references.setdefault(CALLS[variable.type][1], []).append(variable.valueReference)
    return b"".join(_get(getattr(slave, getter), each) for getter, each in references.items())


def _get(getter: Callable[[list[int]], list[Number]], references: list[int]) -> bytes:
    """Values of variables in one call, or each by itself where one of them cannot be read."""
    try:
        return np.array(getter(references), dtype=np.float64).tobytes()
    except FMICallException:
        if len(references) == 1:
            return b"?"
    return b"".join(_get(getter, [reference]) for reference in references)
