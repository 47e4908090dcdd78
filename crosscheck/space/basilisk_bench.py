"""Modules of Basilisk at inputs that we write, without a flight. Runs in Basilisk's environment."""

from collections.abc import Iterable

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.utilities import SimulationBaseClass, macros

from crosscheck.basilisk_side import to_mrp


def update_once(*models: object, until: float = 0.0) -> None:
    """Update modules in this order at the time 0, and every second until a time (s)."""
    simulation = SimulationBaseClass.SimBaseClass()
    simulation.CreateNewProcess("process").addTask(simulation.CreateNewTask("task", macros.sec2nano(1.0)))
    for k, model in enumerate(models):
        model.ModelTag = f"model {k}"
        simulation.AddModelToTask("task", model, len(models) - k)
    simulation.InitializeSimulation()
    simulation.ConfigureStopTime(macros.sec2nano(until))
    simulation.ExecuteSimulation()


def craft_state(
    position: Iterable[float] = (0.0, 0.0, 0.0),
    quaternion: Iterable[float] = (1.0, 0.0, 0.0, 0.0),
    rate: Iterable[float] = (0.0, 0.0, 0.0),
) -> object:
    """Return the message of a craft at a position (m, inertial), body to inertial, with a rate (rad/s, body)."""
    state = messaging.SCStatesMsgPayload()
    state.r_BN_N = state.r_CN_N = [float(each) for each in position]
    state.sigma_BN = to_mrp(np.array(list(quaternion))).tolist()
    state.omega_BN_B = [float(each) for each in rate]
    return messaging.SCStatesMsg().write(state)


def planet_state(position: Iterable[float] = (0.0, 0.0, 0.0), name: str = "earth") -> object:
    """Return the message of a planet at a position (m, inertial), whose axes are the inertial ones."""
    state = messaging.SpicePlanetStateMsgPayload()
    state.PositionVector = [float(each) for each in position]
    state.J20002Pfix = np.eye(3).tolist()
    state.PlanetName = name
    return messaging.SpicePlanetStateMsg().write(state)
