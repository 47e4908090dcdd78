"""A rendezvous in a circular orbit: relative motion, range and bearing sensor, filter, approach law.

All vectors are in axes at the target (LVLH): x up, y along its velocity, z normal to its orbit.
"""

from math import sqrt

from perilune import (
    Block, Field, Input, Matrix, Output, Parameter, Record, State, Vector3, atan2, block, cos, identity, matrix, norm,
    runge_kutta_4, sin, vector, zeros,
)  # fmt: skip
from perilune.fmus_src.kernel.matrices import inverse
from perilune.fmus_src.mathlib.rng import normals, seed_streams

BEHIND, ZERO = [0.0, -1000.0, 0.0], [0.0, 0.0, 0.0]
POSITION, VELOCITY = block(0, 3), block(3, 3)
MEASURED = ("range", "azimuth", "elevation")


def drift(n: float, position: Vector3, velocity: Vector3) -> Vector3:
    """Return the acceleration (m/s2) without thrust for mean motion n (rad/s): Clohessy and Wiltshire 1960."""
    return vector(3.0 * n * n * position.x + 2.0 * n * velocity.y, -2.0 * n * velocity.x, -n * n * position.z)


def transition(n: float, t: float) -> Matrix:
    """Return the transition matrix of position and velocity over t (s) without thrust, in closed form."""
    s = sin(n * t)
    c = cos(n * t)
    return matrix(
        [4.0 - 3.0 * c, 0.0, 0.0, s / n, 2.0 * (1.0 - c) / n, 0.0],
        [6.0 * (s - n * t), 1.0, 0.0, -2.0 * (1.0 - c) / n, 4.0 * s / n - 3.0 * t, 0.0],
        [0.0, 0.0, c, 0.0, 0.0, s / n],
        [3.0 * n * s, 0.0, 0.0, c, 2.0 * s, 0.0],
        [-6.0 * n * (1.0 - c), 0.0, 0.0, -2.0 * s, 4.0 * c - 3.0, 0.0],
        [0.0, 0.0, -n * s, 0.0, 0.0, c],
    )


class Motion(Record):
    """The motion of the chaser relative to the target."""

    position = Field(Vector3, unit="m", frame="LVLH", description="from the target to the chaser")
    velocity = Field(Vector3, unit="m/s", frame="LVLH", description="in these axes")


class RelativeMotion(Block):
    """A chaser near a target in a circular orbit. Assumes a distance far below the orbit's radius."""

    mean_motion = Parameter(0.0011, unit="rad/s", minimum=1e-9, description="of the target")
    mass = Parameter(100.0, unit="kg", minimum=1e-3, description="of the chaser, constant")
    initial_position = Parameter(BEHIND, unit="m", frame="LVLH", description="from the target to the chaser")
    initial_velocity = Parameter(ZERO, unit="m/s", frame="LVLH", description="in these axes")
    force = Input(ZERO, unit="N", frame="LVLH", description="of the jets, held over a step")
    position = Output(BEHIND, unit="m", frame="LVLH", description="from the target to the chaser")
    range = Output(1000.0, unit="m", description="distance from the target")
    speed = Output(0.0, unit="m/s", description="magnitude of the velocity")
    delta_v = Output(0.0, unit="m/s", description="spent by the jets")
    state = State(Motion)

    def set_outputs(self) -> None:
        self.position = self.state.position
        self.range = norm(self.state.position)
        self.speed = norm(self.state.velocity)

    def initialize(self) -> None:
        self.state = Motion(position=self.initial_position, velocity=self.initial_velocity)
        self.set_outputs()

    def derivatives(self, t: float, s: Motion, thrust: Vector3) -> Motion:
        """Return the rates under an acceleration by thrust (m/s2)."""
        return Motion(position=s.velocity, velocity=drift(self.mean_motion, s.position, s.velocity) + thrust)

    def step(self, t: float, h: float) -> None:
        thrust = self.force / self.mass
        self.state = runge_kutta_4(self.derivatives, t, self.state, h, thrust)
        self.delta_v = self.delta_v + h * norm(thrust)
        self.set_outputs()


