"""Ports and parameters of blocks that sample or integrate."""

from ...block import Parameter
from ...ports import Port

GENERATOR = Port([0.0] * 6, frozen=True, description="internal state of the random number generator")
INNOVATION_SQUARE = Port(
    0.0, unit="1", description="normalised innovation squared of the last sample, sum over three components"
)
INTERNAL_STEP = Port(0.1, unit="s", minimum=1e-4, description="largest step of the numerical integration")
TIME_ROUNDING = 1e-9  # s, tolerance of communication points and sample times, which importers round or sum
SAMPLES_TAKEN = Port(0, description="number of samples used since the start")
SAMPLE_COUNT = Port(0, description="number of samples since the start; a change signals a new sample")
SAMPLE_PERIOD = Port(0.2, unit="s", minimum=0.0, description="sample period; 0: a sample at every communication point")
START_TIME = Port(0.0, unit="s", description="start time of the simulation")


def random_stream() -> tuple[Parameter, Parameter]:
    """Return the parameters seed and stream of a block's random number generator."""
    seed = Parameter(1, minimum=0, description="seed of the random number generator")
    stream = Parameter(0, minimum=0, description="stream of the random number generator for this seed")
    return seed, stream
