"""The numbers of a search."""

from __future__ import annotations

from dataclasses import dataclass

from ..laws.law import PARAMETERS
from .gray_code import Coding


@dataclass(frozen=True)
class SearchSettings:
    """The numbers of the search; defaults as published.

    ``crossovers`` couples a generation, ``variations`` a candidate; ``mutation`` is the probability for a
    child, ``crossover`` the weight in the probability that a couple mates; every ``renewal`` generations
    the basis is replaced and only ``elites`` stay; ``stop`` ends the search as soon as a candidate has
    every trial a success.
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
        """How parameters are coded."""
        return Coding(PARAMETERS, self.integer_bits, self.fraction_bits)
