"""The descent in Basilisk, guided by the FMU through FMPy."""

from pathlib import Path

import numpy as np
from Basilisk.architecture import sysModel
from Basilisk.simulation import extForceTorque

from crosscheck.basilisk_side import Flight, column
from crosscheck.cases.guided_descent.case import CASE, FMU, GRAVITY, MASS, SPEED, START, TARGET
from crosscheck.stepped_fmu import SteppedFmu
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
        self.fmu = SteppedFmu(ROOT / FMU, step, target_position=TARGET, gravity=GRAVITY)

    def UpdateState(self, now: int) -> None:  # noqa: N802
        """Step the FMU to this time, with the state at it: its outputs depend directly on its inputs."""
        time = now * TO_SECONDS
        state = self.craft.scStateOutMsg.read()
        self.fmu.set(position=state.r_CN_N, velocity=state.v_CN_N, mass=MASS)
        self.fmu.advance(time)
        self.engine.extForce_N = column(MASS * (self.thrust(time + 0.5 * self.length) - GRAVITY * UP))

    def thrust(self, time: float) -> np.ndarray:
        """Return thrust acceleration (m/s2) at a time (s)."""
        size, since = self.fmu.read("thrust_acceleration", "command_time")
        along = self.fmu.read_vector("thrust_direction")
        along = along + (time - since) * self.fmu.read_vector("thrust_direction_rate")
        return size * along / np.linalg.norm(along)


def fly(step: float) -> Table:
    """Simulate: the craft is updated first, then its guidance, whose force is that of the next step."""
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
