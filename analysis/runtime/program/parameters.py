"""The values that a component starts with: which, when they are set, and whether its FMU has taken them."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from ..fmi.variable import Variable
from ..system.fmu import STRUCTURAL, Fmu
from ..system.network import Network
from ..system.passing.settings import Settings
from .component import FailedError, Sample, Samples
from .exchange import arrays_of

LOSS = 1e-6  # of a Real: permitted loss in an FMU, by single precision or another unit


@dataclass(frozen=True)
class Start:
    """A variable, with all elements of an array, and the values that it is set to before initialisation mode.

    ``is_structural``: in configuration mode; ``is_repeated``: in initialisation mode again, since there are FMUs that
    lose values set before; ``is_read_back``: compared after it.
    """

    variables: Sequence[Variable]
    values: Samples
    is_structural: bool
    is_repeated: bool
    is_read_back: bool

    def check(self, component: str, actual: Sequence[Sample]) -> None:
        """Raise FailedError if an FMU has other values than it was set to."""
        for (name, requested), stored in zip(self.values.items(), actual, strict=True):
            if not agrees(requested, stored):
                raise FailedError(f"{component}.{name} was set to {requested!r}, and its FMU has {stored!r}")


def agrees(requested: Sample, stored: Sample) -> bool:
    """Return True for equal values, and for Reals that differ by `LOSS` at most or are NaN both."""
    if not isinstance(requested, float) or not isinstance(stored, float):
        return stored == requested
    both_nan = math.isnan(requested) and math.isnan(stored)
    return stored == requested or abs(stored - requested) <= LOSS * abs(requested) or both_nan


def start_of(settings: Settings, component: str, variable: Variable) -> Sample:
    """Return what a variable is set to, else its FMU's start; whole numbers and texts as they are."""
    start = settings.variables.get((component, variable.name), variable.start)
    if variable.type == "Binary":
        return bytes.fromhex(str(start or ""))
    if variable.type == "String":
        return str(start or "")
    number = {"true": 1, "false": 0}.get(str(start).lower(), start or 0)
    return float(number) if variable.type == "Real" else int(number)


def find_starts(network: Network, settings: Settings, component: str, tuned: Collection[str]) -> list[Start]:
    """Return the values that a component is set to before a flight; ``tuned`` names parameters that change in it.

    FMI permits setting inputs and variables with initial="exact" in initialisation mode; the FMU computes others from
    then on, and a connected input is set again.
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
    """Return the relative tolerance that an FMU proposes for its own solver."""
    experiment = fmu.description.defaultExperiment
    return None if experiment is None or experiment.tolerance is None else float(experiment.tolerance)