class RangeBearing(Block):
    """Distance and direction of the target as measured by the chaser, with normal errors."""

    range_sigma = Parameter(0.1, unit="m", minimum=0.0, description="error of the range, 1 sigma")
    angle_sigma = Parameter(1e-3, unit="rad", minimum=0.0, description="error of both angles, 1 sigma")
    sample_period = Parameter(1.0, unit="s", minimum=0.1, description="between samples")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    position = Input(BEHIND, unit="m", frame="LVLH", description="true, from the target to the chaser")
    range = Output(1000.0, unit="m", direct=True, description="measured")
    azimuth = Output(0.0, unit="rad", direct=True, description="measured, of the target, from y towards x")
    elevation = Output(0.0, unit="rad", direct=True, description="measured, of the target, from the xy plane towards z")
    generator = State([0.0] * 6, frozen=True, description="random number generator")

    def measure(self) -> None:
        error = normals(self.generator)
        x, y, z = -self.position
        self.range = norm(self.position) + self.range_sigma * error.x
        self.azimuth = atan2(x, y) + self.angle_sigma * error.y
        self.elevation = atan2(z, sqrt(x * x + y * y)) + self.angle_sigma * error.z

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure()

    def step(self, t: float, h: float) -> None:
        self.measure()


class RelativeNavigation(Block):
    """Extended Kalman filter of position and velocity from range and bearings.

    Source: Bar-Shalom, Li and Kirubarajan 2001, section 10.3. Assumes a chaser behind the target, where no angle jumps.
    """

    mean_motion = Parameter(0.0011, unit="rad/s", minimum=1e-9, description="of the target")
    mass = Parameter(100.0, unit="kg", minimum=1e-3, description="of the chaser, as known on board")
    first_position = Parameter(BEHIND, unit="m", frame="LVLH", description="expected at the start, at rest")
    position_sigma = Parameter(50.0, unit="m", minimum=1e-6, description="error of first_position, 1 sigma per axis")
    velocity_sigma = Parameter(0.1, unit="m/s", minimum=1e-6, description="velocity at the start, 1 sigma per axis")
    process_noise = Parameter(1e-7, unit="m2/s3", minimum=0.0, description="density of white acceleration noise")
    range_sigma = Parameter(0.1, unit="m", minimum=1e-6, description="error of the range, 1 sigma")
    angle_sigma = Parameter(1e-3, unit="rad", minimum=1e-9, description="error of both angles, 1 sigma")
    sample_period = Parameter(1.0, unit="s", minimum=0.1, description="cycle, that of the sensor")
    range = Input(1000.0, unit="m", description="measured")
    azimuth = Input(0.0, unit="rad", description="measured")
    elevation = Input(0.0, unit="rad", description="measured")
    force = Input(ZERO, unit="N", frame="LVLH", description="of the jets over the cycle just past")
    position = Output(BEHIND, unit="m", frame="LVLH", direct=MEASURED, description="estimated")
    velocity = Output(ZERO, unit="m/s", frame="LVLH", direct=MEASURED, description="estimated")
    status = Output(0, minimum=0, maximum=1, direct=MEASURED, description="0 good, 1 sample left out")
    estimate = State(zeros(6, 1), description="position (m) and velocity (m/s)")
    covariance = State(zeros(6, 6), frozen=True, description="of the estimate, SI")

    def initialize(self) -> None:
        self.estimate[POSITION, 0] = self.first_position
        self.covariance[POSITION, POSITION] = self.position_sigma * self.position_sigma * identity(3)
        self.covariance[VELOCITY, VELOCITY] = self.velocity_sigma * self.velocity_sigma * identity(3)
        self.correct()

    def predict(self, h: float) -> None:
        """Propagate estimate and covariance by h (s)."""
        f = transition(self.mean_motion, h)
        q = zeros(6, 6)
        q[POSITION, POSITION] = self.process_noise * h * h * h / 3.0 * identity(3)
        q[POSITION, VELOCITY] = self.process_noise * h * h / 2.0 * identity(3)
        q[VELOCITY, POSITION] = self.process_noise * h * h / 2.0 * identity(3)
        q[VELOCITY, VELOCITY] = self.process_noise * h * identity(3)
        gained = h / self.mass * self.force
        self.estimate = f @ self.estimate
        self.estimate[POSITION, 0] = self.estimate[POSITION, 0] + 0.5 * h * gained
        self.estimate[VELOCITY, 0] = self.estimate[VELOCITY, 0] + gained
        self.covariance = f @ self.covariance @ f.T + q

    def correct(self) -> None:
        """Update the estimate with the sample, in Joseph's form."""
        p = self.estimate[POSITION, 0]
        distance = norm(p)
        across = sqrt(p.x * p.x + p.y * p.y)
        h = zeros(3, 6)
        h[0, POSITION] = p / distance
        h[1, POSITION] = vector(p.y, -p.x, 0.0) / (across * across)
        h[2, POSITION] = vector(p.x * p.z / across, p.y * p.z / across, -across) / (distance * distance)
        r = zeros(3, 3)
        r[0, 0] = self.range_sigma * self.range_sigma
        r[1, 1] = self.angle_sigma * self.angle_sigma
        r[2, 2] = r[1, 1]
        inverted, regular = inverse(h @ self.covariance @ h.T + r)
        self.status = 1
        if regular:
            self.status = 0
            gain = self.covariance @ h.T @ inverted
            complement = identity(6) - gain @ h
            azimuth = self.azimuth - atan2(-p.x, -p.y)
            elevation = self.elevation - atan2(-p.z, across)
            self.estimate = self.estimate + gain @ matrix([self.range - distance], [azimuth], [elevation])
            self.covariance = complement @ self.covariance @ complement.T + gain @ r @ gain.T
        self.position = self.estimate[POSITION, 0]
        self.velocity = self.estimate[VELOCITY, 0]

    def step(self, t: float, h: float) -> None:
        self.predict(h)
        self.correct()


