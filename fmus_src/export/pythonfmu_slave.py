"""Bridge from FMI calls to a block's life cycle, inside a pythonfmu FMU."""

from __future__ import annotations

import json
import linecache
import math
import sys
import traceback
from typing import Any, ClassVar

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

from ..block import Block
from ..runtime import BlockInstance


def keep_source(package: str) -> None:
    """Cache the source lines of a package for tracebacks, since the folder of its modules may disappear."""
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None) if name.startswith(f"{package}.") else None
        if file is not None and file not in linecache.cache:
            lines = linecache.getlines(file)
            linecache.cache[file] = (sum(map(len, lines)), None, lines, file)  # without date: never checked again


class BlockSlave(Fmi2Slave):
    """FMI 2.0 slave around one block; the FMU's script names the block.

    Values are accessed by reference directly in the block, without pythonfmu's registered variables;
    modelDescription.xml is written from the block's declaration at build time. A step that fails logs its traceback and
    returns fmi2Discard, the only failure that pythonfmu's wrapper can report without losing the instance.
    """

    block_class: ClassVar[type[Block]]
    tunable: ClassVar[tuple[str, ...]] = ()  # names of parameters that may be set between steps

    def __init__(self, **keywords: Any) -> None:
        super().__init__(**keywords)
        keep_source(__package__.partition(".")[0])
        self.modelName = self.block_class.fmu_name
        self.component = BlockInstance(self.block_class, self.tunable)
        self.component.block.fmu_resources = self.resources
        self.time: float | None = None  # end of the last step; None after a restored state
        self.stop_time = math.inf
        self.get_real = self.get_integer = self.get_boolean = self.get_values
        self.set_real = self.set_integer = self.set_boolean = self.set_values

    def get_values(self, references: list[int]) -> list:
        """Return values by reference; a failing initialisation is logged and raised."""
        try:
            return self.component.get(references)
        except Exception:
            self.log_failure()
            raise

    def set_values(self, references: list[int], values: list) -> None:
        """Set inputs or parameters by reference; a rejected value is logged and raised."""
        try:
            self.component.set(references, values)
        except Exception:
            self.log_failure()
            raise

    def log_failure(self) -> None:
        """Send the current traceback to the importer's log, escaped for FMI 2.0's printf format."""
        self.log(traceback.format_exc().replace("%", "%%"), Fmi2Status.error)

    def setup_experiment(self, start_time: float, stop_time: float | None, *_: object) -> None:
        # All modules are imported; if left on the path, this folder would serve other FMUs' imports.
        sys.path[:] = [entry for entry in sys.path if entry != self.resources]
        self.component.start_time = self.time = start_time
        self.stop_time = math.inf if stop_time is None else stop_time

    def exit_initialization_mode(self) -> None:
        try:
            self.component.start()
        except Exception:
            self.log_failure()
            raise

    def do_step(self, current_time: float, step_size: float) -> bool:
        try:
            if self.time is not None:
                self.component.check_point(current_time, step_size, self.time)
            self.component.check_end(current_time, step_size, self.stop_time)
            self.component.do_step(current_time, step_size)
            self.time = current_time + step_size
        except Exception:  # an exception of a block ends the simulation with its traceback
            self.log_failure()
            return False
        return True

    def terminate(self) -> None:
        self.component.block.drop_external()

    def _get_fmu_state(self) -> dict[str, Any]:
        return self.component.get_state()

    def _set_fmu_state(self, state: dict[str, Any]) -> None:
        self.component.set_state(state)
        self.time = None

    @staticmethod
    def _fmu_state_to_bytes(state: dict[str, Any]) -> bytes:
        return json.dumps(state).encode()  # Python writes floats so that they read back to the same bits

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> dict[str, Any]:
        return json.loads(state.decode())
