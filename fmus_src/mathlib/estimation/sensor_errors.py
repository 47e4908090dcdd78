"""Errors common to several sensors. Kernel functions."""

import math

from ...kernel.functions import exp
from ...kernel.matrices import Matrix
from ..vectors import Vector3, clip, vector

LATEST = 4  # largest latency, in samples


def next_markov(error: Vector3, elapsed: float, time: float, sigma: float, numbers: Vector3) -> Vector3:
    """Return a first-order Gauss-Markov error after ``elapsed`` (s), discretised exactly.

    The error has the correlation e^(-t/time) with the correlation time ``time`` (s), and the standard deviation
    ``sigma`` per axis in the unit of the error; ``numbers`` are standard normal. Source: Gelb 1974, section 3.8.
    """
    decay = exp(-elapsed / time)
    return decay * error + sigma * math.sqrt(1.0 - decay * decay) * numbers


def quantise(y: Vector3, quantum: float) -> Vector3:
    """Return the vector with components rounded to multiples of a quantum; unchanged for a quantum of 0."""
    if quantum > 0.0:
        return quantum * vector(
            float(math.floor(y.x / quantum + 0.5)),
            float(math.floor(y.y / quantum + 0.5)),
            float(math.floor(y.z / quantum + 0.5)),
        )
    return y


def saturate(y: Vector3, largest: float) -> Vector3:
    """Return the vector with components limited to +-largest."""
    return vector(clip(y.x, -largest, largest), clip(y.y, -largest, largest), clip(y.z, -largest, largest))


def make_room(samples: Matrix, columns: int) -> None:
    """Move all samples, one per row with the newest first, down by one row."""
    for i in range(LATEST):
        row = LATEST - i
        for k in range(columns):
            samples[row, k] = samples[row - 1, k]


def add_cross(a: Vector3, rotation: Vector3, f: Vector3) -> Vector3:
    """Return a + rotation x f, the effect of a small rotation (rad) of the axes on f, summed in this order."""
    return vector(
        a.x + rotation.y * f.z - rotation.z * f.y,
        a.y + rotation.z * f.x - rotation.x * f.z,
        a.z + rotation.x * f.y - rotation.y * f.x,
    )
