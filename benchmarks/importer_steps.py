"""Number of block FMUs that an importer can simulate, by step size: `python -m benchmarks.importer_steps`.

Needs build_fmus.py. FMPy simulates each FMU from its declared start values, 20 steps of 0.001 to 60 s. An FMU passes if
every step returns OK and all Real outputs are finite; for an FMU that fails the step size and its message are printed.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Slave

from perilune.common.paths import CACHE, shipped_fmu
from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.native_fmu import build_native_fmu

STEPS = (0.001, 0.01, 0.1, 1.0, 10.0, 60.0)  # s
COUNT = 20
FORMS = {"native": "FMI 2.0, native", "python": "FMI 2.0, Python", "fmi3": "FMI 3.0, native"}


def fmu_of(block: type[Block], form: str) -> Path:
    """Return the path of the built FMU of FMI 2.0, or of FMI 3.0 for this machine."""
    if form != "fmi3":
        return shipped_fmu(block.fmu_name, form)
    platform = local_platform(3)
    assert platform is not None
    path = CACHE / "fmi3" / f"{block.fmu_name}.fmu"
    return build_native_fmu(block, path, platforms=[platform], cache=CACHE, fmi=3)


def blocks_of(form: str) -> list[type[Block]]:
    """Return the blocks whose FMUs are available in this form."""
    return [block for block in catalogue().values() if form == "python" or not block.python_only]


def find_failure(fmu: Path, step: float) -> str | None:
    """Return the message that ends a simulation with this step (s); None if it succeeds."""
    description = fmpy.read_model_description(str(fmu), validate=False)
    reals = [v.valueReference for v in description.modelVariables if v.type in ("Real", "Float64") and not v.dimensions]
    messages: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        arguments = {
            "guid": description.guid,
            "unzipDirectory": fmpy.extract(str(fmu), folder),
            "modelIdentifier": description.coSimulation.modelIdentifier,
            "instanceName": "steps",
        }
        slave = FMU2Slave(**arguments) if description.fmiVersion == "2.0" else FMU3Slave(**arguments)
        try:
            if description.fmiVersion == "2.0":
                callbacks = fmi2CallbackFunctions()
                callbacks.logger = fmi2CallbackLoggerTYPE(lambda *a: messages.append(a[-1].decode()))
                slave.instantiate(callbacks=callbacks)
                slave.setupExperiment(startTime=0.0)
                slave.enterInitializationMode()
            else:
                slave.instantiate(logMessage=lambda *a: messages.append(a[-1].decode()), loggingOn=True)
                slave.enterInitializationMode(startTime=0.0)
            slave.exitInitializationMode()
            for n in range(COUNT):
                slave.doStep(n * step, step)
            get = slave.getReal if description.fmiVersion == "2.0" else slave.getFloat64
            return None if np.isfinite(get(reals)).all() else "an output is not finite"
        except FMICallException as error:
            return messages[-1] if messages else str(error)
        finally:
            slave.freeInstance()


def failures(form: str, blocks: Sequence[type[Block]]) -> dict[tuple[str, float], str]:
    """Return the messages that end simulations, by FMU and step (s)."""
    endings = {(block.fmu_name, step): find_failure(fmu_of(block, form), step) for block in blocks for step in STEPS}
    return {key: message for key, message in endings.items() if message is not None}


def row(label: str, numbers: Sequence[object]) -> str:
    """Return a table row."""
    return f"| {' | '.join([label, *map(str, numbers)])} |"


def samples_row() -> str:
    """Return the row with the number of blocks that have several sample instants per step at their declared periods."""
    periods = [
        float(b.variables["sample_period"].elements[0]) for b in blocks_of("python") if "sample_period" in b.variables
    ]
    several = [sum(0.0 < 2.0 * period <= step * (1.0 + 1e-6) for period in periods) for step in STEPS]
    return row("with several samples in each step", several)


def passed_row(form: str, failed: dict[tuple[str, float], str]) -> str:
    """Return the row with the number of FMUs of a form that pass."""
    total = len(blocks_of(form))
    counts = [total - sum(key[1] == step for key in failed) for step in STEPS]
    return row(f"{FORMS[form]}: of {total}", counts)


def main() -> None:
    """Print the table, followed by the failures."""
    print(row("step, s", [f"{step:g}" for step in STEPS]))
    print(row("---", ["---"] * len(STEPS)))
    listed = []
    for form in FORMS:
        failed = failures(form, blocks_of(form))
        print(passed_row(form, failed), flush=True)
        listed += [f"{FORMS[form]}: {name} at {step:g} s: {message}" for (name, step), message in failed.items()]
    print(samples_row())
    print("\n".join(["", *(listed or ["Nothing fails."])]), flush=True)


if __name__ == "__main__":
    main()
    sys.stderr.flush()
    os._exit(0)  # ends before the destructors of pythonfmu's library run
