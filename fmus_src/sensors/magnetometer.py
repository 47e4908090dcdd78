"""Three-axis magnetometer."""

from ..block import Output, Parameter, State
from ..interfaces.ports import sampling, space
from ..kernel.enumerations import Enumeration, member
from ..kernel.matrices import zeros
from ..mathlib.estimation.sensor_errors import quantise, saturate
from ..mathlib.rng import normals
from ..mathlib.vectors import is_finite, norm
from .random_sensor import RandomSensor


class MagnetometerStatus(Enumeration):
    """Status of the last sample."""

    GOOD = member("good")
    SATURATED = member("saturated")
    NOT_FINITE = member("input not finite, no sample")


class Magnetometer(RandomSensor):
    """Three-axis magnetometer with scale factors, misalignment, bias, noise, torquer field, range and rounding.

        B_m = (1 + S) B + K m + bias + b + sigma n

    B_m is limited to ±range and rounded to a multiple of quantum. S is scale plus a random matrix; this matrix and the
    random bias b are constant over a simulation. m is the dipole that the torquers apply. The first sample is at the
    start. Random numbers depend on seed, stream and sample number only.

    Frame: body.

    Assumes errors independent of temperature.

    See docs/systems/earth_pointing.md.
    """

    default_step = 1.0

    sigma = Parameter(5e-8, unit="T", minimum=0.0, description="white noise of measured flux density, 1 sigma per axis")
    bias = space.MAGNETIC_FIELD.parameter(
        description="constant bias of measured flux density, added to the random bias"
    )
    bias_sigma = Parameter(
        2e-7,
        unit="T",
        minimum=0.0,
        description="random bias of measured flux density, constant over a simulation, 1 sigma per axis",
    )
    scale = Parameter(
        [0.0] * 9,
        unit="1",
        frame="body",
        columns=3,
        description="matrix S of scale factor errors (diagonal) and misalignments",
    )
    scale_sigma = Parameter(
        2e-3,
        unit="1",
        minimum=0.0,
        description="random part of each element of the matrix S, constant over a simulation, 1 sigma",
    )
    coupling = Parameter(
        [0.0] * 9,
        frame="body",
        columns=3,
        description="matrix K from the torquers' dipole moment to their flux density at the sensor, T/(A m2)",
    )
    range = Parameter(1e-4, unit="T", minimum=1e-9, description="largest magnitude of each measured component")
    quantum = Parameter(
        1e-8, unit="T", minimum=0.0, description="quantisation step of each measured component; 0: none"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(1.0)
    seed, stream = sampling.random_stream()
    magnetic_field_body = space.MAGNETIC_FIELD.input("true magnetic flux density at the spacecraft")
    applied_dipole = space.DIPOLE.input("magnetic dipole moment of the torquers")
    measured_field = space.MAGNETIC_FIELD.output("measured magnetic flux density", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output()
    status = Output(MagnetometerStatus, direct=True)
    total_bias = space.MAGNETIC_FIELD.state("sum of constant and random bias of measured flux density")
    total_scale = State(
        zeros(3, 3),
        frozen=True,
        description="sum of the matrix S of scale factor errors and its random part (body frame)",
    )
    generator = sampling.GENERATOR.state()

    def draw_constants(self) -> None:
        numbers = normals(self.generator)
        self.total_bias = self.bias + self.bias_sigma * numbers
        self.total_scale = self.scale
        for i in range(3):
            row = normals(self.generator)
            for j in range(3):
                self.total_scale[i, j] = self.scale[i, j] + self.scale_sigma * row[j]

    def measure(self) -> None:
        """Take a sample."""
        numbers = normals(self.generator)
        if not (is_finite(self.magnetic_field_body) and is_finite(self.applied_dipole)):
            self.status = MagnetometerStatus.NOT_FINITE
            return
        b = self.magnetic_field_body
        y = b + self.total_scale @ b + self.coupling @ self.applied_dipole + self.total_bias + self.sigma * numbers
        within = saturate(y, self.range)
        self.status = MagnetometerStatus.GOOD
        if norm(within - y) > 0.0:
            self.status = MagnetometerStatus.SATURATED
        self.measured_field = quantise(within, self.quantum)
        self.sample_count = self.sample_count + 1
