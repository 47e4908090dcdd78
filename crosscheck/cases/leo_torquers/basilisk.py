"""The flight in Basilisk."""

import tempfile
from pathlib import Path

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import MtbEffector

from crosscheck.cases.leo_torquers import case
from crosscheck.cases.leo_torquers.case import CASE, COMMANDS, LIMIT, RESIDUAL
from crosscheck.space.basilisk_ahead import Ahead
from crosscheck.space.basilisk_effectors import begin_in_gradient
from crosscheck.space.basilisk_field import world_field
from crosscheck.space.basilisk_surroundings import Surroundings
from crosscheck.table import Table


def fly(step: float, given: dict) -> Table:
    """Simulate: the craft is updated first, then its position in the middle of its next step, then the field there."""
    flight = begin_in_gradient(case, step)
    ahead, surroundings = Ahead(flight.craft, step, case.MU), Surroundings(given, step)
    flight.add(ahead, priority=0)
    flight.add(surroundings, priority=0)
    bars = MtbEffector.MtbEffector()
    flight.craft.addDynamicEffector(bars)
    with tempfile.TemporaryDirectory() as folder:
        field = world_field(given["schmidt"], Path(folder) / "field.COF")
        field.planetPosInMsg.subscribeTo(surroundings.messages["earth"])
        field.addSpacecraftToModel(ahead.states)
        flight.add(field)
        bars.magInMsg.subscribeTo(field.envOutMsgs[0])
        axes = messaging.MTBArrayConfigMsgPayload(
            numMTB=6, GtMatrix_B=np.hstack([np.eye(3), np.eye(3)]).ravel().tolist(), maxMtbDipoles=[LIMIT] * 6
        )
        parameters, command = messaging.MTBArrayConfigMsg().write(axes), messaging.MTBCmdMsg()
        bars.mtbParamsInMsg.subscribeTo(parameters)
        bars.mtbCmdInMsg.subscribeTo(command)
        flight.add(bars, priority=-2)
        for (_, dipole), end in zip(COMMANDS, [*(time for time, _ in COMMANDS[1:]), CASE.duration], strict=True):
            command.write(messaging.MTBCmdMsgPayload(mtbDipoleCmds=[*dipole, *RESIDUAL]))
            flight.run(end)
    return flight.table()
