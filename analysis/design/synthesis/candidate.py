"""A candidate of the search: its genes, the law they stand for, what flying it came to, and who can tell."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from ..laws.law import Matrix
from .gray_code import Coding
from .pareto import ParetoOrder, Standing
from .variations import Variation, apply_variations, edges_out, prune

PARAMETER_NODES = (1, 3, 5)  # the sources q1, q2, q3, counted from 0


class Genes(NamedTuple):
    """The number of a basis, what is varied on it, and the parameters in Gray code."""

    basis: int
    variations: tuple[Variation, ...]
    code: int


class Phenotype(NamedTuple):
    """A law as it flies: matrix without what leads nowhere, and parameters."""

    matrix: Matrix
    q: tuple[float, ...]

    @property
    def key(self) -> str:
        """A name that equal laws share: parameters that the matrix does not use do not count."""
        used = [
            value if edges_out(self.matrix, node) else None for node, value in zip(PARAMETER_NODES, self.q, strict=True)
        ]
        return hashlib.sha256(json.dumps([self.matrix, used]).encode()).hexdigest()[:32]


class Evaluation(NamedTuple):
    """What flying a law came to: sums over the first ``flown`` trials, and how many of these were successes."""

    objectives: tuple[float, ...]
    successes: int
    flown: int


class Candidate(NamedTuple):
    """Genes that were tried: the law's key and its evaluation."""

    genes: Genes
    key: str
    evaluation: Evaluation


def phenotype(genes: Genes, bases: list[Matrix], coding: Coding) -> Phenotype:
    """The law that genes stand for."""
    return Phenotype(prune(apply_variations(bases[genes.basis], genes.variations)), coding.decode(genes.code))


class Bar(NamedTuple):
    """What a candidate has to pass: it must stand before the worst of a population."""

    order: ParetoOrder
    worst: Standing

    def rejects(self, objectives: Sequence[float]) -> bool:
        """Whether sums that can only grow any further are too large already."""
        return self.order.standing(np.array(objectives)) >= self.worst


class Task(NamedTuple):
    """A law to evaluate, and what is known of its first trials."""

    law: Phenotype
    known: Evaluation


class Evaluator(Protocol):
    """What the search needs to know of flights."""

    objectives: int  # number of objectives
    trials: int  # of an evaluation that is complete

    def evaluate(self, tasks: Sequence[Task], bar: Bar | None) -> list[Evaluation]:
        """Evaluate laws, each from the trial after the known ones; objectives are sums of numbers >= 0.

        An evaluation may end early where ``bar`` rejects it, and must not otherwise.
        """
        ...
