"""Parameters as Gray code: neighbouring numbers differ in one bit, so that a flipped bit can be a small change."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


def to_gray(number: int) -> int:
    """The reflected binary Gray code of a number >= 0 (Gray 1953)."""
    return number ^ (number >> 1)


def from_gray(code: int) -> int:
    """The number that a Gray code stands for: each bit is the parity of the code's bits from there up."""
    number = 0
    while code:
        number ^= code
        code >>= 1
    return number


@dataclass(frozen=True)
class Coding:
    """Parameters in fixed point, without sign, each in Gray code, one behind the other in one integer.

    ``count`` parameters of ``integer`` and ``fraction`` bits; the first has the highest bits.
    """

    count: int
    integer: int
    fraction: int

    @property
    def width(self) -> int:
        """Bits of one parameter."""
        return self.integer + self.fraction

    @property
    def bits(self) -> int:
        """Bits of all parameters."""
        return self.count * self.width

    def encode(self, values: Sequence[float]) -> int:
        """The code nearest to ``values``. Raises ValueError with the position of a value out of range."""
        code = 0
        for position, value in enumerate(values):
            number = round(value * 2**self.fraction)
            if not 0 <= number < 2**self.width:
                raise ValueError(position)
            code = code << self.width | to_gray(number)
        return code

    def decode(self, code: int) -> tuple[float, ...]:
        """The parameters that a code stands for, exact."""
        mask = 2**self.width - 1
        parts = [code >> self.width * place & mask for place in reversed(range(self.count))]
        return tuple(from_gray(part) / 2**self.fraction for part in parts)
