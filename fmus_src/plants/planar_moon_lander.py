"""A lander in a plane through the centre of a round Moon."""

import math

from ..block import Block, Input, Output, Parameter, State
from ..kernel.functions import atan2, cos, sin
from ..mathlib.gravity import STANDARD_GRAVITY
from ..mathlib.vectors import Vector4, vector


class PlanarMoonLander(Block):
    """Point mass in a plane over a round Moon; thrust follows the commanded angle at once.

    Angles are measured from the local vertical, positive where the central angle grows. Published
    equations, with V the speed, th the path angle, u the thrust angle and W thrust over mass:

        V' = W cos(u - th) - g cos th      th' = (W sin(u - th) + g sin th)/V      h' = V cos th
        central angle' = V sin th/R        mass' = -thrust/(standard gravity * specific_impulse)

    Integrated in vertical and horizontal velocity, where they read vz' = W cos u - g, vx' = W sin u
    and are regular at V = 0. ``curvature`` adds what they leave out, vx^2/R and -vz vx/R. Gravity
    falls with the square of R = moon_radius + altitude. Fourth-order Runge-Kutta with a step of its
    own. On the ground the motion stops and is kept. Thrust ends where the mass would.
    Source: Diveev, Pupkov and Sofronova 2013; see docs/systems/lunar_descent_2d.md.
    Assumes an attitude and an engine without lag, and a Moon without rotation.
    """

    initial_speed = Parameter(1689.0, unit="m/s", minimum=0.0, description="speed at the start")
    initial_path_angle = Parameter(-1.6, unit="rad", description="path angle at the start")
    initial_altitude = Parameter(18148.0, unit="m", description="altitude at the start")
    initial_central_angle = Parameter(0.0, unit="rad", description="angle flown over the Moon at the start")
    initial_mass = Parameter(940.0, unit="kg", minimum=1e-3, description="mass at the start")
    specific_impulse = Parameter(319.0, unit="s", minimum=1e-3, description="of the engine")
    surface_gravity = Parameter(1.623, unit="m/s2", minimum=0.0, description="gravity at altitude 0")
    moon_radius = Parameter(1.7384e6, unit="m", minimum=1.0, description="of the Moon, at altitude 0")
    curvature = Parameter(False, description="the vertical turns with the vehicle; false: as published")
    thrust_factor = Parameter(1.0, unit="1", minimum=0.0, description="thrust given over thrust commanded")
    internal_step = Parameter(0.1, unit="s", minimum=1e-4, description="longest integration step")
    thrust_angle = Input(0.0, unit="rad", description="from the local vertical to the thrust")
    thrust = Input(0.0, unit="N", description="commanded thrust")
    altitude = Output(18148.0, unit="m", description="altitude")
    path_angle = Output(-1.6, unit="rad", description="from the local vertical to the velocity, unwrapped")
    speed = Output(1689.0, unit="m/s", description="speed")
    central_angle = Output(0.0, unit="rad", description="angle flown over the Moon")
    mass = Output(940.0, unit="kg", description="mass")
    ground_contact = Output(False, description="the ground was reached")
    motion = State([0.0] * 4, description="vertical and horizontal velocity (m/s), altitude (m), central angle (rad)")

    def initialize(self) -> None:
        self.motion = vector(
            self.initial_speed * cos(self.initial_path_angle),
            self.initial_speed * sin(self.initial_path_angle),
            self.initial_altitude,
            self.initial_central_angle,
        )
        self.mass = self.initial_mass
        self.path_angle = self.initial_path_angle
        self.publish()

    def slope(self, motion: Vector4, acceleration: float) -> Vector4:
        """Time derivative of motion under thrust over mass ``acceleration`` (m/s2)."""
        vertical, horizontal, altitude, _ = motion
        radius = self.moon_radius + altitude
        ratio = self.moon_radius / radius
        turning = horizontal / radius
        climb = acceleration * cos(self.thrust_angle) - self.surface_gravity * ratio * ratio
        push = acceleration * sin(self.thrust_angle)
        if self.curvature:
            climb = climb + horizontal * turning
            push = push - vertical * turning
        return vector(climb, push, vertical, turning)

    def move(self, h: float) -> None:
        """Motion and mass h (s) later."""
        force = self.thrust_factor * self.thrust
        flow = force / (STANDARD_GRAVITY * self.specific_impulse)
        if self.mass <= flow * h:
            force = 0.0
            flow = 0.0
        middle = force / (self.mass - 0.5 * h * flow)
        k1 = self.slope(self.motion, force / self.mass)
        k2 = self.slope(self.motion + 0.5 * h * k1, middle)
        k3 = self.slope(self.motion + 0.5 * h * k2, middle)
        k4 = self.slope(self.motion + h * k3, force / (self.mass - h * flow))
        self.motion = self.motion + h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
        self.mass = self.mass - h * flow

    def publish(self) -> None:
        """Outputs of the motion; the path angle is the one nearest to the last, and stays where speed is 0."""
        vertical, horizontal, self.altitude, self.central_angle = self.motion
        self.speed = math.sqrt(vertical * vertical + horizontal * horizontal)
        if self.speed > 0.0:
            angle = atan2(horizontal, vertical)
            turns = math.floor((self.path_angle - angle) / math.tau + 0.5)
            self.path_angle = angle + math.tau * float(turns)
        self.ground_contact = self.altitude <= 0.0

    def step(self, t: float, h: float) -> None:
        pieces = int(h / self.internal_step - 1e-9) + 1
        for _ in range(pieces):
            if not self.ground_contact:
                self.move(h / pieces)
                self.publish()
