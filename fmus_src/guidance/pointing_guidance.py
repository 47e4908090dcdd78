"""Reference attitude on an orbit: nadir, Sun, or inertially fixed."""

import math

from ..block import Block, Input, Output, Outputs, Parameter, State
from ..interfaces.ports import inertial, sampling
from ..interfaces.ports.satellite import AttitudeReference
from ..interfaces.ports.space import PointingMode, SpaceEnvironment
from ..kernel.enumerations import Enumeration, member
from ..mathlib.attitude.quaternion import multiply, normalise, to_body
from ..mathlib.attitude.triad import from_axes, triad
from ..mathlib.vectors import Vector3, Vector4, cross, dot, is_finite, norm, vector

OLD = 5.0  # s, age above which a sample of the orbit is old
PARALLEL = 1e-3  # sine of the angle below which two directions are parallel


class PointingStatus(Enumeration):
    """Validity of the reference."""

    GOOD = member("good")
    OLD_ORBIT = member("last orbit sample older than 5 s, propagated further")
    DEGENERATE = member("directions parallel, last reference held")
    NOT_FINITE = member("an input not finite, last reference held")


class PointingGuidance(Block):
    """Reference attitude from the estimated orbit and the direction to the Sun.

    NADIR: z points to the centre of the central body and y opposite to the orbit normal, both rotated by ``offset``;
    with the acceleration a by J2:

        ω_r = (r × v)/|r|^2 + (a · (r × v)) r/|r × v|^2    ω_r' = -2 (r · v) ω_r/|r|^2

    SUN: panel_normal points to the Sun and secondary as near as possible to the orbit normal, at rest. INERTIAL:
    inertial_quaternion, at rest. An orbit sample is propagated from its sample_time to the present instant by

        r + v h + g h^2/2    v + g h

    Frames: inertial; reference axes for the reference's rate and acceleration.

    Assumes a central body that rotates about the inertial z axis, and neglects the change of the J2 term in ω_r'.

    Source: Wertz 1978, section 16; Markley and Crassidis 2014, section 5.1. See docs/systems/earth_pointing.md.
    """

    default_step = 0.25

    gravitational_parameter = Parameter(
        3.986004415e14, unit="m3/s2", minimum=1.0, description="gravitational parameter of the central body"
    )
    oblateness = Parameter(1.0826356e-3, unit="1", description="oblateness coefficient J2 of the central body")
    radius = Parameter(
        6378136.3, unit="m", minimum=1.0, description="equatorial radius of the central body, used with oblateness"
    )
    offset = Parameter(
        [1.0, 0.0, 0.0, 0.0],
        unit="1",
        description="attitude quaternion of the body relative to the local orbital axes in mode 0, scalar first",
    )
    panel_normal = Parameter(
        [0.0, -1.0, 0.0], unit="1", frame="body", description="body axis that points to the Sun in mode 1"
    )
    secondary = Parameter(
        [0.0, 0.0, 1.0], unit="1", frame="body", description="body axis that points close to the orbit normal in mode 1"
    )
    inertial_quaternion = Parameter(
        [1.0, 0.0, 0.0, 0.0],
        unit="1",
        description="fixed attitude quaternion in mode 2, from body to inertial, scalar first",
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.25, "sample period of the guidance; 0: a sample at every communication point"
    )
    mode = Input(PointingMode)
    estimated_position = inertial.POSITION.input(
        "position at the last orbit sample relative to the centre of the central body", start=[6878137.0, 0.0, 0.0]
    )
    estimated_velocity = inertial.VELOCITY.input(
        "velocity at the last orbit sample relative to the centre of the central body", start=[0.0, -980.47, 7549.2]
    )
    sample_time = Input(0.0, unit="s", description="time of measurement of the last orbit sample")
    orbit_count = Input(0, description="number of orbit samples since the start; a change signals a new sample")
    sun_direction = SpaceEnvironment.sun_direction.input()
    reference = Outputs(AttitudeReference, direct=True)
    status = Output(PointingStatus, direct=True)
    counted = State(0, description="orbit_count of the last orbit sample used")
    position = inertial.POSITION.state(
        "estimated position propagated to the current time, relative to the centre of the central body"
    )
    velocity = inertial.VELOCITY.state(
        "estimated velocity propagated to the current time, relative to the centre of the central body"
    )
    sampled_at = State(0.0, unit="s", description="time of measurement of the last orbit sample used")
    last_time = State(0.0, unit="s", description="time of the last guidance sample")
    start_time = sampling.START_TIME.state()

    def initialize(self) -> None:
        self.counted = self.orbit_count - 1
        self.last_time = self.start_time
        self.point(self.start_time)

    def propagate(self, h: float) -> None:
        """Propagate the orbit by h (s) under point-mass gravity."""
        r = self.position
        g = -(self.gravitational_parameter / (dot(r, r) * norm(r))) * r
        self.position = r + h * self.velocity + 0.5 * h * h * g
        self.velocity = self.velocity + h * g

    def oblate_acceleration(self, r: Vector3) -> Vector3:
        """Return the acceleration (m/s2, inertial) by J2 of a central body that rotates about the inertial z axis.

        Source: Montenbruck and Gill 2000, section 3.2.
        """
        distance = norm(r)
        factor = -1.5 * self.oblateness * self.gravitational_parameter / (distance * distance * distance)
        factor = factor * self.radius * self.radius / (distance * distance)
        sine = r.z / distance
        return factor * (r - 5.0 * sine * sine * r + vector(0.0, 0.0, 2.0 * r.z))

    def rest_at(self, q: Vector4) -> None:
        """Set the reference to a constant attitude."""
        self.reference.reference_quaternion = q
        self.reference.reference_angular_velocity = vector(0.0, 0.0, 0.0)
        self.reference.reference_angular_acceleration = vector(0.0, 0.0, 0.0)

    def point_down(self) -> None:
        """Set the reference of mode NADIR."""
        r = self.position
        v = self.velocity
        h = cross(r, v)
        momentum = norm(h)
        if not momentum > PARALLEL * norm(r) * norm(v):
            self.status = PointingStatus.DEGENERATE
            return
        z = -r / norm(r)
        y = -h / momentum
        q = normalise(multiply(from_axes(cross(y, z), y, z), normalise(self.offset)))
        if q.w < 0.0:
            q = -q
        square = dot(r, r)
        w_inertial = h / square + dot(self.oblate_acceleration(r), h) / (momentum * momentum) * r
        w_body = to_body(q, w_inertial)
        self.reference.reference_quaternion = q
        self.reference.reference_angular_velocity = w_body
        self.reference.reference_angular_acceleration = -2.0 * dot(r, v) / square * w_body

    def point_to_sun(self) -> None:
        """Set the reference of mode SUN."""
        normal = cross(self.position, self.velocity)
        attitude = triad(self.panel_normal, self.secondary, self.sun_direction, normal, PARALLEL)
        if attitude.exists:
            self.rest_at(attitude.quaternion)
        else:
            self.status = PointingStatus.DEGENERATE

    def point(self, t: float) -> None:
        """Set the reference at t (s) for the present mode."""
        finite = is_finite(self.estimated_position) and is_finite(self.estimated_velocity)
        finite = finite and is_finite(self.sun_direction) and math.isfinite(self.sample_time)
        self.status = PointingStatus.NOT_FINITE
        if finite and self.orbit_count != self.counted and norm(self.estimated_position) > 0.0:
            self.counted = self.orbit_count
            self.position = self.estimated_position
            self.velocity = self.estimated_velocity
            self.sampled_at = self.sample_time
            self.propagate(t - self.sampled_at)
        elif norm(self.position) > 0.0:
            self.propagate(t - self.last_time)
        self.last_time = t
        if not (finite and norm(self.position) > 0.0):
            return
        self.status = PointingStatus.GOOD
        if t - self.sampled_at > OLD:
            self.status = PointingStatus.OLD_ORBIT
        if self.mode == PointingMode.NADIR:
            self.point_down()
        elif self.mode == PointingMode.SUN:
            self.point_to_sun()
        else:
            self.rest_at(normalise(self.inertial_quaternion))

    def step(self, t: float, h: float) -> None:
        self.point(t + h)
