"""Component of FMI 2.0, called through FMPy one variable at a time."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2Discard, fmi2LastSuccessfulTime, fmi2Terminated

from ..fmi.variable import ScalarVariable
from ..system.fmu import Fmu
from .component import ComponentInstance, FailedError, Sample, Samples, TerminationError
from .numbers import as_stored
from .start_values import Start, solver_tolerance
from .times import is_within

CALLS = {"Real": "Real", "Integer": "Integer", "Enumeration": "Integer", "Boolean": "Boolean", "String": "String"}


class Fmi2Component(ComponentInstance):
    """Component of FMI 2.0; ``slave`` is its instance, ``starts`` are the values set before the simulation."""

    def __init__(self, name: str, fmu: Fmu, slave: FMU2Slave, starts: Sequence[Start]) -> None:
        self.name, self.fmu, self.slave, self.starts = name, fmu, slave, starts

    def initialise(self, start: float, stop: float) -> None:
        """See `ComponentInstance.initialise`."""
        for each in self.starts:
            self.set(each.values)
        self.slave.setupExperiment(solver_tolerance(self.fmu), start, stop)
        self.slave.enterInitializationMode()
        for each in self.starts:
            if each.is_repeated:
                self.set(each.values)

    def set(self, values: Mapping[str, Sample]) -> None:
        """See `ComponentInstance.set`."""
        for name, sample in values.items():
            self._set(self.fmu.variables[name], sample)

    def get(self, names: Iterable[str]) -> Samples:
        """See `ComponentInstance.get`."""
        return {name: self._get(self.fmu.variables[name]) for name in names}

    def settle(self) -> None:
        """See `ComponentInstance.settle`."""
        self.slave.exitInitializationMode()
        for each in self.starts:
            if each.is_read_back:
                each.check(self.name, [self._get(each.variables[0])])

    def step(self, begin: float, size: float, end: float) -> None:
        """See `ComponentInstance.step`. A foreign FMU may ask to end the simulation by discarding a step."""
        try:
            self.slave.doStep(begin, size)
        except FMICallException as error:
            if error.status != fmi2Discard or self.fmu.is_own or not self.slave.getBooleanStatus(fmi2Terminated):
                raise
            time = self.slave.getRealStatus(fmi2LastSuccessfulTime)
            if not is_within(time, begin, end):
                raise FailedError(f"{self.name} asked for termination at {time} s, outside of its step") from error
            raise TerminationError(self.name, time) from error

    def _set(self, variable: ScalarVariable, sample: Sample) -> None:
        getattr(self.slave, f"set{CALLS[variable.type]}")([variable.reference], [as_stored(variable, sample)])

    def _get(self, variable: ScalarVariable) -> Sample:
        (sample,) = getattr(self.slave, f"get{CALLS[variable.type]}")([variable.reference])
        return sample.decode() if isinstance(sample, bytes) else sample
