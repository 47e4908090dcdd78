"""The descent in Basilisk."""

import numpy as np
from Basilisk.simulation import extForceTorque, fuelTank

from crosscheck.basilisk_side import Flight, column
from crosscheck.cases.moon_thrust.case import (
    CASE,
    DIRECTION,
    FLOW,
    INITIAL_MASS,
    MU,
    PROPELLANT,
    RADIUS,
    SPEED,
    START,
    THRUST,
)
from crosscheck.table import Table


def fly(step: float) -> Table:
    """Simulate a hub and a tank whose masses add up to the lander's."""
    flight = Flight(step)
    flight.attract(MU)
    flight.craft.hub.mHub = INITIAL_MASS - PROPELLANT
    flight.start(np.add(START, (0.0, 0.0, RADIUS)), SPEED)
    tank = fuelTank.FuelTank()
    model = fuelTank.FuelTankModelConstantVolume()
    model.propMassInit, model.radiusTankInit, model.r_TcT_TInit = PROPELLANT, 0.5, column((0.0, 0.0, 0.0))
    tank.setTankModel(model)
    tank.setR_TB_B((0.0, 0.0, 0.0))
    tank.setFuelLeakRate(FLOW)
    flight.craft.addStateEffector(tank)
    flight.add(tank)
    engine = extForceTorque.ExtForceTorque()
    engine.extForce_N = column(THRUST * np.array(DIRECTION))
    flight.craft.addDynamicEffector(engine)
    flight.add(engine)
    masses = tank.fuelTankOutMsg.recorder()
    flight.add(masses)
    flight.run(CASE.duration)
    table = flight.table()
    table["position[3]"] = table["position[3]"] - RADIUS
    table["mass"] = INITIAL_MASS - PROPELLANT + np.array(masses.fuelMass)
    return table
