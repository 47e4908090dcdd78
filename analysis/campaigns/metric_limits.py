"""Limits imposed by success and requirements on single metrics, and the worst trial with respect to such limits."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from .definition.expressions import Expression, path_name
from .trials import TrialTable

RISING, FALLING = (ast.Lt, ast.LtE), (ast.Gt, ast.GtE)


@dataclass(frozen=True)
class MetricLimits:
    """Least and greatest permitted value of a metric, in the metric's unit; infinite if there is no limit."""

    low: float = -math.inf
    high: float = math.inf

    @property
    def better(self) -> int:
        """-1 if smaller values are better, 1 if larger values are better, 0 with limits on both sides."""
        return (self.low > -math.inf) - (self.high < math.inf)

    def excess(self, values: np.ndarray) -> np.ndarray:
        """Return the distance beyond the nearer limit, negative for values within both limits."""
        return np.maximum(self.low - values, values - self.high)


def metric_limits(expressions: Iterable[Expression]) -> dict[str, MetricLimits]:
    """Return the limits on single metrics implied by all expressions, by name.

    Metrics in sums, `or` or `not` have no limits, since a single one of these metrics decides nothing.
    """
    limits: dict[str, MetricLimits] = {}
    for expression in expressions:
        for name, low, high in _comparisons(ast.parse(expression.text, mode="eval").body):
            before = limits.get(name, MetricLimits())
            limits[name] = MetricLimits(max(before.low, low), min(before.high, high))
    return limits


def _comparisons(node: ast.expr) -> Iterator[tuple[str, float, float]]:
    """Yield name, least and greatest value from comparisons, joined by `and`, of a metric with a number."""
    if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.And):
        for each in node.values:
            yield from _comparisons(each)
    if not isinstance(node, ast.Compare):
        return
    operands = (node.left, *node.comparators)
    for left, operator, right in zip(operands, node.ops, operands[1:], strict=False):
        smaller, larger = (left, right) if isinstance(operator, RISING) else (right, left)
        if not isinstance(operator, RISING + FALLING):
            continue
        if (name := path_name(smaller)) is not None and (number := _number(larger)) is not None:
            yield name, -math.inf, number
        elif (name := path_name(larger)) is not None and (number := _number(smaller)) is not None:
            yield name, number, math.inf


def _number(node: ast.expr) -> float | None:
    """Return the value of an expression without variables, or None."""
    expression = Expression(ast.unparse(node))
    value = math.nan if expression.names else float(expression.evaluate({}))
    return value if math.isfinite(value) else None


def worst_row(values: np.ndarray, excess: Callable[[np.ndarray], np.ndarray]) -> tuple[int, float]:
    """Return the first row with the largest ``excess``, and this excess; nan counts as infinite."""
    beyond = np.where(np.isfinite(values), excess(values), np.inf)
    row = int(np.argmax(beyond))
    return row, float(beyond[row])


def worst_trial(rows: TrialTable, metric: str, excess: Callable[[np.ndarray], np.ndarray]) -> tuple[int, float]:
    """Return the first trial with the largest ``excess`` of a metric, and the value of the metric in it."""
    column, trial, value, largest = f"metric.{metric}", 0, math.nan, -math.inf
    for part in rows.parts("trial", column):
        row, beyond = worst_row(part[column], excess)
        if beyond > largest:
            trial, value, largest = int(part["trial"][row]), float(part[column][row]), beyond
    return trial, value
