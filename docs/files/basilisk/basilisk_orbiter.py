"""A spacecraft around the Earth, simulated by Basilisk."""

from Basilisk.simulation import extForceTorque, gravityEffector, spacecraft
from Basilisk.utilities import SimulationBaseClass, macros
from perilune import Block, ExternalState, Input, Output, Parameter


class BasiliskOrbiter(Block):
    """Point mass around the Earth under a force; Basilisk integrates by Runge-Kutta of fourth order."""

    python_only = True
    requires = ("Basilisk",)
    initial_position = Parameter([7e6, 0.0, 0.0], unit="m", frame="inertial", description="at the start")
    initial_velocity = Parameter([0.0, 7546.0, 0.0], unit="m/s", frame="inertial", description="at the start")
    internal_step = Parameter(1.0, unit="s", minimum=1e-3, description="of Basilisk")
    force = Input([0.0, 0.0, 0.0], unit="N", frame="inertial", description="constant over a communication step")
    position = Output([0.0, 0.0, 0.0], unit="m", frame="inertial", description="from the Earth's centre")
    velocity = Output([0.0, 0.0, 0.0], unit="m/s", frame="inertial", description="velocity")
    simulation = ExternalState("the Basilisk simulation")

    def initialize(self) -> None:
        self.simulation = simulation = SimulationBaseClass.SimBaseClass()
        task = simulation.CreateNewTask("dynamics", macros.sec2nano(self.internal_step))
        simulation.CreateNewProcess("process").addTask(task)
        simulation.craft, simulation.engine = spacecraft.Spacecraft(), extForceTorque.ExtForceTorque()
        simulation.AddModelToTask("dynamics", simulation.engine, 2)
        simulation.AddModelToTask("dynamics", simulation.craft, 1)
        simulation.craft.addDynamicEffector(simulation.engine)
        earth = gravityEffector.GravBodyData()
        earth.planetName, earth.mu, earth.isCentralBody = "earth", 3.986004418e14, True
        simulation.craft.gravField.gravBodies = spacecraft.GravBodyVector([earth])
        simulation.craft.hub.mHub = 750.0
        simulation.craft.hub.r_CN_NInit = list(self.initial_position)
        simulation.craft.hub.v_CN_NInit = list(self.initial_velocity)
        simulation.InitializeSimulation()
        self.position, self.velocity = self.initial_position, self.initial_velocity

    def step(self, t: float, h: float) -> None:
        self.simulation.engine.extForce_N = [[number] for number in self.force]
        self.simulation.ConfigureStopTime(macros.sec2nano(t + h))
        self.simulation.ExecuteSimulation()
        state = self.simulation.craft.scStateOutMsg.read()
        self.position, self.velocity = state.r_CN_N, state.v_CN_N
