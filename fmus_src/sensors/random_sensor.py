"""Base of sensors with random errors: random number stream and sampling."""

from ..block import Block, Parameter, State
from ..mathlib.rng import seed_streams


class RandomSensor(Block, interface=True):
    """Sensor that takes a sample at the start and at every step, with errors from its own random stream.

    A sensor declares seed, stream and generator, and defines `measure`; errors that are constant over a simulation are
    drawn in `draw_constants`.
    """

    to_write = ("measure",)

    seed: Parameter
    stream: Parameter
    generator: State

    def draw_constants(self) -> None:
        """Draw the errors that are constant over a simulation."""

    def measure(self) -> None:
        """Take a sample."""

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.draw_constants()
        self.measure()

    def step(self, t: float, h: float) -> None:
        self.measure()
