"""Cheap replacement for simulations: a law is evaluated by its difference from a known formula, point by point."""

import math

from perilune.analysis.design.laws.law import NetworkOperator
from perilune.analysis.design.synthesis.candidate import Evaluation
from tests.support.laws.evaluation import evaluate_tree

POINTS = [(-2.0 + 0.25 * place, 0.6 - 0.15 * place) for place in range(8)]  # theta (rad), (hf - h)/h0
TOLERANCE = 0.15


class FormulaEvaluator:
    """Objectives are |u1 - target| and |u2 - target|, capped at 100 and summed over `POINTS`.

    ``hasty`` ends an evaluation as soon as the bar rejects it.
    """

    objectives = 2
    trials = len(POINTS)

    def __init__(self, target, hasty=True):
        self.target = target
        self.hasty = hasty
        self.laws = 0
        self.points = 0

    def evaluate(self, tasks, bar):
        return [self._evaluate(task, bar) for task in tasks]

    def _evaluate(self, task, bar):
        self.laws += task.known.flown == 0
        sums, successes, flown = task.known
        law = NetworkOperator("", task.law.matrix, task.law.q, "true")
        while flown < self.trials:
            collected = evaluate_tree(law, *POINTS[flown])
            missed = [abs(a - b) for a, b in zip(collected, self.target(*POINTS[flown]), strict=True)]
            sums = tuple(total + min(miss, 100.0) for total, miss in zip(sums, missed, strict=True))
            successes += all(miss < TOLERANCE for miss in missed)
            flown += 1
            self.points += 1
            if self.hasty and flown < self.trials and bar is not None and bar.rejects(sums):
                break
        return Evaluation(sums, successes, flown)


def near(theta, d):
    """Evaluate the published basic solution without its step, that is one edge, and with other parameters."""
    return 1.25 * (math.pi + theta) + 0.75 * d, -0.5 * theta * math.cos(theta)
