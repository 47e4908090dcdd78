"""Sample size and seed of the randomised tests, from the environment."""

import os
import random

from tests.support.lengths import either

# Times the usual number of samples.
FACTOR = float(os.environ.get("PERILUNE_TEST_SAMPLES", either("1", "0.3")))
SEED = int(os.environ.get("PERILUNE_TEST_SEED", "20240607"))


def size(usual: int) -> int:
    """How many samples to take where ``usual`` is the number without a factor."""
    return max(1, int(FACTOR * usual))


def generator(name: str) -> random.Random:
    """A generator of its own per test."""
    return random.Random(f"{SEED} {name}")
