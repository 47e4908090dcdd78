"""What the search needs to know of whatever says how good a law is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from .candidate import Evaluation, Phenotype
from .pareto import ParetoOrder, Standing


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
