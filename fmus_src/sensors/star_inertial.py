"""Attitude from star trackers and gyroscopes together."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.quaternion import from_rotation_vector, multiply, normalise
from ..mathlib.rng import normals, seed_streams


class StarInertial(Block):
    """Star-inertial attitude: the true quaternion turned by a small rotation, new in every sample.

    The rotation vector has normal, independent components of attitude_sigma in body axes. The first
    sample is at the start. Which normal numbers a flight uses depends on seed, stream and the
    sample's number only. Source: Somov, Butyrin, Somov and Somova, see docs/systems/robot_rendezvous.md.
    Assumes errors that are small and alike about all axes, without bias.
    """

    default_step = 0.125

    attitude_sigma = Parameter(
        4.84813681109536e-6, unit="rad", minimum=0.0, description="error, 1 sigma per axis; 1 arcsec"
    )
    sample_period = Parameter(0.125, unit="s", minimum=0.0, description="between samples; 0: every communication point")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    quaternion = Input([1.0, 0.0, 0.0, 0.0], unit="1", description="true attitude, body to inertial, scalar first")
    measured_quaternion = Output(
        [1.0, 0.0, 0.0, 0.0], unit="1", direct=True, description="measured, from body to inertial, scalar first"
    )
    sample_count = Output(0, description="samples taken; tells a new one from a held one")
    generator = State([0.0] * 6, frozen=True, description="random number generator")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure()

    def measure(self) -> None:
        """Take a sample."""
        numbers = normals(self.generator)
        error = from_rotation_vector(self.attitude_sigma * numbers)
        self.measured_quaternion = normalise(multiply(self.quaternion, error))
        self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        self.measure()
