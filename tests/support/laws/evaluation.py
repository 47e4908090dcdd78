"""A law's value from its expression tree, node by node."""

from __future__ import annotations

import math
from collections.abc import Mapping

from perilune.analysis.design.laws.expression_tree import SOURCE_NAMES, expression_tree, nodes_of
from perilune.analysis.design.laws.law import NetworkOperator
from perilune.fmus_src.mathlib.network_operator import LARGEST, LOG_LARGEST, binary, neutral, unary


def evaluate_tree(law: NetworkOperator, theta: float, altitude_error: float) -> tuple[float, ...]:
    """Evaluate the law's outputs, unclipped: thrust angle (rad) and thrust above nominal (kgf).

    ``theta`` is the path angle (rad), ``altitude_error`` is (hf - h)/h0.
    """
    q1, q2, q3 = law.q
    sources: Mapping[str, float] = dict(
        zip(SOURCE_NAMES, (math.pi + theta, q1, altitude_error, q2, theta, q3), strict=True)
    )
    exp_saturation = LOG_LARGEST if law.exp_saturation == "legacy" else LARGEST
    outputs = expression_tree(law.matrix)
    values: dict[int, float] = {}
    for node in nodes_of(outputs):
        value = neutral(node.operation) if node.source is None else sources[node.source]
        for operation, other in node.terms:
            value = binary(node.operation, value, unary(operation, values[other.number], exp_saturation))
        values[node.number] = value
    return tuple(values[output.number] for output in outputs)
