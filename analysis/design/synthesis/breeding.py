"""How genes arise: at random around a basis, by crossing two parents, by mutation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..laws.law import Matrix
from .candidate import Genes
from .gray_code import Coding
from .variations import Variation, apply_variations, random_variation

MOST_FLIPS = 3  # bits in which half of the random genes differ from their basis


def random_genes(
    random: np.random.Generator, basis: int, bases: Sequence[Matrix], code: int, count: int, coding: Coding
) -> Genes:
    """``count`` variations on a basis, each where those before it let it apply.

    Parameters are near those of ``code``, or anywhere, one as likely as the other.
    """
    matrix = bases[basis]
    variations: list[Variation] = []
    for _ in range(count):
        variations.append(random_variation(random, matrix))
        matrix = apply_variations(matrix, variations[-1:])
    if random.random() < 0.5:
        for _ in range(int(random.integers(MOST_FLIPS + 1))):
            code = flip_bit(random, code, coding)
    else:
        for bit in random.integers(2, size=coding.bits).tolist():
            code = code << 1 & 2**coding.bits - 1 | bit
    return Genes(basis, tuple(variations), code)


def cross(random: np.random.Generator, first: Genes, second: Genes, coding: Coding) -> list[Genes]:
    """Four children of two parents: both joins of their variations, each with both joins of their codes.

    Either is cut at one random place. A child's variations belong to the basis of the parent that
    gives the head.
    """
    cut = int(random.integers(1, max(len(first.variations), 2)))
    low = 2 ** int(random.integers(1, max(coding.bits, 2))) - 1
    codes = (first.code & ~low | second.code & low, second.code & ~low | first.code & low)
    heads = ((first, second), (second, first))
    return [
        Genes(head.basis, head.variations[:cut] + tail.variations[cut:], code) for head, tail in heads for code in codes
    ]


def mutate(random: np.random.Generator, genes: Genes, bases: Sequence[Matrix], coding: Coding) -> Genes:
    """One bit of the code flipped, one variation drawn anew where those before it let it apply."""
    place = int(random.integers(len(genes.variations)))
    before = genes.variations[:place]
    variation = random_variation(random, apply_variations(bases[genes.basis], before))
    variations = (*before, variation, *genes.variations[place + 1 :])
    return Genes(genes.basis, variations, flip_bit(random, genes.code, coding))


def flip_bit(random: np.random.Generator, code: int, coding: Coding) -> int:
    """The code with one random bit flipped."""
    return code ^ 1 << int(random.integers(coding.bits))
