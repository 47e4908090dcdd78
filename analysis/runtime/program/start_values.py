"""Start values of a component: which values are set, in which mode, and whether the FMU accepted them."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from ..fmi.variable import ScalarVariable
from ..system.fmu import STRUCTURAL, Fmu
from ..system.network import Network
from ..system.passing.settings import SystemSettings
from .component import FailedError, Sample, Samples
from .exchange import arrays_of

LOSS = 1e-6  # permitted relative error of a Real in an FMU, from single precision or conversion to another unit


@dataclass(frozen=True)
class Start:
    """Variable, or all elements of an array, with the values to set before initialisation mode.

    ``is_structural`` values are set in configuration mode. ``is_repeated`` values are set again in initialisation mode,
    since some FMUs lose values set before. ``is_read_back`` values are compared afterwards.
    """

    variables: Sequence[ScalarVariable]
    values: Samples
    is_structural: bool
    is_repeated: bool
    is_read_back: bool

    def check(self, component: str, actual: Sequence[Sample]) -> None:
        """Raise FailedError if a value in the FMU differs from the value that was set."""
        for (name, requested), stored in zip(self.values.items(), actual, strict=True):
            if not agrees(requested, stored):
                raise FailedError(
                    f"{component}.{name} was set to {requested!r}, but has the value {stored!r} in its FMU"
                )


def agrees(requested: Sample, stored: Sample) -> bool:
    """Return True for equal values, for Reals with a relative difference of at most `LOSS`, and for two NaNs."""
    if not isinstance(requested, float) or not isinstance(stored, float):
        return stored == requested
    both_nan = math.isnan(requested) and math.isnan(stored)
    return stored == requested or abs(stored - requested) <= LOSS * abs(requested) or both_nan


def start_of(settings: SystemSettings, component: str, variable: ScalarVariable) -> Sample:
    """Return the value set for a variable, else the start value in its FMU; integers and texts are exact."""
    start = settings.variables.get((component, variable.name), variable.start)
    if variable.type == "Binary":
        return bytes.fromhex(str(start or ""))
    if variable.type == "String":
        return str(start or "")
    number = {"true": 1, "false": 0}.get(str(start).lower(), start or 0)
    return float(number) if variable.type == "Real" else int(number)


def find_starts(network: Network, settings: SystemSettings, component: str, tuned: Collection[str]) -> list[Start]:
    """Return the values to set before a simulation; parameters named in ``tuned`` change during it.

    In initialisation mode FMI permits setting inputs and variables with initial="exact"; all other variables are
    computed by the FMU from then on, and a connected input is set by its connection.
    """
    fmu = network.fmus[component]
    starts = []
    for array in arrays_of(fmu.variables.values()):
        names = [f"{component}.{each.name}" for each in array]
        if not any((component, each.name) in settings.variables for each in array):
            continue
        first = array[0]
        is_structural = first.causality == STRUCTURAL
        is_settable = first.causality in ("input", "parameter") or first.initial == "exact"
        is_connected = first.causality == "input" and any(name in network.driver for name in names)
        is_repeated = is_settable and not is_connected and not is_structural
        is_read_back = is_structural or (is_repeated and not any(name in tuned for name in names))
        values = {each.name: start_of(settings, component, each) for each in array}
        starts.append(Start(array, values, is_structural, is_repeated, is_read_back))
    return starts


def solver_tolerance(fmu: Fmu) -> float | None:
    """Return the relative tolerance that an FMU proposes for its own solver, or None."""
    experiment = fmu.description.defaultExperiment
    return None if experiment is None or experiment.tolerance is None else float(experiment.tolerance)
