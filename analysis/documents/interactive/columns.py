"""Columns of numbers inside a page, compact enough for e-mail.

The numbers of a column are float32 or, for figures that need no more, 16-bit steps over its range. The steps are linear
or, if the range spans decades, linear in asinh(x / knee): linear below the knee and logarithmic above it. Because
consecutive rows of a simulation are similar, second differences of the numbers, as integers in the order of their bits,
are small; their bytes, grouped by significance, deflate well. web/page/columns.ts is the inverse.
"""

from __future__ import annotations

import base64
import zlib
from dataclasses import dataclass, field
from typing import NamedTuple, TypedDict

import numpy as np

LEVEL = 9  # compression level of zlib
STEPS = 65534  # steps of a range in 16 bits; the next number is NaN
DECADES = 1e3  # ratio of the greatest magnitude to the small ones from which a range has a knee
SMALL = 0.05  # fraction of magnitudes that count as small
ROUNDING = 5e-4  # fraction of an axis by which float32 may move a point


class Coarse(NamedTuple):
    """Numbers, [rows], for which 16 bits are sufficient."""

    numbers: np.ndarray


class Scale(TypedDict, total=False):
    """The range of a 16-bit column, in asinh(x / knee) unless the knee is 0."""

    low: float
    high: float
    knee: float


class Encoded(Scale):
    """Description of a column; without a range its numbers are float32."""

    rows: int


class Packed(TypedDict):
    """The columns of a page; ``packed`` are the bytes of the float32 columns, then of the 16-bit columns."""

    columns: list[Encoded]
    packed: tuple[str, str]


@dataclass
class Columns:
    """The columns of one page, numbered in the order of addition."""

    encoded: list[Encoded] = field(default_factory=list)
    _numbers: dict[tuple[bytes, bool], int] = field(default_factory=dict)
    _bytes: tuple[bytearray, bytearray] = field(default_factory=lambda: (bytearray(), bytearray()))

    def add(self, numbers: np.ndarray, *, coarse: bool = False) -> int:
        """Add a column of these numbers, [rows], and return its index; equal columns share one.

        Numbers are rounded to float32, or if ``coarse`` to 16 bits over their range, where infinite ones become NaN.
        """
        with np.errstate(over="ignore"):  # numbers beyond float32 become infinite, which no figure shows
            column = np.ascontiguousarray(numbers, dtype="<f4")
        index = self._numbers.setdefault((column.tobytes(), coarse), len(self.encoded))
        if index == len(self.encoded):
            described, integers = _coarse(column) if coarse else (Scale(), _ordered(column))
            self.encoded.append({"rows": column.size, **described})
            self._bytes[coarse].extend(_planes(integers))
        return index

    def document(self) -> Packed:
        """Return the descriptions of the columns, and their deflated bytes in base64."""
        exact, coarse = (base64.b64encode(zlib.compress(each, LEVEL)).decode("ascii") for each in self._bytes)
        return {"columns": self.encoded, "packed": (exact, coarse)}


def has_enough_digits(ends: tuple[float, float], numbers: np.ndarray) -> bool:
    """Return True if float32 resolves the numbers between the ends of a linear axis."""
    inside = numbers[(numbers >= min(ends)) & (numbers <= max(ends))]
    rounded = np.abs(inside - inside.astype(np.float32))
    return not np.any(rounded > ROUNDING * abs(ends[1] - ends[0]))


def _ordered(column: np.ndarray) -> np.ndarray:
    """Return float32 numbers as uint32 integers of the same order, so close numbers are close integers."""
    bits = column.view("<u4")
    return np.where(bits >> 31 == 1, ~bits, bits | np.uint32(1 << 31))


def _coarse(column: np.ndarray) -> tuple[Scale, np.ndarray]:
    """Return the range of a column, and its numbers as integer steps within it."""
    finite = column[np.isfinite(column)].astype(float)
    knee = knee_of(finite, float(np.abs(finite).max(initial=0.0)))
    bent = np.arcsinh(finite / knee) if knee else finite
    low, high = (float(bent.min()), float(bent.max())) if finite.size else (0.0, 0.0)
    steps = np.full(column.size, STEPS + 1, dtype="<u2")
    steps[np.isfinite(column)] = np.rint((bent - low) * (STEPS / (high - low) if high > low else 0.0))
    return {"low": low, "high": high, "knee": knee}, steps


def knee_of(finite: np.ndarray, greatest: float) -> float:
    """Return the magnitude below which the scale of these numbers is linear; 0 if it is linear up to ``greatest``."""
    sizes = np.abs(finite[finite != 0.0])
    rank = int(SMALL * sizes.size)
    small = float(np.partition(sizes, rank)[rank]) if sizes.size else greatest
    return small if greatest > DECADES * small else 0.0


def _planes(numbers: np.ndarray) -> bytes:
    """Return the second differences of unsigned integers of one size, with bytes grouped by significance."""
    differences = numbers
    for _ in range(2):
        differences = differences - np.concatenate([np.zeros(1, numbers.dtype), differences[:-1]])[: numbers.size]
    signs = differences >> (8 * numbers.itemsize - 1)
    folded = (differences << 1) ^ (np.zeros_like(signs) - signs)  # small negative differences become small numbers, too
    return folded.astype(numbers.dtype.newbyteorder("<")).view(np.uint8).reshape(-1, numbers.itemsize).T.tobytes()
