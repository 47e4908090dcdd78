"""A lander above its site, and its altitude control."""

from perilune import Block, Input, Output, Parameter


class VerticalLander(Block):
    """A point mass above flat ground: mass h'' = thrust - mass gravity, exact for constant thrust over a step."""

    mass = Parameter(500.0, unit="kg", minimum=1.0, description="of the lander, constant")
    gravity = Parameter(1.62, unit="m/s2", minimum=0.0, description="downwards, constant")
    initial_altitude = Parameter(1600.0, unit="m", description="at the start")
    initial_velocity = Parameter(0.0, unit="m/s", description="at the start, upwards")
    thrust = Input(0.0, unit="N", description="upwards")
    altitude = Output(1600.0, unit="m", description="above the site")
    velocity = Output(0.0, unit="m/s", description="upwards")
    speed = Output(0.0, unit="m/s", description="magnitude of the velocity")

    def initialize(self) -> None:
        self.altitude = self.initial_altitude
        self.velocity = self.initial_velocity
        self.speed = abs(self.velocity)

    def step(self, t: float, h: float) -> None:
        acceleration = self.thrust / self.mass - self.gravity
        self.altitude = self.altitude + h * self.velocity + 0.5 * h * h * acceleration
        self.velocity = self.velocity + h * acceleration
        self.speed = abs(self.velocity)


class AltitudeControl(Block):
    """Thrust as the sum of the weight, and of a spring and a damper towards the target altitude."""

    mass = Parameter(500.0, unit="kg", minimum=1.0, description="as known on board")
    gravity = Parameter(1.62, unit="m/s2", minimum=0.0, description="as known on board")
    target_altitude = Parameter(1500.0, unit="m", description="at the end")
    natural_frequency = Parameter(0.08, unit="rad/s", minimum=0.0, description="of the spring")
    damping = Parameter(0.9, unit="1", minimum=0.0, description="fraction of critical damping")
    sample_period = Parameter(0.2, unit="s", minimum=1e-3, description="cycle")
    altitude = Input(1600.0, unit="m", description="measured")
    velocity = Input(0.0, unit="m/s", description="measured, upwards")
    thrust = Output(0.0, unit="N", direct=True, description="commanded until the next cycle")

    def command(self) -> None:
        error = self.altitude - self.target_altitude
        spring = self.natural_frequency * self.natural_frequency * error
        damper = 2.0 * self.damping * self.natural_frequency * self.velocity
        self.thrust = self.mass * (self.gravity - spring - damper)

    def initialize(self) -> None:
        self.command()

    def step(self, t: float, h: float) -> None:
        self.command()
