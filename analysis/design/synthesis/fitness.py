"""Fitness of a law, from simulations of the complete system in the trials of a campaign."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from ....common.errors import InputError
from ...campaigns.definition.expressions import Expression
from ...campaigns.definition.plan import BatchPlan
from ...campaigns.execute.flyer import Flyer, TrialResult
from ...campaigns.execute.workers import FlyerPool
from ...runtime.ssp.parameter_values import ParameterValue
from ..laws.law import NetworkOperator, law_parameters
from .candidate import AdmissionThreshold, Evaluation, EvaluationTask

VARIANT = "default"


class FlightEvaluator:
    """Evaluator of laws by simulation, one law per worker at a time; see `candidate.Evaluator`.

    ``plan`` is the campaign, in which the parameters of ``component`` that define a law are replaced; ``basic``
    supplies the properties that the search does not vary; ``objectives`` are expressions over metrics. ``evaluated`` is
    called after each law. A context manager, since it holds the workers.
    """

    def __init__(
        self,
        plan: BatchPlan,
        component: str,
        basic: NetworkOperator,
        objectives: Sequence[Expression],
        *,
        workers: int,
        native: bool,
        evaluated: Callable[[], object] = lambda: None,
    ) -> None:
        self.trials = plan.campaign.trials
        self.objectives = len(objectives)
        self._expressions = tuple(objectives)
        self._component = component
        self._basic = basic
        self._evaluated = evaluated
        self._pool = FlyerPool(plan, workers, native)

    def evaluate(self, tasks: Sequence[EvaluationTask], bar: AdmissionThreshold | None) -> list[Evaluation]:
        """Return evaluations in the order of the tasks. Raises InputError for an objective below 0."""
        evaluations: dict[int, Evaluation] = {}
        work = [(self._overlay(task), self._expressions, task.known, bar) for task in tasks]
        for place, evaluation in self._pool.work(fly_law, work):
            evaluations[place] = evaluation
            self._evaluated()
        return [evaluations[place] for place in range(len(tasks))]

    def _overlay(self, task: EvaluationTask) -> dict[str, ParameterValue]:
        law = NetworkOperator(self._basic.name, task.law.matrix, task.law.q, self._basic.exp_saturation)
        return dict(law_parameters(law, self._component))

    def __enter__(self) -> FlightEvaluator:
        self._pool.__enter__()
        return self

    def __exit__(self, *error: object) -> None:
        self._pool.__exit__(*error)


def fly_law(
    flyer: Flyer,
    overlay: dict[str, ParameterValue],
    expressions: Sequence[Expression],
    known: Evaluation,
    bar: AdmissionThreshold | None,
) -> Evaluation:
    """Simulate the unknown trials of a law in order, until the last or until the bar rejects the sums."""
    sums, successes, flown = known
    trials = flyer.plan.campaign.trials
    changes: dict[str, ParameterValue] | None = overlay
    while flown < trials:
        result = flyer.fly_one(VARIANT, flown, changes)
        changes = None  # the law is unchanged
        values = [objective_value(expression, result, flown) for expression in expressions]
        sums = tuple(total + value for total, value in zip(sums, values, strict=True))
        successes += result.success
        flown += 1
        if flown < trials and bar is not None and bar.rejects(sums):
            break
    return Evaluation(sums, successes, flown)


def objective_value(expression: Expression, result: TrialResult, trial: int) -> float:
    """Return an objective in one trial; inf if it is NaN, as after a failed simulation."""
    value = float(np.asarray(expression.evaluate(result.metrics)))
    if math.isnan(value):
        return math.inf
    if value < 0.0:
        problem = f"{value:g} in trial {trial}"
        raise InputError(*expression.where, problem, "write an expression that is never below 0, such as abs(...)")
    return value
