"""Operators in C: their precedence, the precedence of Python's operators, and functions that replace operators."""

from __future__ import annotations

import ast

OR, AND, EQUALITY, RELATION, SUM, PRODUCT, UNARY, ATOM = range(8)  # precedence in C; 0 is the lowest
CONDITIONAL = -1
OPERATORS: dict[type[ast.AST], tuple[str, int]] = {
    ast.Add: ("+", SUM),
    ast.Sub: ("-", SUM),
    ast.Mult: ("*", PRODUCT),
    ast.Div: ("/", PRODUCT),
    ast.Lt: ("<", RELATION),
    ast.LtE: ("<=", RELATION),
    ast.Gt: (">", RELATION),
    ast.GtE: (">=", RELATION),
    ast.Eq: ("==", EQUALITY),
    ast.NotEq: ("!=", EQUALITY),
}
CHECKED_INT: dict[type[ast.AST], str] = {ast.Add: "py_add", ast.Sub: "py_subtract", ast.Mult: "py_multiply"}
VECTOR_NAMES: dict[type[ast.AST], str] = {
    ast.Add: "add",
    ast.Sub: "subtract",
    ast.Mult: "multiply",
    ast.Div: "divide",
}


def parenthesise(expression: tuple[str, int], outer: int) -> str:
    """Return the text of an expression, in parentheses if the surrounding operator has higher precedence.

    ``expression`` contains text and precedence.
    """
    text, precedence = expression
    return f"({text})" if precedence < outer else text
