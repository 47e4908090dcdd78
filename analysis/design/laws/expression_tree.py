"""Expression trees of a network operator, one for each output, and the notation of operations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ....fmus_src.mathlib.network_operator import SIZE

MINUS = "\N{MINUS SIGN}"
SOURCE_NAMES = ("pi + theta", "q1", "(hf - h)/h0", "q2", "theta", "q3")  # nodes 1 to 6
OUTPUT_NUMBERS = (15, 16)  # counted from 1, as printed


@dataclass(frozen=True, eq=False)
class OperationNode:
    """Node on which an output depends: ``number`` (from 1), binary ``operation``, and operands.

    ``source`` is the node's first operand, None for the neutral element of its operation; ``terms`` are the unary
    operations and the nodes at the other ends of its edges, in the order of evaluation.
    """

    number: int
    operation: int
    source: str | None
    terms: tuple[tuple[int, OperationNode], ...]


def expression_tree(matrix: Sequence[Sequence[int]]) -> tuple[OperationNode, ...]:
    """Return the nodes of the outputs, u1 and u2."""
    nodes: dict[int, OperationNode] = {}
    for column in range(SIZE):
        terms = [(matrix[row][column], nodes[row + 1]) for row in range(column) if matrix[row][column]]
        source = SOURCE_NAMES[column] if column < len(SOURCE_NAMES) else None
        nodes[column + 1] = OperationNode(column + 1, matrix[column][column], source, tuple(terms))
    return tuple(nodes[output] for output in OUTPUT_NUMBERS)


def nodes_of(outputs: Sequence[OperationNode]) -> list[OperationNode]:
    """Return all nodes on which the outputs depend, including the outputs, in order of number."""
    nodes: dict[int, OperationNode] = {}

    def walk(node: OperationNode) -> Iterator[OperationNode]:
        yield node
        for _, other in node.terms:
            if other.number not in nodes:
                yield from walk(other)

    for output in outputs:
        for node in walk(output):
            nodes[node.number] = node
    return [nodes[number] for number in sorted(nodes)]


SUM, PRODUCT, MAXIMUM, MINIMUM = range(4)
IDENTITY, NEGATIVE, RECIPROCAL = 1, 3, 5


class Notation(NamedTuple):
    """Notation of an operation: ``formula`` has {z} for the argument; ``edge`` is the short form for drawings.

    ``level`` is the precedence of the formula: SUM_LEVEL, PRODUCT_LEVEL, POWER_LEVEL or ATOM; ``argument`` is the least
    precedence of an argument without parentheses.
    """

    formula: str
    edge: str
    level: int
    argument: int


SUM_LEVEL, PRODUCT_LEVEL, POWER_LEVEL, ATOM = range(4)

UNARY = {
    1: Notation("{z}", "", ATOM, SUM_LEVEL),
    2: Notation("{z}^2", "z²", POWER_LEVEL, ATOM),
    3: Notation("-{z}", f"{MINUS}z", SUM_LEVEL, PRODUCT_LEVEL),
    4: Notation("sgn({z})*sqrt(|{z}|)", "sgn z √|z|", PRODUCT_LEVEL, SUM_LEVEL),
    5: Notation("1/{z}", "1/z", PRODUCT_LEVEL, POWER_LEVEL),
    6: Notation("exp({z})", "exp", ATOM, SUM_LEVEL),
    7: Notation("ln(|{z}|)", "ln|z|", ATOM, SUM_LEVEL),
    8: Notation("(1 - exp(-{z}))/(1 + exp(-{z}))", f"(1{MINUS}e⁻ᶻ)/(1+e⁻ᶻ)", PRODUCT_LEVEL, PRODUCT_LEVEL),
    9: Notation("step({z})", "step", ATOM, SUM_LEVEL),
    10: Notation("sgn({z})", "sgn", ATOM, SUM_LEVEL),
    11: Notation("cos({z})", "cos", ATOM, SUM_LEVEL),
    12: Notation("sin({z})", "sin", ATOM, SUM_LEVEL),
    13: Notation("atan({z})", "atan", ATOM, SUM_LEVEL),
    14: Notation("{z}^3", "z³", POWER_LEVEL, ATOM),
    15: Notation("cbrt({z})", "∛z", ATOM, SUM_LEVEL),
    16: Notation("clip({z}, -1, 1)", "clip ±1", ATOM, SUM_LEVEL),
    17: Notation("sgn({z})*ln(|{z}| + 1)", "sgn z ln(|z|+1)", PRODUCT_LEVEL, SUM_LEVEL),
    18: Notation("sgn({z})*(exp(|{z}|) - 1)", f"sgn z (e^|z|{MINUS}1)", PRODUCT_LEVEL, SUM_LEVEL),
    19: Notation("sgn({z})*exp(-|{z}|)", f"sgn z e^{MINUS}|z|", PRODUCT_LEVEL, SUM_LEVEL),
    20: Notation("{z}/2", "z/2", PRODUCT_LEVEL, PRODUCT_LEVEL),
    21: Notation("2*{z}", "2z", PRODUCT_LEVEL, PRODUCT_LEVEL),
    23: Notation("{z} - {z}^3", f"z{MINUS}z³", SUM_LEVEL, ATOM),
}
BINARY = {SUM: "+", PRODUCT: "\N{MULTIPLICATION SIGN}", MAXIMUM: "max", MINIMUM: "min"}
