"""An FMU from a file: checked, unpacked, instantiated, its C functions' addresses at hand."""

from __future__ import annotations

import contextlib
import ctypes
import hashlib
import io
import itertools
import shutil
import tempfile
import threading
import weakref
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import fmpy
from fmpy import fmi2, read_model_description
from fmpy.logging import addLoggerProxy

from analysis.errors import InputError

from .archive import open_zip
from .documents import parse_xml
from .loop import FUNCTION_NAMES
from .units import Unit, units_of_fmu

DESCRIPTION = "modelDescription.xml"


@dataclass
class Fmu:
    """An FMI 2.0 co-simulation FMU that can run here."""

    label: str
    digest: str
    description: Any  # fmpy ModelDescription
    folder: Path  # unpacked; removed with the object
    variables: dict[str, Any] = field(default_factory=dict)  # fmpy ScalarVariable by name
    units: dict[str, Unit] = field(default_factory=dict)

    @property
    def name(self) -> str:
        return self.description.modelName

    @property
    def is_native(self) -> bool:
        """Whether it runs without an execution tool such as a Python interpreter."""
        return not self.description.coSimulation.needsExecutionTool

    def unit_of(self, variable: Any) -> str | None:
        """Name of a variable's unit, its own or its type's."""
        declared = variable.declaredType
        return variable.unit or (declared.unit if declared is not None else None)

    def direct_dependencies(self) -> dict[str, set[str]]:
        """Output -> inputs it depends on directly; without a declaration all inputs, as FMI says."""
        inputs = {name for name, variable in self.variables.items() if variable.causality == "input"}
        outputs = {name: inputs for name, variable in self.variables.items() if variable.causality == "output"}
        for unknown in self.description.outputs:
            if unknown.dependencies is not None:
                outputs[unknown.variable.name] = inputs & {variable.name for variable in unknown.dependencies}
        return outputs


def load_fmu(data: bytes, label: str) -> Fmu:
    """Check and unpack an FMU; raises InputError naming file and element."""
    archive = open_zip(data, label)
    if DESCRIPTION not in archive.namelist():
        raise InputError(label, DESCRIPTION, "not found", "give an FMU")
    root = parse_xml(archive.read(DESCRIPTION), f"{label}!{DESCRIPTION}")
    version = root.get("fmiVersion")
    if version != "2.0":
        raise InputError(label, "fmiVersion", f"{version!r} is not supported", "export the FMU for FMI 2.0")
    try:
        description = read_model_description(io.BytesIO(data), validate=True)
    except Exception as error:  # fmpy raises bare Exception and lxml's errors for invalid descriptions
        raise InputError(label, DESCRIPTION, f"not valid: {error}", "mend the FMU") from error
    if description.coSimulation is None:
        raise InputError(label, "CoSimulation", "not a co-simulation FMU", "export it for co-simulation")
    identifier = description.coSimulation.modelIdentifier
    binary = f"binaries/{fmpy.platform}/{identifier}{fmpy.sharedLibraryExtension}"
    if binary not in archive.namelist():
        raise InputError(label, binary, "no binary for this platform", "compile the FMU's sources for it")
    folder = Path(tempfile.mkdtemp(prefix="perilune_"))
    archive.extractall(folder)
    fmu = Fmu(label, hashlib.sha256(data).hexdigest(), description, folder)
    fmu.variables = {variable.name: variable for variable in description.modelVariables}
    fmu.units = units_of_fmu(description)
    weakref.finalize(fmu, shutil.rmtree, folder, ignore_errors=True)
    return fmu


@dataclass
class Instance:
    """One fmi2Component with its log; freed with `free`."""

    fmu: Fmu
    slave: fmi2.FMU2Slave
    messages: list[str]

    @property
    def address(self) -> int:
        """The fmi2Component."""
        return int(self.slave.component)

    def function_addresses(self) -> list[int]:
        """Addresses of the C functions in the order of loop.FUNCTION_NAMES."""
        return [ctypes.cast(getattr(self.slave.dll, name), ctypes.c_void_p).value or 0 for name in FUNCTION_NAMES]

    def free(self) -> None:
        _logs.pop(self.slave.instanceName, None)
        self.slave.freeInstance()


# fmpy's proxy, which formats printf messages, keeps one logger per process: it finds the log by instance name.
_logs: dict[str, list[str]] = {}
_instances = itertools.count(1)
# fmpy changes the process's working directory while it loads a library: whoever does so, or reads
# files by relative path beside threads that do, holds this.
LOADING = threading.RLock()


def _log(_environment: Any, instance: bytes, status: int, category: bytes, message: bytes) -> None:
    log = _logs.get((instance or b"").decode(errors="replace"))
    if log is not None and message:
        log.append(message.decode(errors="replace").strip())


_callbacks = fmi2.fmi2CallbackFunctions()
_callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(_log)
_callbacks.allocateMemory = fmi2.defaultCallbacks.allocateMemory
_callbacks.freeMemory = fmi2.defaultCallbacks.freeMemory
addLoggerProxy(ctypes.byref(_callbacks))


def instantiate(fmu: Fmu, name: str) -> Instance:
    """Instantiate an FMU; ``name`` is the component's, made unique in the process."""
    unique = f"{name}#{next(_instances)}"
    _logs[unique] = []
    try:
        with LOADING, contextlib.chdir(Path.cwd()):  # back also when loading fails
            slave = fmi2.FMU2Slave(
                guid=fmu.description.guid,
                unzipDirectory=str(fmu.folder),
                modelIdentifier=fmu.description.coSimulation.modelIdentifier,
                instanceName=unique,
            )
        slave.instantiate(callbacks=_callbacks, loggingOn=True)
    except Exception as error:  # fmpy raises bare Exception when the library does not load or instantiate
        log = " | ".join([str(error), *_logs.pop(unique)])
        raise InputError(fmu.label, name, f"cannot be instantiated: {log}", "see the FMU's log") from error
    return Instance(fmu, slave, _logs[unique])
