"""An FMU inside a Basilisk simulation, stepped by FMPy. Runs in Basilisk's environment."""

from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave


class SteppedFmu:
    """An instance in initialisation mode, which `advance` leaves at its first call: set the first inputs before."""

    def __init__(self, file: Path, step: float, folder: str | None = None, **parameters: object) -> None:
        description = read_model_description(str(file))
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.length = step
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder or extract(str(file)),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=description.modelName,
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.set(**parameters)
        self.fmu.enterInitializationMode()
        self.is_initialised = False

    def set(self, **inputs: object) -> None:
        """Set Reals by name, vectors by their elements."""
        references: list[int] = []
        numbers: list[float] = []
        for name, given in inputs.items():
            elements = np.atleast_1d(given).ravel()
            names = [f"{name}[{k + 1}]" for k in range(elements.size)] if f"{name}[1]" in self.references else [name]
            references += [self.references[each] for each in names]
            numbers += elements.tolist()
        self.fmu.setReal(references, numbers)

    def read(self, *names: str) -> np.ndarray:
        return np.array(self.fmu.getReal([self.references[name] for name in names]))

    def read_vector(self, name: str) -> np.ndarray:
        return self.read(*(f"{name}[{k}]" for k in (1, 2, 3)))

    def advance(self, time: float) -> None:
        """Step to a time (s); at the start, end the initialisation."""
        if self.is_initialised:
            self.fmu.doStep(time - self.length, self.length)
        else:
            self.fmu.exitInitializationMode()
            self.is_initialised = True
