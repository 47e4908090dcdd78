"""Candidate of the search: genes, encoded law and evaluation; interface of the evaluator."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from ..laws.law import Matrix
from .pareto import ParetoOrder, Standing
from .search_settings import Coding
from .variations import Variation, apply_variations, edges_out, prune, random_variation

PARAMETER_NODES = (1, 3, 5)  # the sources q1, q2, q3, counted from 0
MOST_FLIPS = 3  # bits in which half of the random genes differ from their basis


class Genes(NamedTuple):
    """Genes of a candidate: the number of a basis, variations on it, and the parameters in Gray code."""

    basis: int
    variations: tuple[Variation, ...]
    code: int


class Phenotype(NamedTuple):
    """Law encoded by genes, as simulated: the matrix without unused nodes, and the parameters."""

    matrix: Matrix
    q: tuple[float, ...]

    @property
    def key(self) -> str:
        """Hash that is equal for equal laws; parameters that the matrix does not use do not count."""
        used = [
            value if edges_out(self.matrix, node) else None for node, value in zip(PARAMETER_NODES, self.q, strict=True)
        ]
        return hashlib.sha256(json.dumps([self.matrix, used]).encode()).hexdigest()[:32]


class Evaluation(NamedTuple):
    """Result of a law's evaluation: sums of objectives over the first ``flown`` trials, and successes among them."""

    objectives: tuple[float, ...]
    successes: int
    flown: int


class Candidate(NamedTuple):
    """Genes, with the key and the evaluation of their law."""

    genes: Genes
    key: str
    evaluation: Evaluation


def phenotype(genes: Genes, bases: list[Matrix], coding: Coding) -> Phenotype:
    """Return the law that the genes encode."""
    return Phenotype(prune(apply_variations(bases[genes.basis], genes.variations)), coding.decode(genes.code))


class AdmissionThreshold(NamedTuple):
    """Threshold for a candidate: its standing must be better than the worst of a population."""

    order: ParetoOrder
    worst: Standing

    def rejects(self, objectives: Sequence[float]) -> bool:
        """Return True if the sums, which can only increase, are already too large."""
        return self.order.standing(np.array(objectives)) >= self.worst


class EvaluationTask(NamedTuple):
    """Law to evaluate, with the known evaluation of its first trials."""

    law: Phenotype
    known: Evaluation


class Evaluator(Protocol):
    """Interface of the evaluator of laws."""

    objectives: int  # number of objectives
    trials: int  # number of trials of a complete evaluation

    def evaluate(self, tasks: Sequence[EvaluationTask], bar: AdmissionThreshold | None) -> list[Evaluation]:
        """Evaluate laws, each from the first trial not yet known; objectives are sums of non-negative numbers.

        An evaluation may end early only if ``bar`` rejects its sums.
        """
        ...


def random_genes(
    random: np.random.Generator, basis: int, bases: Sequence[Matrix], code: int, count: int, coding: Coding
) -> Genes:
    """Draw ``count`` variations on a basis, each applicable after the previous ones.

    The parameters are near those of ``code`` or uniformly distributed, with equal probability.
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
    """Return four children of two parents: both crossings of the variations, each with both crossings of the codes.

    Variations and codes are each cut at one random place. A child inherits the basis of the parent that contributes the
    first segment of variations.
    """
    cut = int(random.integers(1, max(len(first.variations), 2)))
    low = 2 ** int(random.integers(1, max(coding.bits, 2))) - 1
    codes = (first.code & ~low | second.code & low, second.code & ~low | first.code & low)
    heads = ((first, second), (second, first))
    return [
        Genes(head.basis, head.variations[:cut] + tail.variations[cut:], code) for head, tail in heads for code in codes
    ]


def mutate(random: np.random.Generator, genes: Genes, bases: Sequence[Matrix], coding: Coding) -> Genes:
    """Flip one bit of the code, and redraw one variation that the previous ones permit."""
    place = int(random.integers(len(genes.variations)))
    before = genes.variations[:place]
    variation = random_variation(random, apply_variations(bases[genes.basis], before))
    variations = (*before, variation, *genes.variations[place + 1 :])
    return Genes(genes.basis, variations, flip_bit(random, genes.code, coding))


def flip_bit(random: np.random.Generator, code: int, coding: Coding) -> int:
    return code ^ 1 << int(random.integers(coding.bits))
