"""Extent of the long checks: complete under `make long`, a fraction under `make test`.

Sample size and seed of randomised tests come from the environment.
"""

import os
import random
from typing import TypeVar

LONG = os.environ.get("PERILUNE_LONG") == "1"
Value = TypeVar("Value")


def either(long: Value, short: Value) -> Value:
    """Return ``long`` under `make long`, else ``short``."""
    return long if LONG else short


# Times the usual number of samples.
FACTOR = float(os.environ.get("PERILUNE_TEST_SAMPLES", either("1", "0.3")))
SEED = int(os.environ.get("PERILUNE_TEST_SEED", "20240607"))


def size(usual: int) -> int:
    """Return the number of samples where ``usual`` is the number without a factor."""
    return max(1, int(FACTOR * usual))


def generator(name: str) -> random.Random:
    """Return a separate generator per test."""
    return random.Random(f"{SEED} {name}")
