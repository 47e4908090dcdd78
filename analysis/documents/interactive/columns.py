"""Columns of numbers inside a page, small enough to be mailed.

A column is float32; or, where a figure needs no more, 16 bits over its range: linear, or where that spans decades
through asinh, which is linear below a knee and logarithmic above it. Rows of a simulation continue those
before them, so second differences of the numbers, taken as integers in the order of their bits, are small, and their
bytes, grouped by significance, deflate well. web/page/columns.ts is the inverse.
"""

from __future__ import annotations

import base64
import zlib
from dataclasses import dataclass, field
from typing import NamedTuple, TypedDict

import numpy as np

LEVEL = 9  # of zlib
STEPS = 65534  # of a range in 16 bits; the number above is nan
DECADES = 1e3  # ratio of the greatest magnitude to the small ones from which a range has a knee
SMALL = 0.05  # the fraction of magnitudes that are small
ROUNDING = 5e-4  # of an axis, by which float32 may move a point


class Coarse(NamedTuple):
    """Numbers, [rows], of which 16 bits are enough."""

    numbers: np.ndarray


class Scale(TypedDict, total=False):
    """The range of a column in 16 bits; of asinh(x / knee) unless the knee is 0."""

    low: float
    high: float
    knee: float


class Encoded(Scale):
    """A column; without a range its numbers are float32."""

    rows: int


class Packed(TypedDict):
    """The columns of a page; ``packed``: the bytes of exact ones, then of those in 16 bits, one after the other."""

    columns: list[Encoded]
    packed: tuple[str, str]


@dataclass
class Columns:
    """The columns of one page, numbered in the order in which they were added."""

    encoded: list[Encoded] = field(default_factory=list)
    _numbers: dict[tuple[bytes, bool], int] = field(default_factory=dict)
    _bytes: tuple[bytearray, bytearray] = field(default_factory=lambda: (bytearray(), bytearray()))

    def add(self, numbers: np.ndarray, *, coarse: bool = False) -> int:
        """Add a column of these numbers, [rows], and return its index; equal columns share one.

        They are rounded to float32, ``coarse``: to 16 bits over their range, where infinite ones become nan.
        """
        with np.errstate(over="ignore"):  # beyond float32 is infinite, which no figure has
            column = np.ascontiguousarray(numbers, dtype="<f4")
        index = self._numbers.setdefault((column.tobytes(), coarse), len(self.encoded))
        if index == len(self.encoded):
            described, integers = _coarse(column) if coarse else (Scale(), _ordered(column))
            self.encoded.append({"rows": column.size, **described})
            self._bytes[coarse].extend(_planes(integers))
        return index

    def document(self) -> Packed:
        """Return what describes the columns, and these as base64 of their deflated bytes."""
        exact, coarse = (base64.b64encode(zlib.compress(each, LEVEL)).decode("ascii") for each in self._bytes)
        return {"columns": self.encoded, "packed": (exact, coarse)}


def has_enough_digits(ends: tuple[float, float], numbers: np.ndarray) -> bool:
    """Return True if numbers between the ends of a linear axis keep their places once they are float32."""
    inside = numbers[(numbers >= min(ends)) & (numbers <= max(ends))]
    rounded = np.abs(inside - inside.astype(np.float32))
    return not np.any(rounded > ROUNDING * abs(ends[1] - ends[0]))


def _ordered(column: np.ndarray) -> np.ndarray:
    """Return float32 as uint32 of the same order, so that neighbours have neighbouring numbers."""
    bits = column.view("<u4")
    return np.where(bits >> 31 == 1, ~bits, bits | np.uint32(1 << 31))


def _coarse(column: np.ndarray) -> tuple[Scale, np.ndarray]:
    """Return the range of a column, and its steps in it as integers."""
    finite = column[np.isfinite(column)].astype(float)
    knee = knee_of(finite, float(np.abs(finite).max(initial=0.0)))
    bent = np.arcsinh(finite / knee) if knee else finite
    low, high = (float(bent.min()), float(bent.max())) if finite.size else (0.0, 0.0)
    steps = np.full(column.size, STEPS + 1, dtype="<u2")
    steps[np.isfinite(column)] = np.rint((bent - low) * (STEPS / (high - low) if high > low else 0.0))
    return {"low": low, "high": high, "knee": knee}, steps


def knee_of(finite: np.ndarray, greatest: float) -> float:
    """Return the magnitude below which a range of such numbers is linear; 0 if it is up to the ``greatest``."""
    sizes = np.abs(finite[finite != 0.0])
    rank = int(SMALL * sizes.size)
    small = float(np.partition(sizes, rank)[rank]) if sizes.size else greatest
    return small if greatest > DECADES * small else 0.0


def _planes(numbers: np.ndarray) -> bytes:
    """Return the second differences of unsigned integers of one size, their bytes grouped by significance."""
    differences = numbers
    for _ in range(2):
        differences = differences - np.concatenate([np.zeros(1, numbers.dtype), differences[:-1]])[: numbers.size]
    signs = differences >> (8 * numbers.itemsize - 1)
    folded = (differences << 1) ^ (np.zeros_like(signs) - signs)  # small negative ones become small, too
    return folded.astype(numbers.dtype.newbyteorder("<")).view(np.uint8).reshape(-1, numbers.itemsize).T.tobytes()
