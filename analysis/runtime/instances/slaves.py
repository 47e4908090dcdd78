"""FMPy's classes for instances of FMI 2.0 and FMI 3.0, with Perilune's additions."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Callable
from typing import Any

from fmpy import fmi2, fmi3

from ..loop.library import load_library


class CallWatch:
    """Mixin that calls ``after_call`` after every function of the FMU, even a function that fails."""

    after_call: Callable[[], None] | None = None

    def _call(self, name: str, *arguments: Any) -> Any:  # FMPy makes all calls through this method
        try:
            return super()._call(name, *arguments)  # type: ignore[misc]
        finally:
            if self.after_call is not None:
                self.after_call()


class FMU2WatchedSlave(CallWatch, fmi2.FMU2Slave):  # type: ignore[misc]  # FMPy has no types
    """Instance of FMI 2.0. FMPy derives the version from the beginning of the class name."""


class Fmi3Slave(CallWatch, fmi3.FMU3Slave):  # type: ignore[misc]  # FMPy has no types
    """Instance of FMI 3.0, identified by the number ``environment`` in its log messages."""

    environment = 0

    def begin(self, environment: int, log: Any, *, uses_events: bool) -> None:
        """Instantiate; ``log`` is a fmi3LogMessageCallback. Raises bare Exception if the FMU returns no instance."""
        self.environment, self.logMessage = environment, log
        idle = load_library().perilune_ignore_update
        self.intermediateUpdate = ctypes.cast(idle, fmi3.fmi3IntermediateUpdateCallback)
        resources = os.path.join(self.unzipDirectory, "resources", "")
        self.component = self.fmi3InstantiateCoSimulation(
            self.instanceName.encode(),
            self.guid.encode(),
            resources.encode(),
            False,  # visible
            True,  # loggingOn
            uses_events,
            uses_events,  # early return, which is needed only for events
            (fmi3.fmi3ValueReference * 0)(),
            0,
            environment,
            log,
            self.intermediateUpdate,
        )
        if not self.component:
            raise Exception("Failed to instantiate FMU")


Slave = FMU2WatchedSlave | Fmi3Slave
