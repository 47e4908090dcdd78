"""Sunlight, magnetic field and air at a spacecraft's position."""

import math

from ..block import Output, Outputs
from ..interfaces.ports import inertial, robot, sampling, space
from ..kernel.enumerations import Enumeration, member
from ..mathlib.attitude.quaternion import is_attitude, normalise, to_body
from ..mathlib.space.magnetic_field import in_validity
from ..mathlib.vectors import is_finite, norm
from ..models.space_model import SpaceModel


class EnvironmentStatus(Enumeration):
    """Validity of the outputs."""

    GOOD = member("good")
    OUTSIDE_YEARS = member("outside 2025 to 2030, magnetic field extrapolated")
    BELOW_AIR = member("below 100 km, air density of 100 km used")
    UNCHANGED = member("position or attitude not finite, or inside the body; outputs held")


class SpaceEnvironment(SpaceModel):
    """Sun, Moon, magnetic field, eclipse and air density at the present position and time.

    At the true position the block serves sensors. At an estimated position, with magnetic_degree 6, it serves as an
    on-board model; its field differs from the field of degree 13 by 221 nT and 0.31 deg (rms at 500 km). The plant does
    not use this block but evaluates its own models.

    Frames: inertial (GCRS axes, origin at the body's centre); body.

    Assumes straight light rays without travel time: no aberration, no refraction.

    See docs/systems/earth_pointing.md.
    """

    default_step = 0.25

    position = inertial.POSITION.input(
        "position of the spacecraft's centre of mass relative to the centre of the central body",
        start=[6878137.0, 0.0, 0.0],
    )
    quaternion = robot.QUATERNION.input("attitude quaternion from body to inertial, scalar first")
    environment = Outputs(space.SpaceEnvironment, direct=True)
    status = Output(EnvironmentStatus, direct=True)
    start_time = sampling.START_TIME.state()

    def initialize(self) -> None:
        self.fill()
        self.evaluate(self.start_time)

    def step(self, t: float, h: float) -> None:
        self.evaluate(t + h)

    def evaluate(self, t: float) -> None:
        """Set all outputs for t (s)."""
        r = self.position
        q = self.quaternion
        self.status = EnvironmentStatus.UNCHANGED
        if not (is_finite(r) and math.isfinite(q.w) and is_finite(q[1:4]) and is_attitude(q)):
            return
        self.locate(t)
        if not norm(r) > 0.0 or self.height(r) < 0.0:
            return
        self.status = EnvironmentStatus.GOOD
        if not in_validity(self.epoch + t):
            self.status = EnvironmentStatus.OUTSIDE_YEARS
        if self.is_below_air(r):
            self.status = EnvironmentStatus.BELOW_AIR
        sun_inertial = self.sun - r
        field_inertial = self.flux_density(t, r)
        self.environment.sun_distance = norm(sun_inertial)
        self.environment.sun_direction = sun_inertial / norm(sun_inertial)
        self.environment.moon_position = self.moon()
        self.environment.illumination = self.light(r)
        self.environment.magnetic_field = field_inertial
        self.environment.magnetic_field_body = to_body(normalise(q), field_inertial)
        self.environment.density = self.air_density(t, r)
        self.environment.planet_angle = self.planet_angle_at(t)
