"""Units of the numbers in a study: drawn parameters, metrics, and expressions."""

from __future__ import annotations

import ast
from collections.abc import Mapping

from ..campaigns.definition.expressions import Expression
from ..runtime.system.prepared import PreparedSystem
from .draw_space import DrawSpace
from .sample_flights import StudyProvenance

SUMS = (ast.Add, ast.Sub)


def units_of(space: DrawSpace, prepared: PreparedSystem, facts: StudyProvenance) -> dict[str, str]:
    """Return the units of draws and metrics by name, without those of unknown unit."""
    units: dict[str, str | None] = {name: fact["unit"] for name, fact in facts["metrics"].items()}
    for draw in space.campaign.draws:
        for name in draw.names:
            component = max(
                (part for part in prepared.network.fmus if name.startswith(f"{part}.")), key=len, default=""
            )
            if component:
                fmu = prepared.network.fmus[component]
                units[name] = fmu.variables[name.removeprefix(f"{component}.")].unit
    return {name: unit for name, unit in units.items() if unit and unit != "1"}


def unit_of_expression(expression: Expression, units: Mapping[str, str]) -> str:
    """Return the unit of a sum or comparison of numbers and values of one unit, otherwise ""."""
    candidates = {units.get(name, "") for name in expression.names}
    return candidates.pop() if len(candidates) == 1 and _is_linear(ast.parse(expression.text, mode="eval").body) else ""


def _is_linear(node: ast.expr) -> bool:
    match node:
        case ast.Name() | ast.Constant() | ast.Attribute() | ast.Subscript():
            return True
        case ast.UnaryOp(operand=operand):
            return _is_linear(operand)
        case ast.BinOp(left=left, op=operator, right=right):
            return isinstance(operator, SUMS) and _is_linear(left) and _is_linear(right)
        case ast.Compare(left=left, comparators=comparators):
            return all(map(_is_linear, (left, *comparators)))
        case ast.BoolOp(values=values):
            return all(map(_is_linear, values))
    return False
