"""The flight in Basilisk."""

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import extForceTorque, reactionWheelStateEffector
from Basilisk.utilities import macros, simIncludeRW

from crosscheck.basilisk_side import Flight, column, elements, to_mrp
from crosscheck.cases.wheel_satellite.case import (
    ANGULAR_VELOCITY,
    AXES,
    CASE,
    COMMANDS,
    COULOMB,
    INERTIA,
    QUATERNION,
    SPEEDS,
    SPIN_INERTIA,
    TORQUE,
    VISCOUS,
)
from crosscheck.table import Table


def fly(step: float) -> Table:
    """Simulate a hub with balanced wheels, which are updated before it, so that a command is in force at once."""
    flight = Flight(step)
    flight.set_inertia([list(row) for row in INERTIA])
    flight.start((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), to_mrp(QUATERNION), ANGULAR_VELOCITY)
    external = extForceTorque.ExtForceTorque()
    external.extTorquePntB_B = column(TORQUE)
    flight.craft.addDynamicEffector(external)
    flight.add(external)
    wheels = reactionWheelStateEffector.ReactionWheelStateEffector()
    factory = simIncludeRW.rwFactory()
    for axis, speed in zip(AXES, SPEEDS, strict=True):
        factory.create(
            "custom",
            list(axis),
            Js=SPIN_INERTIA,
            Omega=speed / macros.RPM,
            RWModel=messaging.BalancedWheels,
            useMaxTorque=False,
            useRWfriction=True,
            fCoulomb=COULOMB,
            cViscous=VISCOUS,
        )
    factory.addToSpacecraft("wheels", wheels, flight.craft)
    flight.add(wheels, priority=2)
    command = messaging.ArrayMotorTorqueMsg()
    wheels.rwMotorCmdInMsg.subscribeTo(command)
    speeds = wheels.rwSpeedOutMsg.recorder()
    flight.add(speeds)
    for (_, torques), end in zip(COMMANDS, [*(time for time, _ in COMMANDS[1:]), CASE.duration], strict=True):
        command.write(messaging.ArrayMotorTorqueMsgPayload(motorTorque=list(torques)))
        flight.run(end)
    return flight.table() | elements("wheel_speed", np.array(speeds.wheelSpeeds)[:, : len(SPEEDS)])
