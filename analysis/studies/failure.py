"""Failure as a number: the signed distance of a trial from failure, derived from an expression that is true on failure.

``a > b`` becomes the margin a - b, ``and`` the smaller of two margins, ``or`` the larger, ``not`` the margin of the
opposite condition. A trial has failed if its margin is 0 or more; larger is worse.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping

import numpy as np

from ...common.errors import InputError, suggestion
from ..campaigns.definition.campaign import Campaign
from ..campaigns.definition.expressions import Expression, Where

Margin = Callable[[Mapping[str, np.ndarray]], np.ndarray]
NEVER = -np.nextafter(0.0, 1.0)  # margin of a strict comparison of equal numbers: just below failure
OPPOSITE: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.GtE,
    ast.LtE: ast.Gt,
    ast.Gt: ast.LtE,
    ast.GtE: ast.Lt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
}


class Failure:
    """Failure condition of a trial, with its margin.

    ``names`` are metrics, drawn and derived values. A trial in which one of these is not finite, or a metric in the
    success expression is not finite, is a failure with the margin inf.
    """

    def __init__(self, expression: Expression) -> None:
        self.expression = expression
        self.text = expression.text
        self.names = expression.names
        self._margin = _margin(ast.parse(expression.text, mode="eval").body, False, expression.where)

    def margins(self, values: Mapping[str, np.ndarray], flown: np.ndarray) -> np.ndarray:
        """Return the margin of every trial (trials,): 0 or more exactly if the expression is true.

        ``values`` has an array (trials,) for every name. A trial whose simulation did not complete, False in ``flown``
        (trials,), is a failure.
        """
        columns = {name: np.asarray(values[name], dtype=float) for name in self.names}
        finite = np.array(flown, dtype=bool)
        for column in columns.values():
            finite &= np.isfinite(column)
        margins = np.broadcast_to(self._margin(columns), finite.shape)
        return np.where(finite & ~np.isnan(margins), margins, np.inf)


def failure_of(campaign: Campaign, text: str | None) -> Failure:
    """Return the failure defined by an expression over metrics and draws, by default lack of success.

    Raises InputError.
    """
    if text is None:
        return Failure(Expression(f"not ({campaign.success.text})", campaign.success.where))
    requested = Failure(Expression(text, ("`failure`", text)))
    known = [metric.name for metric in campaign.metrics] + campaign.input_names()
    for name in sorted(requested.names - set(known)):
        raise InputError("`failure`", name, "neither a metric nor a draw of the campaign", suggestion(name, known))
    return requested


def _margin(node: ast.expr, negated: bool, where: Where) -> Margin:
    """Return the margin of a subexpression, or of its opposite."""
    match node:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return _margin(operand, not negated, where)
        case ast.BoolOp(op=joint, values=values):
            either = isinstance(joint, ast.Or) != negated  # not (a and b) is not a or not b
            return _join_limit_states([_margin(value, negated, where) for value in values], either)
        case ast.Compare(left=left, ops=operators, comparators=comparators):
            sides = [left, *comparators]
            links = []
            for index, operator in enumerate(operators):
                kind = OPPOSITE[type(operator)] if negated else type(operator)
                links.append(_difference(sides[index], kind, sides[index + 1], where))
            return _join_limit_states(links, negated)
    nothing = ast.Constant(0)
    return _difference(node, ast.Eq if negated else ast.NotEq, nothing, where)


def _join_limit_states(margins: list[Margin], either: bool) -> Margin:
    """Return the margin of a condition that one (``either``) or all of several conditions are true."""
    join = np.maximum if either else np.minimum
    return lambda values: join.reduce(np.broadcast_arrays(*(margin(values) for margin in margins)))


def _difference(left: ast.expr, operator: type[ast.cmpop], right: ast.expr, where: Where) -> Margin:
    """Return the margin of one comparison, from the difference of its sides; nan if it is unknown."""
    above = Expression(f"({ast.unparse(left)}) - ({ast.unparse(right)})", where)

    def margin(values: Mapping[str, np.ndarray]) -> np.ndarray:
        difference = np.asarray(above.evaluate(values))
        if operator in (ast.Lt, ast.LtE):
            difference = -difference
        elif operator in (ast.Eq, ast.NotEq):
            difference = np.abs(difference)
        if operator is ast.Eq:
            return np.where(difference == 0.0, 0.0, -difference)
        strict = operator in (ast.Lt, ast.Gt, ast.NotEq)
        return np.where(difference == 0.0, NEVER if strict else 0.0, difference)

    return margin
