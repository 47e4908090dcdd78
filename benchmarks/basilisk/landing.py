"""Landing in Basilisk: the lander of moon_thrust, whose guidance and allocation are FMUs run by FMPy.

Runs in Basilisk's environment.
"""

from functools import cache
from pathlib import Path

import numpy as np
from Basilisk.architecture import sysModel
from Basilisk.simulation import extForceTorque, fuelTank
from Basilisk.utilities import macros
from fmpy import extract

from crosscheck.basilisk_side import Flight, column
from crosscheck.stepped_fmu import SteppedFmu

FMUS = Path(__file__).parents[2] / "build" / "fmus" / "native"
STEP, LONGEST = 0.1, 450.0  # s
MOON_RADIUS, MU = 1.7374e6, 4.9028e12  # m, m3/s2
EXHAUST_VELOCITY = 9.80665 * 319.0  # m/s
MASS, DRY_MASS = 940.0, 100.0  # kg
TO_SECONDS = 1e-9
GUIDANCE = {
    "target_position": (0.0, 0.0, 1500.0),
    "gravity": 1.624219,
    "moon_radius": MOON_RADIUS,
    "gravitational_parameter": MU,
    "last_burn": 2.0,
}
ALLOCATION = {"minimum_thrust": 510.0, "maximum_thrust": 5099.0, "slew_rate_limit": 0.174532925199433}


@cache
def unpack(name: str) -> str:
    """Return the folder of an FMU, unpacked once per process."""
    return extract(str(FMUS / f"{name}.fmu"))


def load(name: str, **parameters: object) -> SteppedFmu:
    return SteppedFmu(FMUS / f"{name}.fmu", STEP, unpack(name), **parameters)


class Landing(Flight):
    """Simulation of hub, tank and engine over the Moon; guidance is updated after them and commands the next step."""

    def __init__(self) -> None:
        super().__init__(STEP)
        self.attract(MU)
        self.craft.hub.mHub = DRY_MASS
        self.tank = fuelTank.FuelTank()
        self.tank_model = fuelTank.FuelTankModelConstantVolume()
        self.tank_model.propMassInit, self.tank_model.radiusTankInit = MASS - DRY_MASS, 0.5
        self.tank.setTankModel(self.tank_model)
        self.craft.addStateEffector(self.tank)
        self.engine = extForceTorque.ExtForceTorque()
        self.craft.addDynamicEffector(self.engine)
        self.add(self.engine, priority=3)
        self.add(self.tank, priority=2)

    def guide(self) -> "Guidance":
        guidance = Guidance(self)
        self.add(guidance, priority=0)
        return guidance

    def mass(self) -> float:
        """Return the mass (kg) from the integrated state, since the tank's message is one step late."""
        propellant = self.craft.dynManager.getStateObject(self.tank.getNameOfMassState())
        return DRY_MASS + propellant.getState()[0][0]

    def run_to_end(self, guidance: "Guidance") -> None:
        """Run until the guidance has finished, or until the longest permitted time."""
        self.simulation.createNewEvent(
            "landed", macros.sec2nano(STEP), True, conditionFunction=lambda _: guidance.is_finished, terminal=True
        )
        self.simulation.InitializeSimulation()
        self.simulation.ConfigureStopTime(macros.sec2nano(LONGEST))
        self.simulation.ExecuteSimulation()


class Guidance(sysModel.SysModel):
    """Guidance and allocation of the system lunar_landing."""

    def __init__(self, landing: Landing) -> None:
        super().__init__()
        self.ModelTag = "guidance"
        self.landing = landing
        self.guidance = load("analytic_exact_guidance", **GUIDANCE)
        self.guidance.fmu.setBoolean([self.guidance.references["gravity_correction"]], [True])
        self.guidance.fmu.setInteger([self.guidance.references["terminal_step"]], [1])
        self.allocation = load("thrust_allocation", **ALLOCATION)
        self.is_finished = False

    def UpdateState(self, now: int) -> None:  # noqa: N802
        """Step both FMUs to this time, then set force and mass flow for the next step."""
        landing, time = self.landing, now * TO_SECONDS
        state = landing.craft.scStateOutMsg.read()
        mass = landing.mass()
        position = np.array(state.r_CN_N) - (0.0, 0.0, MOON_RADIUS)
        self.guidance.set(position=position, velocity=state.v_CN_N, mass=mass)
        self.guidance.advance(time)
        acceleration, since, duration = self.guidance.read("thrust_acceleration", "command_time", "burn_duration")
        self.allocation.set(
            thrust_acceleration=acceleration,
            demanded_direction=self.guidance.read_vector("thrust_direction"),
            demanded_direction_rate=self.guidance.read_vector("thrust_direction_rate"),
            demand_time=since,
            demanded_duration=duration,
            mass=mass,
        )
        self.allocation.advance(time)
        self.command(time)
        (self.is_finished,) = self.guidance.fmu.getBoolean([self.guidance.references["finished"]])

    def command(self, time: float) -> None:
        thrust, since, duration = self.allocation.read("thrust", "command_time", "burn_duration")
        along = self.allocation.read_vector("thrust_direction")
        along = along + (time + 0.5 * STEP - since) * self.allocation.read_vector("thrust_direction_rate")
        mean = max(thrust, 0.0) * min(max((since + duration - time) / STEP, 0.0), 1.0)
        self.landing.engine.extForce_N = column(mean * along / (np.linalg.norm(along) or 1.0))
        self.landing.tank.setFuelLeakRate(mean / EXHAUST_VELOCITY)
