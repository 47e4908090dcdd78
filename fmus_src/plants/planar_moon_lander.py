"""Lander in a plane through the centre of a spherical Moon."""

import math

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import landing, sampling
from ..kernel.functions import atan2, cos, sin
from ..kernel.integrators import count_steps, runge_kutta_4
from ..kernel.records import Field, Record
from ..mathlib.lunar.gravity import STANDARD_GRAVITY


class PlanarMotion(Record):
    """Motion over a spherical Moon, with vertical and horizontal velocity components."""

    vertical_speed = Field(
        unit="m/s", description="component of the velocity along the local vertical, positive upwards"
    )
    horizontal_speed = Field(unit="m/s", description="component of the velocity along increasing central angle")
    altitude = Field(unit="m", description="altitude above the sphere of moon_radius")
    central_angle = Field(unit="rad", description="angle at the Moon's centre, positive in the direction of flight")


class PlanarMoonLander(Block):
    """Point mass in a plane over a round Moon, with thrust along the commanded angle.

    With speed V, path angle θ and thrust angle u from the local vertical, thrust over mass W and R = moon_radius + h:

        V' = W cos(u - θ) - g cos θ    θ' = (W sin(u - θ) + g sin θ)/V    h' = V cos θ
        φ' = V sin θ/R    m' = -F/(g_0 I_sp)    g = g_s (R_0/R)^2

    The equations are integrated for the vertical and horizontal velocities, for which they are regular at V = 0:

        v_z' = W cos u - g    v_x' = W sin u

    `curvature` adds v_x^2/R and -v_z v_x/R, the rotation of the local vertical, which the published equations omit. On
    the ground the motion is frozen. Thrust ends when no mass is left. The integration uses the fourth-order Runge-Kutta
    method in fixed steps.

    Assumes attitude and engine without lag, and a Moon without rotation.

    Source: Diveev, Pupkov and Sofronova 2013. See docs/systems/lunar_descent_2d.md.
    """

    initial_speed = Parameter(1689.0, unit="m/s", minimum=0.0, description="initial speed of the lander")
    initial_path_angle = Parameter(
        -1.6, unit="rad", description="initial angle from the local vertical to the velocity"
    )
    initial_altitude = Parameter(18148.0, unit="m", description="initial altitude above the sphere of moon_radius")
    initial_central_angle = Parameter(
        0.0, unit="rad", description="initial angle at the Moon's centre, positive in the direction of flight"
    )
    initial_mass = landing.INITIAL_MASS.parameter()
    specific_impulse = landing.SPECIFIC_IMPULSE.parameter()
    surface_gravity = Parameter(1.623, unit="m/s2", minimum=0.0, description="gravitational acceleration at altitude 0")
    moon_radius = landing.MOON_RADIUS.parameter(1.7384e6, "radius of the Moon at altitude 0")
    curvature = Parameter(
        False,
        description=(
            "true: rotation of the local vertical along the path included; false: omitted, as in the "
            "published equations"
        ),
    )
    thrust_factor = Parameter(
        1.0, unit="1", minimum=0.0, description="ratio of actual to commanded thrust of the engine"
    )
    internal_step = sampling.INTERNAL_STEP.parameter()
    thrust_angle = landing.THRUST_ANGLE.input()
    thrust = landing.THRUST.input()
    altitude = landing.ALTITUDE.output("altitude of the lander above the sphere of moon_radius", start=18148.0)
    path_angle = Output(-1.6, unit="rad", description="angle from the local vertical to the velocity, unwrapped")
    speed = Output(1689.0, unit="m/s", description="speed of the lander")
    central_angle = Output(
        0.0, unit="rad", description="angle at the Moon's centre, positive in the direction of flight"
    )
    mass = landing.MASS.output(start=940.0)
    ground_contact = landing.GROUND_CONTACT.output()
    load_factor = Output(
        0.0, unit="1", description="thrust over weight on the Earth's surface, at the end of the last step"
    )
    motion = State(PlanarMotion)

    def initialize(self) -> None:
        self.motion = PlanarMotion(
            vertical_speed=self.initial_speed * cos(self.initial_path_angle),
            horizontal_speed=self.initial_speed * sin(self.initial_path_angle),
            altitude=self.initial_altitude,
            central_angle=self.initial_central_angle,
        )
        self.mass = self.initial_mass
        self.path_angle = self.initial_path_angle
        self.publish()

    def derivatives(self, t: float, s: PlanarMotion, force: float, flow: float) -> PlanarMotion:
        """Return the time derivative of the motion under a thrust (N) and mass flow (kg/s) that started t (s) ago."""
        acceleration = force / (self.mass - t * flow)
        radius = self.moon_radius + s.altitude
        ratio = self.moon_radius / radius
        turning = s.horizontal_speed / radius
        climb = acceleration * cos(self.thrust_angle) - self.surface_gravity * ratio * ratio
        forward = acceleration * sin(self.thrust_angle)
        if self.curvature:
            climb = climb + s.horizontal_speed * turning
            forward = forward - s.vertical_speed * turning
        return PlanarMotion(
            vertical_speed=climb, horizontal_speed=forward, altitude=s.vertical_speed, central_angle=turning
        )

    def move(self, h: float) -> None:
        """Advance motion and mass by h (s)."""
        force = self.thrust_factor * self.thrust
        flow = force / (STANDARD_GRAVITY * self.specific_impulse)
        if self.mass <= flow * h:
            force = 0.0
            flow = 0.0
        self.motion = runge_kutta_4(self.derivatives, 0.0, self.motion, h, force, flow)
        self.mass = self.mass - h * flow
        self.load_factor = force / (STANDARD_GRAVITY * self.mass)

    def publish(self) -> None:
        """Set the outputs of the motion; the path angle is unwrapped, and keeps its last value at a speed of 0."""
        s = self.motion
        self.altitude = s.altitude
        self.central_angle = s.central_angle
        self.speed = math.sqrt(s.vertical_speed * s.vertical_speed + s.horizontal_speed * s.horizontal_speed)
        if self.speed > 0.0:
            angle = atan2(s.horizontal_speed, s.vertical_speed)
            turns = math.floor((self.path_angle - angle) / math.tau + 0.5)
            self.path_angle = angle + math.tau * float(turns)
        self.ground_contact = self.altitude <= 0.0

    def step(self, t: float, h: float) -> None:
        pieces = count_steps(h, self.internal_step)
        for _ in range(pieces):
            if not self.ground_contact:
                self.move(h / pieces)
                self.publish()
