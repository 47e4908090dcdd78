"""Times of the steps of an FMU of FMI 2.0 with recorded inputs: `python -m benchmarks.recorded_steps FMU RECORDING`.

Prints the times (us) of the initialisation and of every step.
"""

from __future__ import annotations

import json
import os
import shutil
import sys
import time
from pathlib import Path

from fmpy import extract
from fmpy.fmi2 import FMU2Slave
from fmpy.model_description import read_model_description


def main() -> None:
    fmu, recording = Path(sys.argv[1]), json.loads(Path(sys.argv[2]).read_text())
    description = read_model_description(fmu)
    reference = {variable.name: variable.valueReference for variable in description.modelVariables}
    folder = extract(fmu)
    assert description.coSimulation is not None
    identifier = description.coSimulation.modelIdentifier
    slave = FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier, instanceName="guidance")
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    setters = {"Real": slave.setReal, "Integer": slave.setInteger, "Boolean": slave.setBoolean}
    for kind, parameters in recording["parameters"].items():
        for name, number in parameters.items():
            setters[kind]([reference[name]], [number if kind == "Real" else int(number)])
    references = [reference[name] for name in recording["inputs"]]
    rows = [list(row) for row in zip(*recording["inputs"].values(), strict=True)]
    slave.setReal(references, rows[0])
    slave.enterInitializationMode()
    begin = time.perf_counter()
    slave.exitInitializationMode()
    print(f"{(time.perf_counter() - begin) * 1e6:.3f}")
    for index, row in enumerate(rows):
        slave.setReal(references, row)
        begin = time.perf_counter()
        slave.doStep(currentCommunicationPoint=index * recording["step"], communicationStepSize=recording["step"])
        print(f"{(time.perf_counter() - begin) * 1e6:.3f}")
    slave.terminate()
    slave.freeInstance()
    shutil.rmtree(folder)
    sys.stdout.flush()
    os._exit(0)  # pythonfmu's loader may abort in its destructor when the process ends


if __name__ == "__main__":
    main()
