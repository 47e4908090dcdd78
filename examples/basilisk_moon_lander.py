"""The lander of the system lunar_landing, simulated by Basilisk (AVS Lab, University of Colorado)."""

import math

from Basilisk.simulation import extForceTorque, fuelTank, gravityEffector, spacecraft
from Basilisk.utilities import SimulationBaseClass, macros

from perilune import Block, ExternalState, Input, Output, Parameter, State, Vector3, cross, deg, dot, norm, vector

STANDARD_GRAVITY = 9.80665  # m/s2
SITE = "landing site"


def column(along: Vector3) -> list[list[float]]:
    """Return a vector as Basilisk takes it."""
    return [[along.x], [along.y], [along.z]]


class Lander:
    """A Basilisk simulation: a hub with a tank at its centre of mass, attracted by a point mass."""

    def __init__(self, block: "BasiliskMoonLander") -> None:
        self.simulation = SimulationBaseClass.SimBaseClass()
        self.step = macros.sec2nano(block.internal_step)
        self.steps = 0
        process = self.simulation.CreateNewProcess("process")
        process.addTask(self.simulation.CreateNewTask("dynamics", self.step))
        self.craft = spacecraft.Spacecraft()
        self.craft.hub.mHub = block.dry_mass
        self.centre = vector(0.0, 0.0, block.moon_radius)  # the site, from the Moon's centre
        self.craft.hub.r_CN_NInit = column(block.initial_position + self.centre)
        self.craft.hub.v_CN_NInit = column(block.initial_velocity)
        moon = gravityEffector.GravBodyData()
        moon.planetName, moon.mu, moon.isCentralBody = "moon", block.gravitational_parameter, True
        self.craft.gravField.gravBodies = spacecraft.GravBodyVector([moon])
        self.tank, self.tank_model = fuelTank.FuelTank(), fuelTank.FuelTankModelConstantVolume()
        self.tank_model.propMassInit = block.initial_mass - block.dry_mass
        self.tank.setTankModel(self.tank_model)
        self.craft.addStateEffector(self.tank)
        self.engine = extForceTorque.ExtForceTorque()
        self.craft.addDynamicEffector(self.engine)
        for model, priority in ((self.engine, 3), (self.tank, 2), (self.craft, 1)):
            self.simulation.AddModelToTask("dynamics", model, priority)
        self.simulation.InitializeSimulation()
        self.simulation.ConfigureStopTime(0)
        self.simulation.ExecuteSimulation()
        self.propellant = self.craft.dynManager.getStateObject(self.tank.getNameOfMassState())

    def advance(self, force: Vector3, flow: float) -> None:
        """Step once under a constant force (N) and flow of propellant (kg/s)."""
        self.engine.extForce_N = column(force)
        self.tank.setFuelLeakRate(flow)
        self.steps += 1
        self.simulation.ConfigureStopTime(self.steps * self.step)
        self.simulation.ExecuteSimulation()


