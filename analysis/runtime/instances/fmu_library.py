"""Shared library of an FMU: loaded for its first instance, unloaded after its last."""

from __future__ import annotations

import contextlib
import copy
import ctypes
import threading
from collections.abc import Callable
from pathlib import Path

from ..fmi.representations import REPRESENTATIONS
from ..loop.library import load_library
from ..system.fmu import Fmu
from .slaves import Fmi3Slave, FMU2WatchedSlave, Slave

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
    "fmi2Terminate",
    "fmi2SetString",
    "fmi2GetString",
    *(f"fmi3Set{name}" for name in REPRESENTATIONS),
    *(f"fmi3Get{name}" for name in REPRESENTATIONS),
    "fmi3DoStep",
    "fmi3Reset",
    "fmi3EnterConfigurationMode",
    "fmi3ExitConfigurationMode",
    "fmi3EnterInitializationMode",
    "fmi3ExitInitializationMode",
    "fmi3EnterEventMode",
    "fmi3UpdateDiscreteStates",
    "fmi3EnterStepMode",
    "fmi3Terminate",
)

# FMPy changes the process's working directory while it loads a library. Hold this lock while loading one,
# or while reading files by relative path when other threads may do so.
LOADING = threading.RLock()


class Library:
    """Library shared by the instances of one unpacked FMU, since FMPy takes milliseconds to load it for each."""

    def __init__(self, fmu: Fmu) -> None:
        self._restore = _keep_environment if fmu.is_self_contained else load_library().perilune_restore_floats
        with contextlib.chdir(Path.cwd()):  # restores the folder even if loading fails
            try:
                self._slave: Slave = (FMU2WatchedSlave if fmu.version == 2 else Fmi3Slave)(
                    guid=fmu.description.guid,
                    unzipDirectory=str(fmu.folder),
                    modelIdentifier=fmu.description.coSimulation.modelIdentifier,
                )
            finally:
                self._restore()
        if not fmu.is_self_contained:
            self._slave.after_call = self._restore
        dll, prefix = self._slave.dll, f"fmi{fmu.version}"
        functions = [getattr(dll, name) if name.startswith(prefix) else None for name in FUNCTION_NAMES]
        self.addresses = [
            0 if function is None else ctypes.cast(function, ctypes.c_void_p).value or 0 for function in functions
        ]
        self.place = _find_locator(self._slave.dll) if fmu.is_own else None
        self.users = 0

    def slave(self, instance_name: str) -> Slave:
        """Return FMPy's object for another instance, which is not instantiated yet."""
        slave = copy.copy(self._slave)
        slave.instanceName = instance_name
        return slave

    def unload(self) -> None:
        self._slave.freeLibrary()
        self._restore()


def _keep_environment() -> None:
    """Do nothing: Perilune's FMUs leave the floating-point environment unchanged."""


def _find_locator(dll: ctypes.CDLL) -> Callable[..., int | None] | None:
    """Return the function of Perilune's native FMUs that locates variables in memory, or None."""
    try:
        function = dll.perilune_place
    except AttributeError:
        return None
    function.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int, ctypes.c_int]
    function.restype = ctypes.c_void_p
    return function


_libraries: dict[Path, Library] = {}  # by the folder into which the FMU is unpacked


def acquire(fmu: Fmu) -> Library:
    """Return the library of an FMU, loaded if necessary. Release it with `release`. FMPy raises bare Exception."""
    with LOADING:
        if fmu.folder not in _libraries:
            _libraries[fmu.folder] = Library(fmu)
        library = _libraries[fmu.folder]
        library.users += 1
        return library


def release(fmu: Fmu) -> None:
    """Unload the library of an FMU unless another instance uses it."""
    with LOADING:
        library = _libraries[fmu.folder]
        library.users -= 1
        if not library.users:
            del _libraries[fmu.folder]
            library.unload()