class ApproachLaw(Block):
    """Force towards a hold point: speed proportional to the distance up to a limit, drift compensated."""

    mean_motion = Parameter(0.0011, unit="rad/s", minimum=1e-9, description="of the target")
    mass = Parameter(100.0, unit="kg", minimum=1e-3, description="of the chaser, as known on board")
    hold_point = Parameter([0.0, -20.0, 0.0], unit="m", frame="LVLH", description="where to stop")
    largest_speed = Parameter(1.0, unit="m/s", minimum=0.0, description="of the approach")
    approach_rate = Parameter(0.01, unit="1/s", minimum=0.0, description="speed over distance")
    time_constant = Parameter(20.0, unit="s", minimum=1e-3, description="in which an error of the velocity decays")
    sample_period = Parameter(1.0, unit="s", minimum=0.1, description="cycle")
    position = Input(BEHIND, unit="m", frame="LVLH", description="estimated")
    velocity = Input(ZERO, unit="m/s", frame="LVLH", description="estimated")
    force_command = Output(ZERO, unit="N", frame="LVLH", direct=True, description="for the jets, until the next cycle")
    command_count = Output(0, direct=True, description="commands so far")

    def command(self) -> None:
        error = self.hold_point - self.position
        rate = self.approach_rate
        if rate * norm(error) > self.largest_speed:
            rate = self.largest_speed / norm(error)
        acceleration = (rate * error - self.velocity) / self.time_constant
        self.force_command = self.mass * (acceleration - drift(self.mean_motion, self.position, self.velocity))
        self.command_count = self.command_count + 1

    def initialize(self) -> None:
        self.command()

    def step(self, t: float, h: float) -> None:
        self.command()
