"""Lander over the Moon; commanded angular accelerations turn its thrust axis."""

from ..block import Parameter
from ..interfaces.ports import landing
from ..kernel.functions import atan2
from ..mathlib.actuators.lagged_thrust import lagged_thrust
from ..mathlib.attitude.thrust_axis import AxisState, turn_axis
from ..mathlib.lunar.gravity import STANDARD_GRAVITY, altitude_of, central_gravity, vertical_at
from ..mathlib.vectors import Vector3, across, clip, cross, dot, norm, vector
from ..units import deg
from .moon_lander import MoonLander

HALVINGS = 60  # of a step, to find the time at which the tank is empty


class AttitudeMoonLander(MoonLander):
    """Point mass with one engine along a thrust axis that has an angular rate; roll about the axis is not modelled.

    The axis d rotates with the rate ω, perpendicular to it, under the commanded angular acceleration α:

        d' = ω × d    ω' = α - (α · d) d

    α is limited to maximum_angular_acceleration and constant over the communication step. Thrust is thrust_factor times
    the command, with lag and end of burn as in `moon_lander`; it is 0 once the mass has fallen to dry_mass. Gravity is
    central, or uniform along -z if uniform_gravity is not 0; altitude is then z. When the altitude is 0 or less at the
    end of an internal step, position and velocity are moved back to altitude 0 with the step's mean acceleration and
    stay constant from then on. An initial attitude of length 0 is replaced by the z axis.

    Attitude is integrated by the fourth-order Runge-Kutta method, with two steps in each internal step.

    See docs/systems/hover_transfer.md.
    """

    initial_position = MoonLander.initial_position.with_start([0.0, 0.0, 2400.0])
    initial_velocity = MoonLander.initial_velocity.with_start([0.0, 0.0, 0.0])
    initial_mass = MoonLander.initial_mass.with_start(600.0)
    specific_impulse = MoonLander.specific_impulse.with_start(300.0)
    internal_step = MoonLander.internal_step.with_start(0.05)
    initial_attitude = landing.DIRECTION.parameter(description="initial thrust axis, normalised by the block")
    initial_angular_rate = landing.ANGULAR_RATE.parameter(
        description="initial angular rate of the thrust axis; its component along the axis is ignored"
    )
    thrust_factor = Parameter(
        1.0, unit="1", minimum=0.0, description="ratio of actual to commanded thrust of the engine"
    )
    uniform_gravity = landing.UNIFORM_GRAVITY.parameter()
    dry_mass = Parameter(1.0, unit="kg", minimum=1e-3, description="mass of the lander without propellant")
    probe_length = landing.PROBE_LENGTH.parameter()
    maximum_angular_acceleration = Parameter(
        deg(1.0),
        unit="rad/s2",
        minimum=0.0,
        description="largest angular acceleration produced by the attitude jets; 0: no limit",
    )
    angular_acceleration = landing.ANGULAR_ACCELERATION.input("commanded angular acceleration of the thrust axis")
    mass = MoonLander.mass.with_start(600.0)
    angular_rate = landing.ANGULAR_RATE.output("angular rate of the thrust axis, without component along the axis")
    tilt = landing.TILT.output()
    vertical_speed = landing.VERTICAL_SPEED.output()
    horizontal_speed = landing.HORIZONTAL_SPEED.output()
    probe_contact = landing.PROBE_CONTACT.output()

    def initialize(self) -> None:
        self.initialise_motion()
        self.divide(0.0)
        length = norm(self.initial_attitude)
        if length > 0.0:
            self.attitude = self.initial_attitude / length
        self.angular_rate = across(self.initial_angular_rate, self.attitude)
        self.touch_probe()
        self.set_tilt_and_speeds()

    def height(self, position: Vector3) -> float:
        """Return the altitude (m) at a position (m)."""
        if self.uniform_gravity > 0.0:
            return position.z
        return altitude_of(position, self.moon_radius)

    def gravity(self, position: Vector3) -> Vector3:
        """Return the gravity (m/s2) at a position (m)."""
        if self.uniform_gravity > 0.0:
            return vector(0.0, 0.0, -self.uniform_gravity)
        return central_gravity(position, self.moon_radius, self.gravitational_parameter)

    def vertical(self) -> Vector3:
        """Return the upward local vertical as a unit vector."""
        if self.uniform_gravity > 0.0:
            return vector(0.0, 0.0, 1.0)
        return vertical_at(self.position, self.moon_radius)

    def turn(self, t: float, h: float) -> None:
        """Advance attitude and angular rate by h (s)."""
        s = AxisState(axis=self.attitude, rate=self.angular_rate)
        s = turn_axis(s, self.angular_acceleration, self.maximum_angular_acceleration, h)
        self.attitude = s.axis
        self.angular_rate = s.rate

    def impulse(self, h: float, commanded: float) -> float:
        """Return the impulse (N s) over h (s) under a commanded thrust (N)."""
        thrust = lagged_thrust(self.delivered_thrust, commanded, self.thrust_lag, h)
        return thrust.impulse

    def thrusting_time(self, h: float, commanded: float) -> float:
        """Return the time (s), at most h, for which the propellant lasts under a commanded thrust (N)."""
        allowed = (self.mass - self.dry_mass) * STANDARD_GRAVITY * self.specific_impulse
        if not self.impulse(h, commanded) > allowed:
            return h
        low = 0.0
        high = h
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if self.impulse(middle, commanded) > allowed:
                high = middle
            else:
                low = middle
        return low

    def move(self, t: float, h: float, commanded: float) -> Vector3:
        """Advance the motion by h (s) under a constant commanded thrust (N); return the velocity gained (m/s)."""
        lasting = 0.0
        gained = vector(0.0, 0.0, 0.0)
        before = self.velocity
        if self.mass > self.dry_mass:
            lasting = self.thrusting_time(h, commanded)
            gained = self.advance(t, lasting, commanded)
        if lasting < h:
            if lasting > 0.0:
                self.mass = self.dry_mass
            self.delivered_thrust = 0.0
            pushed = self.advance(t + lasting, h - lasting, 0.0)
            gained = gained + pushed
        self.touch()
        if self.ground_contact:
            self.go_back(h, (self.velocity - before) / h)
        self.touch_probe()
        return gained

    def go_back(self, h: float, acceleration: Vector3) -> None:
        """Move the vehicle from below the ground back to altitude 0, by at most h (s), with an acceleration (m/s2)."""
        below = self.position
        last = self.velocity
        back = 0.0
        for _ in range(3):  # Newton steps; the ground is nearly flat over an internal step
            sinking = -dot(self.velocity, self.vertical())
            if sinking > 0.0:
                back = clip(back - self.altitude / sinking, 0.0, h)
                self.velocity = last - back * acceleration
                self.position = below - back * (last - 0.5 * back * acceleration)
                self.altitude = self.height(self.position)

    def touch_probe(self) -> None:
        """Latch the first contact of the probe with the ground."""
        if self.altitude <= self.probe_length:
            self.probe_contact = True

    def set_tilt_and_speeds(self) -> None:
        """Set tilt and the speeds along and across the local vertical."""
        up = self.vertical()
        self.tilt = atan2(norm(cross(self.attitude, up)), dot(self.attitude, up))
        self.vertical_speed = dot(self.velocity, up)
        self.horizontal_speed = norm(self.velocity - self.vertical_speed * up)

    def step(self, t: float, h: float) -> None:
        commanded = self.thrust_factor * self.thrust
        if commanded < 0.0:
            commanded = 0.0
        self.advance_motion(t, h, commanded)
        self.set_tilt_and_speeds()
