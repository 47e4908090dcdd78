"""A free craft with moving masses in Basilisk, under a force and a torque in body axes. Runs in its environment."""

import numpy as np
from Basilisk.architecture import sysModel
from Basilisk.simulation import extForceTorque

from crosscheck.basilisk_side import Flight, column
from crosscheck.table import Table


class States(sysModel.SysModel):
    """Recorder of scalar states of the dynamics, by name."""

    def __init__(self, craft: object, names: list[str]) -> None:
        super().__init__()
        self.ModelTag = "states"
        self.craft, self.names = craft, names
        self.rows: list[list[float]] = []

    def UpdateState(self, now: int) -> None:  # noqa: N802
        """Record the states of this time (ns)."""
        manager = self.craft.dynManager
        self.rows.append([manager.getStateObject(name).getState()[0][0] for name in self.names])


def swing(
    hub: tuple[float, np.ndarray, np.ndarray],
    effectors: list[object],
    names: list[str],
    drive: tuple[np.ndarray, np.ndarray],
    step: float,
    duration: float,
) -> Table:
    """Return the table of a flight from rest: a hub with effectors under a force (N) and a torque (N m) at the origin.

    ``names`` are the states of the effectors, which become displacement[1] and so on.
    """
    flight = Flight(step)
    mass, position, inertia = hub
    flight.set_inertia(inertia.tolist(), mass)
    flight.craft.hub.r_BcB_B = column(position)
    flight.start((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    for effector in effectors:
        flight.craft.addStateEffector(effector)
    acting = extForceTorque.ExtForceTorque()
    acting.extForce_B, acting.extTorquePntB_B = (column(each) for each in drive)
    flight.craft.addDynamicEffector(acting)
    flight.add(acting, priority=2)
    states = States(flight.craft, names)
    flight.add(states, priority=0)
    flight.run(duration)
    rows = np.array(states.rows).T
    return flight.table() | {f"displacement[{k + 1}]": row for k, row in enumerate(rows)}
