"""Settings of a search, and its parameters in Gray code.

In Gray code neighbouring numbers differ in one bit, so flipping a bit can be a small change.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..laws.law import PARAMETERS


def to_gray(number: int) -> int:
    """Return the reflected binary Gray code of a number >= 0 (Gray 1953)."""
    return number ^ (number >> 1)


def from_gray(code: int) -> int:
    """Return the number with this Gray code: each bit is the parity of this and all higher bits of the code."""
    number = 0
    while code:
        number ^= code
        code >>= 1
    return number


@dataclass(frozen=True)
class Coding:
    """Coding of unsigned fixed-point parameters, each in Gray code, concatenated in one integer.

    There are ``count`` parameters of ``integer`` + ``fraction`` bits; the first has the most significant bits.
    """

    count: int
    integer: int
    fraction: int

    @property
    def width(self) -> int:
        return self.integer + self.fraction

    @property
    def bits(self) -> int:
        return self.count * self.width

    def encode(self, values: Sequence[float]) -> int:
        """Return the code nearest to ``values``. Raises ValueError with the position of a value out of range."""
        code = 0
        for position, value in enumerate(values):
            number = round(value * 2**self.fraction)
            if not 0 <= number < 2**self.width:
                raise ValueError(position)
            code = code << self.width | to_gray(number)
        return code

    def decode(self, code: int) -> tuple[float, ...]:
        """Return the parameters of a code, exactly."""
        mask = 2**self.width - 1
        parts = [code >> self.width * place & mask for place in reversed(range(self.count))]
        return tuple(from_gray(part) / 2**self.fraction for part in parts)


@dataclass(frozen=True)
class SearchSettings:
    """Settings of the search; defaults as published.

    ``crossovers`` is the number of couples per generation, ``variations`` the number of variations per candidate,
    ``mutation`` the probability that a child mutates, and ``crossover`` the weight alpha in the probability that a
    couple mates. Every ``renewal`` generations the basis is replaced and only ``elites`` members remain. With ``stop``
    the search ends once a candidate succeeds in every trial.
    """

    population: int = 256
    generations: int = 64
    crossovers: int = 128
    variations: int = 8
    elites: int = 8
    mutation: float = 0.7
    crossover: float = 0.4
    renewal: int = 29
    integer_bits: int = 4
    fraction_bits: int = 12
    stop: bool = True

    @property
    def coding(self) -> Coding:
        return Coding(PARAMETERS, self.integer_bits, self.fraction_bits)
