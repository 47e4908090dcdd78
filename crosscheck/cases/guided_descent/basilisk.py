"""The descent in Basilisk, guided by the FMU through FMPy."""

from pathlib import Path

import numpy as np
from Basilisk.architecture import sysModel
from Basilisk.simulation import extForceTorque
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from crosscheck.basilisk_side import Flight, column
from crosscheck.cases.guided_descent.case import CASE, FMU, GRAVITY, MASS, SPEED, START, TARGET
from crosscheck.table import Table

ROOT = Path(__file__).parents[3]
UP = np.array([0.0, 0.0, 1.0])
TO_SECONDS = 1e-9


class Guidance(sysModel.SysModel):
    """The FMU as a Basilisk module: reads the craft's state, sets the force of the step that follows."""

    def __init__(self, craft: object, engine: object, step: float) -> None:
        super().__init__()
        self.ModelTag = "guidance"
        self.craft, self.engine, self.length = craft, engine, step
        description = read_model_description(str(ROOT / FMU))
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=extract(str(ROOT / FMU)),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="guidance",
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.set("target_position", TARGET)
        self.set("gravity", [GRAVITY])
        self.fmu.enterInitializationMode()
        self.is_initialised = False

    def set(self, name: str, numbers: object) -> None:
        """Set a scalar, or the elements of a vector."""
        names = [name] if len(numbers) == 1 else [f"{name}[{k + 1}]" for k in range(len(numbers))]
        self.fmu.setReal([self.references[each] for each in names], [float(number) for number in numbers])

    def read(self, *names: str) -> np.ndarray:
        return np.array(self.fmu.getReal([self.references[name] for name in names]))

    def UpdateState(self, now: int) -> None:  # noqa: N802
        """A step of the FMU to this time, with the state at it: its outputs depend directly on its inputs."""
        time = now * TO_SECONDS
        state = self.craft.scStateOutMsg.read()
        self.set("position", state.r_CN_N)
        self.set("velocity", state.v_CN_N)
        self.set("mass", [MASS])
        if self.is_initialised:
            self.fmu.doStep(time - self.length, self.length)
        else:
            self.fmu.exitInitializationMode()
            self.is_initialised = True
        self.engine.extForce_N = column(MASS * (self.thrust(time + 0.5 * self.length) - GRAVITY * UP))

    def thrust(self, time: float) -> np.ndarray:
        """Thrust acceleration (m/s2) at a time (s)."""
        size, since = self.read("thrust_acceleration", "command_time")
        direction = self.read(*(f"thrust_direction[{k}]" for k in (1, 2, 3)))
        rate = self.read(*(f"thrust_direction_rate[{k}]" for k in (1, 2, 3)))
        along = direction + (time - since) * rate
        return size * along / np.linalg.norm(along)


def fly(step: float) -> Table:
    """The craft is updated first, then its guidance, whose force is that of the next step."""
    flight = Flight(step)
    flight.craft.hub.mHub = MASS
    flight.start(START, SPEED)
    engine = extForceTorque.ExtForceTorque()
    flight.craft.addDynamicEffector(engine)
    flight.add(engine)
    guidance = Guidance(flight.craft, engine, step)
    flight.add(guidance, priority=0)
    flight.run(CASE.duration)
    return flight.table()
