"""Component of FMI 3.0, called through FMPy one variable or array at a time."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from fmpy.fmi3 import FMU3Slave

from ..fmi.representations import TEXTS
from ..fmi.variable import ScalarVariable
from ..system.fmu import Fmu
from .component import ComponentInstance, Sample, Samples
from .exchange import arrays_of
from .numbers import as_stored
from .start_values import Start, solver_tolerance
from .stepping import enter_step_mode, step_to


class Fmi3Component(ComponentInstance):
    """Component of FMI 3.0; ``slave`` is its instance, ``starts`` are the values set before the simulation.

    With ``uses_events`` the instance has event mode.
    """

    def __init__(self, name: str, fmu: Fmu, slave: FMU3Slave, starts: Sequence[Start], *, uses_events: bool) -> None:
        self.name, self.fmu, self.slave, self.starts, self.uses_events = name, fmu, slave, starts, uses_events
        self.steps, self.time = False, 0.0  # True after initialisation mode; time reached (s)
        self.discrete: Samples = {}  # discrete values in the FMU

    def initialise(self, start: float, stop: float) -> None:
        """See `ComponentInstance.initialise`."""
        self.time = start
        if any(each.is_structural for each in self.starts):
            self.slave.enterConfigurationMode()
            self._set_starts(each for each in self.starts if each.is_structural)
            self.slave.exitConfigurationMode()
        self._set_starts(each for each in self.starts if not each.is_structural)
        self.slave.enterInitializationMode(solver_tolerance(self.fmu), start, stop)
        self._set_starts(each for each in self.starts if each.is_repeated)

    def set(self, values: Mapping[str, Sample]) -> None:
        """See `ComponentInstance.set`.

        Between steps, discrete variables are set in event mode; if one of them changes, all are set.
        """
        arrays = arrays_of(self.fmu.variables[name] for name in values)
        events = [each for each in arrays if self.uses_events and each[0].variability != "continuous"]
        self._set(arrays if not self.steps else [each for each in arrays if each not in events], values)
        before, self.discrete = self.discrete, {e.name: as_stored(e, values[e.name]) for each in events for e in each}
        has_texts = any(array[0].type in TEXTS for array in events)  # texts count as changed
        if self.steps and (has_texts or self.discrete != before):
            self.slave.enterEventMode()
            self._set(events, values)
            enter_step_mode(self.name, self.slave, self.time)

    def get(self, names: Iterable[str]) -> Samples:
        """See `ComponentInstance.get`."""
        arrays = arrays_of(self.fmu.variables[name] for name in names)
        return {each.name: got for array in arrays for each, got in zip(array, self._get(array), strict=True)}

    def settle(self) -> None:
        """See `ComponentInstance.settle`."""
        self.slave.exitInitializationMode()
        if self.uses_events:
            enter_step_mode(self.name, self.slave, self.time)
        self.steps = True
        for each in self.starts:
            if each.is_read_back:
                each.check(self.name, self._get(each.variables))

    def step(self, begin: float, size: float, end: float) -> None:
        """See `ComponentInstance.step`."""
        step_to(self.name, self.slave, begin, size, end, uses_events=self.uses_events)
        self.time = end

    def _set_starts(self, starts: Iterable[Start]) -> None:
        for each in starts:
            self._set([each.variables], each.values)

    def _set(self, arrays: Iterable[Sequence[ScalarVariable]], values: Mapping[str, Sample]) -> None:
        for array in arrays:
            stored = [as_stored(each, values[each.name]) for each in array]
            getattr(self.slave, f"set{array[0].representation.name}")([array[0].reference], stored)

    def _get(self, array: Sequence[ScalarVariable]) -> list[Sample]:
        return list(getattr(self.slave, f"get{array[0].representation.name}")([array[0].reference], len(array)))