class BasiliskMoonLander(Block):
    """Point-mass lander over a spherical Moon: motion and mass by Basilisk, lags of engine and attitude in this block.

    Basilisk integrates by Runge-Kutta of fourth order in steps of internal_step, with the mean force and flow of each
    step. Thrust follows its command, which is 0 from command_time + burn_duration on, with a first-order lag. The
    attitude follows d + d' (t - command_time) at angle/direction_response, no faster than slew_rate_limit. The
    motion ends at altitude 0. Frame: landing site (x north, y west, z up).
    """

    python_only = True
    requires = ("Basilisk",)

    initial_position = Parameter([266731.0, 0.0, -2233.0], unit="m", frame=SITE, description="initial position")
    initial_velocity = Parameter([-1676.0, 0.0, 208.0], unit="m/s", frame=SITE, description="initial velocity")
    initial_mass = Parameter(940.0, unit="kg", minimum=1e-3, description="initial mass")
    dry_mass = Parameter(100.0, unit="kg", minimum=1e-3, description="mass without propellant")
    specific_impulse = Parameter(319.0, unit="s", minimum=1e-3, description="specific impulse of the engine")
    thrust_lag = Parameter(0.1, unit="s", minimum=0.0, description="time constant of the thrust; 0: none")
    direction_response = Parameter(0.5, unit="s", minimum=1e-3, description="time constant of the attitude")
    slew_rate_limit = Parameter(
        deg(10.0), unit="rad/s", minimum=1e-6, description="largest angular rate of the attitude"
    )
    moon_radius = Parameter(1.7374e6, unit="m", minimum=1.0, description="radius of the sphere through the site")
    gravitational_parameter = Parameter(
        4.9028e12, unit="m3/s2", minimum=0.0, description="gravitational parameter of the Moon"
    )
    internal_step = Parameter(0.1, unit="s", minimum=1e-3, description="integration step of Basilisk")
    thrust = Input(0.0, unit="N", description="commanded thrust; below 0 counts as 0")
    thrust_direction = Input(
        [0.0, 0.0, 1.0], unit="1", frame=SITE, description="thrust direction at command_time, unit vector"
    )
    thrust_direction_rate = Input(
        [0.0, 0.0, 0.0], unit="1/s", frame=SITE, description="time derivative of the thrust direction"
    )
    command_time = Input(0.0, unit="s", description="reference time of direction and duration")
    burn_duration = Input(0.0, unit="s", description="burn duration from command_time on")
    position = Output([0.0, 0.0, 0.0], unit="m", frame=SITE, description="position")
    velocity = Output([0.0, 0.0, 0.0], unit="m/s", frame=SITE, description="velocity")
    speed = Output(0.0, unit="m/s", description="speed relative to the landing site")
    mass = Output(940.0, unit="kg", description="mass")
    altitude = Output(0.0, unit="m", description="altitude above the sphere of moon_radius")
    specific_force = Output(
        [0.0, 0.0, 0.0], unit="m/s2", frame=SITE, description="mean thrust over mass in the last step"
    )
    sensed_velocity = Output(
        [0.0, 0.0, 0.0], unit="m/s", frame=SITE, description="time integral of specific force since the start"
    )
    delivered_thrust = Output(0.0, unit="N", description="actual thrust of the engine")
    attitude = Output([0.0, 0.0, 1.0], unit="1", frame=SITE, description="actual thrust axis, unit vector")
    coast_time = Output(0.0, unit="s", description="time since the commanded burn ended; 0 during a burn")
    ground_contact = Output(False, description="true: ground contact")
    aligned = State(False, description="true: attitude aligned with the first command")
    lander = ExternalState("the Basilisk simulation")

    def initialize(self) -> None:
        if self.initial_mass <= self.dry_mass:
            raise ValueError(f"initial_mass {self.initial_mass} kg does not exceed dry_mass {self.dry_mass} kg")
        self.lander = Lander(self)
        self.read()

    def read(self) -> None:
        """Set outputs from Basilisk's states."""
        state = self.lander.craft.scStateOutMsg.read()
        from_centre = vector(*state.r_CN_N)
        self.position = from_centre - self.lander.centre
        self.velocity = state.v_CN_N
        self.sensed_velocity = state.TotalAccumDV_CN_N
        self.speed = norm(self.velocity)
        self.altitude = norm(from_centre) - self.moon_radius
        self.mass = self.dry_mass + float(self.lander.propellant.getState()[0][0])
        self.ground_contact = self.altitude <= 0.0

    def step(self, t: float, h: float) -> None:
        if not self.aligned:
            self.attitude = self.goal(t)
            self.aligned = True
        before = self.sensed_velocity
        steps = round(h / self.internal_step)
        if steps < 1 or abs(h / self.internal_step - steps) > 1e-6:
            raise ValueError(f"step of {h} s: not a multiple of internal_step, {self.internal_step} s")
        for k in range(steps):
            if not self.ground_contact:
                self.fly(t + k * self.internal_step, self.internal_step)
        self.specific_force = (self.sensed_velocity - before) / h
        self.coast_time = max(0.0, t + h - self.command_time - self.burn_duration)

    def fly(self, t: float, h: float) -> None:
        """Step Basilisk once, with the mean thrust and its mean direction."""
        burning = min(max(self.command_time + self.burn_duration - t, 0.0), h)
        exhaust_velocity = STANDARD_GRAVITY * self.specific_impulse
        impulse = self.run_engine(max(self.thrust, 0.0), burning) + self.run_engine(0.0, h - burning)
        if impulse >= exhaust_velocity * (self.mass - self.dry_mass):  # more than the tank has
            impulse = self.delivered_thrust = 0.0
        first = self.attitude
        middle = self.turn(first, t, 0.5 * h)
        self.attitude = self.turn(middle, t + 0.5 * h, 0.5 * h)
        mean = (first + 4.0 * middle + self.attitude) / 6.0
        self.lander.advance(impulse / h * mean, impulse / h / exhaust_velocity)
        self.read()

    def run_engine(self, commanded: float, h: float) -> float:
        """Let thrust follow a command (N) for h (s); returns the impulse (N s)."""
        decay = math.exp(-h / self.thrust_lag) if self.thrust_lag > 0.0 else 0.0
        excess = self.delivered_thrust - commanded
        self.delivered_thrust = commanded + decay * excess
        return commanded * h + excess * self.thrust_lag * (1.0 - decay)

    def goal(self, t: float) -> Vector3:
        """Return the commanded direction at a time (s); where there is no command, the attitude as it is."""
        along = self.thrust_direction + (t - self.command_time) * self.thrust_direction_rate
        size = norm(along)
        return along / size if size > 0.0 else self.attitude

    def turn(self, axis: Vector3, t: float, h: float) -> Vector3:
        """Return the thrust axis after h (s) of turning towards the command in the middle of them, taken at rest
        there."""
        goal = self.goal(t + 0.5 * h)
        normal = cross(axis, goal)
        angle = math.atan2(norm(normal), dot(axis, goal))
        if norm(normal) < 1e-12:
            return axis
        limited = min(max(angle / self.slew_rate_limit - self.direction_response, 0.0), h)
        remaining = angle - self.slew_rate_limit * limited
        rotation = angle - remaining * math.exp(-(h - limited) / self.direction_response)
        return math.cos(rotation) * axis + math.sin(rotation) * cross(normal / norm(normal), axis)
