"""The libration in Basilisk."""

import numpy as np
from Basilisk.simulation import GravityGradientEffector, extForceTorque

from crosscheck.basilisk_side import Flight, column, to_mrp
from crosscheck.cases.gravity_gradient.case import (
    ANGLES,
    ANGULAR_VELOCITY,
    CASE,
    INERTIA,
    MU,
    ORBITAL_RATE,
    PULSES,
    RADIUS,
    TORQUE,
)
from crosscheck.table import Table


def fly(step: float) -> Table:
    """Simulate on a circle in the frame of the start: x along the velocity, y away from the
    centre, z against the momentum."""
    flight = Flight(step)
    flight.attract(MU)
    flight.set_inertia([list(row) for row in INERTIA])
    flight.start((0.0, RADIUS, 0.0), (ORBITAL_RATE * RADIUS, 0.0, 0.0), to_mrp(_start()), ANGULAR_VELOCITY)
    gradient = GravityGradientEffector.GravityGradientEffector()
    gradient.addPlanetName("centre")
    flight.craft.addDynamicEffector(gradient)
    flight.add(gradient)
    jets = extForceTorque.ExtForceTorque()
    flight.craft.addDynamicEffector(jets)
    flight.add(jets)
    changes = sorted(
        {0.0, *(time for start, lengths in PULSES for time in (start, *(start + abs(x) for x in lengths)))}
    )
    for begin, end in zip(changes, [*changes[1:], CASE.duration], strict=True):
        jets.extTorquePntB_B = column(_torque(0.5 * (begin + end)))
        flight.run(end)
    return flight.table()


def _torque(time: float) -> np.ndarray:
    """Return torque (N m, body) of the jets at a time (s)."""
    total = np.zeros(3)
    for start, lengths in PULSES:
        burning = (time > start) & (time < start + np.abs(lengths))
        total += np.where(burning, np.sign(lengths) * np.array(TORQUE), 0.0)
    return total


def _start() -> np.ndarray:
    """Return the attitude at the start: turns about y by yaw, z by pitch, x by roll, one after the other."""
    roll, yaw, pitch = ANGLES
    turns = ((yaw, (0, 1, 0)), (pitch, (0, 0, 1)), (roll, (1, 0, 0)))
    total = np.array([1.0, 0.0, 0.0, 0.0])
    for angle, axis in turns:
        a, u = total[0], total[1:]
        b, v = np.cos(0.5 * angle), np.sin(0.5 * angle) * np.array(axis)
        total = np.append(a * b - u @ v, a * v + b * u + np.cross(u, v))
    return total
