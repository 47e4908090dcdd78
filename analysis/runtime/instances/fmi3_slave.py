"""FMPy's face of an FMI 3.0 instance."""

from __future__ import annotations

import ctypes
import os
from typing import Any

from fmpy import fmi2, fmi3


class Fmi3Slave(fmi3.FMU3Slave):  # type: ignore[misc]  # FMPy has no types
    """An instance by co-simulation; ``environment`` is the number that its messages carry."""

    environment = 0

    def begin(self, environment: int, log: Any, *, uses_events: bool) -> None:
        """Instantiate; ``log`` is a fmi3LogMessageCallback. Raises bare Exception where there is no instance."""
        from .intermediate import ignore_address  # imports numba, which verbs that fly nothing do without

        self.environment, self.logMessage = environment, log
        self.intermediateUpdate = ctypes.cast(ignore_address(), fmi3.fmi3IntermediateUpdateCallback)
        resources = os.path.join(self.unzipDirectory, "resources", "")
        self.component = self.fmi3InstantiateCoSimulation(
            self.instanceName.encode(),
            self.guid.encode(),
            resources.encode(),
            False,  # visible
            True,  # loggingOn
            uses_events,
            uses_events,  # early return: only for its events there is something to do before the step's end
            (fmi3.fmi3ValueReference * 0)(),
            0,
            environment,
            log,
            self.intermediateUpdate,
        )
        if not self.component:
            raise Exception("Failed to instantiate FMU")


Slave = fmi2.FMU2Slave | Fmi3Slave
