"""What is to be worst: a number of every trial, the larger the worse."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ...campaigns.spec.campaign import Campaign
from ...campaigns.spec.expressions import Expression
from ...campaigns.spec.failure import failure_of
from ...common.errors import InputError, suggestion
from ..evaluation.flown import strict


@dataclass(frozen=True)
class Badness:
    """A number of every trial: called with values by name (trials,) and which flights came to their end (trials,).

    It is inf where a flight did not, or where the number is not finite. ``text`` says what it is, ``size`` the number
    that it stands for, and ``fact`` that number, or one of the values, as JSON has it; ``expression`` is what it is the
    value or the margin of, None where its text says its unit.
    """

    text: str
    of: Callable[[Mapping[str, np.ndarray], np.ndarray], np.ndarray]
    size: Callable[[float], float] = float
    fact: Callable[[float], float | str | None] = strict
    expression: Expression | None = None

    def __call__(self, values: Mapping[str, np.ndarray], flown: np.ndarray) -> np.ndarray:
        return self.of(values, flown)


def badness_of(campaign: Campaign, text: str | None) -> Badness:
    """Of an expression over metrics and draws, or without one of the margin by which a trial is no success.

    Raises InputError.
    """
    if text is None:
        failure = failure_of(campaign, None)
        return Badness(f"margin of {failure.text}", failure.margins, expression=failure.expression)
    expression = Expression(text, ("`metric`", text))
    known = [metric.name for metric in campaign.metrics] + campaign.input_names()
    for name in sorted(expression.names - set(known)):
        raise InputError("`metric`", name, "neither a metric nor a draw of the campaign", suggestion(name, known))

    def of(values: Mapping[str, np.ndarray], flown: np.ndarray) -> np.ndarray:
        values_of_trials = np.broadcast_to(expression.evaluate(values), flown.shape)
        return np.where(flown & np.isfinite(values_of_trials), values_of_trials, np.inf)

    return Badness(expression.text, of, expression=expression)
