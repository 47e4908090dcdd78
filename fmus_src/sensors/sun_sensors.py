"""Sun sensors: coarse heads on all sides, and a fine head."""

import math

from ..block import Output, Parameter, State
from ..interfaces.ports import inertial, robot, sampling
from ..interfaces.ports.space import SpaceEnvironment
from ..kernel.enumerations import Enumeration, member
from ..kernel.functions import cos
from ..mathlib.attitude.quaternion import from_rotation_vector, is_attitude, normalise, to_body, to_reference
from ..mathlib.rng import normals
from ..mathlib.vectors import Vector3, dot, is_finite, norm, vector
from ..units import deg
from .random_sensor import RandomSensor

HEADS = 6
BRIGHTNESS = 0.5  # visible fraction of the Sun's disk above which the fine head measures


class SunSensorStatus(Enumeration):
    """Status of the last sample."""

    GOOD = member("good")
    NO_SUN = member("no Sun, direction held")
    NOT_FINITE = member("input not finite or no attitude, no sample")


class SunSensors(RandomSensor):
    """Six coarse Sun sensor heads with cosine characteristic, and a fine head with a small field of view.

    The current of a head with normal n, direction s to the Sun, scale factor k and visible fraction ν of the Sun is

        i = max(0, n · s) (1 + k) ν + albedo_factor max(0, n · down) + sigma n_r

    where the first term is 0 unless s is within field_of_view of n. The measured direction is the direction of the sum
    of i n over all heads, if this sum is longer than threshold. With pairs of opposite heads on perpendicular axes the
    direction is free of systematic errors for a field_of_view of 90 deg; for a smaller one, components of s below
    cos(field_of_view) are lost, which causes errors up to 7.1 deg at 85 deg. If fine_sigma is not 0 and the Sun is
    within fine_field of the boresight, the fine head measures the direction with a small random rotation. Scale factors
    are random and constant over a simulation. Random numbers depend on seed, stream and sample number only.

    Frames: body; inertial for the Sun's direction and the position.

    Assumes that the spacecraft casts no shadow on the heads.

    See docs/systems/earth_pointing.md.
    """

    default_step = 0.5

    normals_of_heads = Parameter(
        [1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0],
        unit="1",
        frame="body",
        columns=3,
        description="unit normals of the coarse heads, one per row",
    )
    sigma = Parameter(
        0.01,
        unit="1",
        minimum=0.0,
        description="white noise of each head's current, 1 sigma, as a fraction of full scale",
    )
    scale_sigma = Parameter(
        0.0,
        unit="1",
        minimum=0.0,
        description="scale factor error of each head's current, constant over a simulation, 1 sigma",
    )
    albedo_factor = Parameter(
        0.0,
        unit="1",
        minimum=0.0,
        description=(
            "current due to the Earth's albedo in a head that points straight down, as a fraction of full scale"
        ),
    )
    field_of_view = Parameter(
        deg(85.0),
        unit="rad",
        minimum=0.0,
        maximum=math.pi,
        description="half-angle of each coarse head's field of view",
    )
    threshold = Parameter(
        0.5,
        unit="1",
        minimum=0.0,
        description="least length of the vector sum of the heads' currents for a valid direction",
    )
    boresight = Parameter(
        [0.0, 0.0, 1.0], unit="1", frame="body", description="boresight of the fine head, normalised by the block"
    )
    fine_sigma = Parameter(
        0.0,
        unit="rad",
        minimum=0.0,
        description="error of the direction measured by the fine head, 1 sigma per axis; 0: no fine head",
    )
    fine_field = Parameter(
        deg(30.0), unit="rad", minimum=0.0, maximum=math.pi, description="half-angle of the fine head's field of view"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.5)
    seed, stream = sampling.random_stream()
    quaternion = robot.QUATERNION.input("true attitude quaternion from body to inertial, scalar first")
    position = inertial.POSITION.input("true position relative to the centre of the central body")
    sun_direction = SpaceEnvironment.sun_direction.input()
    illumination = SpaceEnvironment.illumination.input()
    currents = Output(
        [0.0] * HEADS, unit="1", direct=True, description="currents of the coarse heads, as fractions of full scale"
    )
    measured_direction = Output(
        [1.0, 0.0, 0.0],
        unit="1",
        frame="body",
        direct=True,
        description="measured direction from the spacecraft to the Sun, unit vector",
    )
    valid = Output(False, direct=True, description="true: Sun in view in the last sample")
    sample_count = sampling.SAMPLE_COUNT.output(
        "number of samples with the Sun in view since the start; a change signals a new sample"
    )
    status = Output(SunSensorStatus, direct=True)
    scales = State(
        [0.0] * HEADS, unit="1", frozen=True, description="scale factor errors of the coarse heads' currents"
    )
    generator = sampling.GENERATOR.state()

    def draw_constants(self) -> None:
        first = normals(self.generator)
        second = normals(self.generator)
        for i in range(3):
            self.scales[i] = self.scale_sigma * first[i]
            self.scales[i + 3] = self.scale_sigma * second[i]

    def current(self, normal: Vector3, scale: float, sun: Vector3, down: Vector3) -> float:
        """Return the noise-free current of a head, as a fraction of full scale."""
        current = 0.0
        cosine = dot(normal, sun)
        if cosine > 0.0 and cosine >= cos(self.field_of_view):
            current = cosine * self.illumination * (1.0 + scale)
        below = dot(normal, down)
        if below > 0.0:
            current = current + self.albedo_factor * below
        return current

    def measure(self) -> None:
        """Take a sample."""
        first = normals(self.generator)
        second = normals(self.generator)
        turn = normals(self.generator)
        q = self.quaternion
        finite = is_finite(self.sun_direction) and math.isfinite(self.illumination) and is_finite(self.position)
        self.valid = False
        self.status = SunSensorStatus.NOT_FINITE
        if not (finite and math.isfinite(q.w) and is_finite(q[1:4]) and is_attitude(q)):
            return
        q = normalise(q)
        sun_body = to_body(q, self.sun_direction)
        nadir_body = vector(0.0, 0.0, 0.0)
        if norm(self.position) > 0.0:
            nadir_body = to_body(q, -self.position / norm(self.position))
        sum_body = vector(0.0, 0.0, 0.0)
        for k in range(HEADS):
            noise = first[k % 3]
            if k > 2:
                noise = second[k % 3]
            normal_body = self.normals_of_heads[k, 0:3]
            self.currents[k] = self.current(normal_body, self.scales[k], sun_body, nadir_body) + self.sigma * noise
            sum_body = sum_body + self.currents[k] * normal_body
        length = norm(sum_body)
        direction_body = sum_body
        aim = norm(self.boresight)
        in_field = aim > 0.0 and dot(sun_body, self.boresight) >= aim * cos(self.fine_field)
        if self.fine_sigma > 0.0 and in_field and self.illumination > BRIGHTNESS:
            direction_body = to_reference(from_rotation_vector(self.fine_sigma * turn), sun_body)
            length = 1.0
        self.status = SunSensorStatus.NO_SUN
        if length > self.threshold:
            self.status = SunSensorStatus.GOOD
            self.valid = True
            self.measured_direction = direction_body / norm(direction_body)
            self.sample_count = self.sample_count + 1
