"""Systems as one FMU, built for this machine and simulated by FMPy."""

import ctypes
import weakref
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave
from fmpy.logging import addLoggerProxy

from perilune.analysis.exports.system_fmu.build import build_system_fmu
from perilune.analysis.exports.system_fmu.one_fmu import OneFmu
from perilune.analysis.runtime.ssp.archive import open_system
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.fmus_src.export.compilers import local_platform


def build_one(
    path: Path,
    system: Path | str,
    slots: Mapping[str, Sequence[str]] | None = None,
    exposed: Sequence[str] = (),
    faulty: Sequence[str] = (),
    **options: Any,
) -> Path:
    """Build one FMU of a system at ``path``."""
    request = OneFmu(slots or {}, exposed, faulty, SystemOptions(flavour="native", **options))
    build_system_fmu(open_system(system), path, request, [local_platform()], portable=False)
    return path


class Slave:
    """An instance of an FMU: variables by name, steps from where the last one ended; ``messages`` are its errors."""

    def __init__(self, path: Path, folder: Path, start: float = 0.0, **values: float) -> None:
        self.description = fmpy.read_model_description(str(path))
        self.variables = {each.name: each for each in self.description.modelVariables}
        self.messages: list[str] = []
        unzipped = fmpy.extract(str(path), str(folder))
        self.fmu = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=unzipped,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="one",
        )
        callbacks = fmpy.fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(self._log)
        callbacks.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
        callbacks.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.free)
        addLoggerProxy(ctypes.byref(callbacks))
        self.callbacks = callbacks
        self.time = start
        self.fmu.instantiate(callbacks=callbacks)
        weakref.finalize(self, self.fmu.freeLibrary)
        self.initialise(start, **values)

    def _log(self, _: object, _name: object, _status: object, _category: object, message: bytes) -> None:
        self.messages.append(message.decode())

    def initialise(self, start: float = 0.0, **values: float) -> None:
        self.time = start
        self.fmu.setupExperiment(startTime=start)
        self.fmu.enterInitializationMode()
        self.set(values)
        self.fmu.exitInitializationMode()

    def set(self, values: Mapping[str, float]) -> None:
        for name, number in values.items():
            variable = self.variables[name]
            kind = "Integer" if variable.type == "Enumeration" else variable.type
            getattr(self.fmu, f"set{kind}")([variable.valueReference], [number])

    def get(self, name: str) -> Any:
        variable = self.variables[name]
        kind = "Integer" if variable.type == "Enumeration" else variable.type
        return getattr(self.fmu, f"get{kind}")([variable.valueReference])[0]

    def step(self, size: float) -> None:
        self.fmu.doStep(currentCommunicationPoint=self.time, communicationStepSize=size)
        self.time += size


def fly_one(path: Path, values: Mapping[str, float] | None = None) -> dict[str, np.ndarray]:
    """Simulate it by FMPy over its default experiment; return its outputs and exposed signals, time (s) among them."""
    description = fmpy.read_model_description(str(path))
    experiment = description.defaultExperiment
    step = float(experiment.stepSize)
    names = [each.name for each in description.modelVariables if each.causality in ("output", "local")]
    rows = fmpy.simulate_fmu(
        str(path),
        stop_time=float(experiment.stopTime),
        step_size=step,
        output_interval=step,
        output=names,
        fmi_type="CoSimulation",
        start_values=dict(values or {}),
    )
    return {name: rows[name] for name in rows.dtype.names}
