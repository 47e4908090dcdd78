"""Control law as formulas, one line for each shared subexpression and each output."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple

from .expression_tree import (
    ATOM,
    IDENTITY,
    MAXIMUM,
    NEGATIVE,
    OUTPUT_NUMBERS,
    POWER_LEVEL,
    PRODUCT,
    PRODUCT_LEVEL,
    RECIPROCAL,
    SUM,
    SUM_LEVEL,
    UNARY,
    OperationNode,
    expression_tree,
    nodes_of,
)
from .law import NetworkOperator

LONGEST_INLINE = 40  # longest subexpression, in characters, that is written where it is used
SOURCE_LEVELS = {"pi + theta": SUM_LEVEL, "(hf - h)/h0": PRODUCT_LEVEL}


# operations whose formula contains the argument more than once, or between bars
NEEDS_A_NAME = {
    number for number, notation in UNARY.items() if notation.formula.count("{z}") > 1 or "|" in notation.formula
}


class FormulaText(NamedTuple):
    """Part of a formula, with its precedence level."""

    text: str
    level: int

    def at(self, level: int) -> str:
        """Return the text, in parentheses if its precedence is below ``level``."""
        return self.text if self.level >= level else f"({self.text})"


def formula(law: NetworkOperator) -> dict[str, str]:
    """Return the right sides of the formulas by left side, in order of evaluation; the outputs are z15 and z16."""
    outputs = expression_tree(law.matrix)
    nodes = nodes_of(outputs)
    uses = Counter(other.number for node in nodes for _, other in node.terms)
    named = {other.number for node in nodes for operation, other in node.terms if operation in NEEDS_A_NAME}
    lines: dict[str, str] = {}
    known: dict[int, FormulaText] = {}
    for node in nodes:
        text = _node(node, known)
        shared = uses[node.number] > 1 or node.number in named
        if node.number in OUTPUT_NUMBERS or (
            not text.text.isidentifier() and (shared or len(text.text) > LONGEST_INLINE)
        ):
            lines[f"z{node.number}"] = text.text
            text = FormulaText(f"z{node.number}", ATOM)
        known[node.number] = text
    return lines


def _node(node: OperationNode, known: Mapping[int, FormulaText]) -> FormulaText:
    parts = (
        [(IDENTITY, FormulaText(node.source, SOURCE_LEVELS.get(node.source, ATOM)))] if node.source is not None else []
    )
    parts += [(operation, known[other.number]) for operation, other in node.terms]
    if not parts:
        return FormulaText({SUM: "0", PRODUCT: "1", MAXIMUM: "-1e8"}.get(node.operation, "1e8"), ATOM)
    if len(parts) == 1:
        return _unary(*parts[0])
    if node.operation == SUM:
        return _sum(parts)
    if node.operation == PRODUCT:
        return _product(parts)
    name = "max" if node.operation == MAXIMUM else "min"
    return FormulaText(f"{name}({', '.join(_unary(*part).text for part in parts)})", ATOM)


def _unary(operation: int, argument: FormulaText) -> FormulaText:
    if operation == IDENTITY:
        return argument
    notation = UNARY[operation]
    return FormulaText(notation.formula.format(z=argument.at(notation.argument)), notation.level)


def _sum(parts: list[tuple[int, FormulaText]]) -> FormulaText:
    text = ""
    for part in parts:
        term = _unary(*part).text
        if not text:
            text = term
        elif term.startswith("-"):
            text += f" - {term[1:]}"
        else:
            text += f" + {term}"
    return FormulaText(text, SUM_LEVEL)


def _product(parts: list[tuple[int, FormulaText]]) -> FormulaText:
    negative = False
    text = ""
    for operation, argument in parts:
        if operation == NEGATIVE:
            negative = not negative
            factor = argument
        else:
            factor = _unary(operation, argument)
        if operation == RECIPROCAL and text:
            text += f"/{argument.at(POWER_LEVEL)}"
        else:
            text += ("*" if text else "") + factor.at(PRODUCT_LEVEL)
    return FormulaText(f"-{text}", SUM_LEVEL) if negative else FormulaText(text, PRODUCT_LEVEL)
