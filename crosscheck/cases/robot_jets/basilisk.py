"""The jets' flight in Basilisk, by its on-time thrusters."""

from Basilisk.architecture import messaging
from Basilisk.simulation import thrusterDynamicEffector

from crosscheck.basilisk_side import Flight, to_mrp
from crosscheck.cases.robot_jets.case import (
    ANGULAR_VELOCITY,
    CASE,
    DIRECTIONS,
    INERTIA,
    MASS,
    ON_TIMES,
    POSITIONS,
    QUATERNION,
    SURE,
    THRUST,
)
from crosscheck.table import Table


def fly(step: float) -> Table:
    """Simulate thrusters of a constant mass, commanded once."""
    flight = Flight(step)
    flight.set_inertia([[INERTIA[0], 0.0, 0.0], [0.0, INERTIA[1], 0.0], [0.0, 0.0, INERTIA[2]]], MASS)
    flight.start((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), to_mrp(QUATERNION), ANGULAR_VELOCITY)
    jets = thrusterDynamicEffector.ThrusterDynamicEffector()
    for position, direction in zip(POSITIONS, DIRECTIONS, strict=True):
        jet = thrusterDynamicEffector.THRSimConfig()
        jet.thrLoc_B, jet.thrDir_B = [[x] for x in position], [[x] for x in direction]
        jet.MaxThrust, jet.steadyIsp, jet.MinOnTime = THRUST, 1e12, 0.0
        jets.addThruster(jet)
    command = messaging.THRArrayOnTimeCmdMsgPayload()
    command.OnTimeRequest = [on_time + SURE if on_time else 0.0 for on_time in ON_TIMES]
    message = messaging.THRArrayOnTimeCmdMsg().write(command)
    jets.cmdsInMsg.subscribeTo(message)
    flight.craft.addDynamicEffector(jets)
    flight.add(jets, priority=2)
    flight.run(CASE.duration)
    return flight.table()
