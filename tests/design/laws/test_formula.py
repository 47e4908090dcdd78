"""Formula of a network operator.

Truth: the law that the published matrix encodes and the published basic solution, written out here by hand (Diveev,
Pupkov and Sofronova 2013, with misprints corrected); the printed text read back as Python; the blocks' kernel.
"""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.analysis.design.laws.expression_tree import expression_tree, nodes_of
from perilune.analysis.design.laws.formula import formula
from perilune.analysis.design.laws.law import NetworkOperator, find_law, read_law
from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib import network_operator
from tests.support.laws.evaluation import evaluate_tree
from tests.support.laws.networks import SOURCES, depends, matrices, random_matrix
from tests.support.lengths import either

PAPER = read_law(find_law("diveev_2013"))
BASIC = read_law(find_law("diveev_2013_basic"))
LN_LARGEST = math.log(1e8)


def limited(value):
    return min(max(value, -1e8), 1e8)


def sign(value):
    return -1.0 if value < 0.0 else 1.0


def step(value):
    return 1.0 if value >= 0.0 else 0.0


def exp(value, mode):
    if value > LN_LARGEST:
        return {"true": 1e8, "legacy": LN_LARGEST}[mode]
    return math.exp(value)


def growth(value):
    """Return sgn(z)(e^|z| - 1)."""
    return sign(value) * (1e8 if abs(value) > LN_LARGEST else math.exp(abs(value)) - 1.0)


def reciprocal(value):
    return sign(value) / 1e-8 if abs(value) <= 1e-8 else 1.0 / value


def paper_law(theta, d, q, mode):
    """Return u1 and u2 of the law found, unclipped."""
    q1, q2, q3 = q
    p = math.pi + theta
    s = step(d)
    z7 = limited(q1 * p)
    z8 = limited(q2 * d * (p - p**3))
    z11 = z8 + s
    z12 = -q3 * theta * math.cos(theta)
    a = z11 + sign(d) * math.sqrt(abs(d)) + growth(z12)
    b = reciprocal(q2) + growth(z7) + exp(z11, mode) + exp(z12, mode)
    half = math.tanh(a / 2.0)  # (1 - e^-a)/(1 + e^-a)
    u1 = reciprocal(z7) + step(z8) + half
    return u1, math.copysign(abs(u1) ** (1 / 3), u1) + exp(b, mode) + q3 * theta * math.cos(theta)


def basic_law(theta, d, q):
    q1, q2, q3 = q
    return q1 * (math.pi + theta) + q2 * d * step(d), -q3 * theta * math.cos(theta)


@pytest.mark.parametrize("mode", ["true", "legacy"])
@pytest.mark.parametrize("law", [PAPER, BASIC], ids=lambda law: law.name)
def test_matrices_decode_to_the_published_laws(law, mode):
    random = np.random.default_rng(2013)
    law = NetworkOperator(law.name, law.matrix, law.q, mode)
    for theta, d in zip(random.uniform(-4.0, 1.0, 1000), random.uniform(-1.5, 0.2, 1000), strict=True):
        expected = paper_law(theta, d, law.q, mode) if law.name == PAPER.name else basic_law(theta, d, law.q)
        assert evaluate_tree(law, theta, d) == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_the_slip_in_exp_matters_for_the_published_law():
    """Its saturated value works as a throttle switch: u2 about 20 where it saturates, beyond any limit without."""
    saturated = [
        evaluate_tree(NetworkOperator("", PAPER.matrix, PAPER.q, mode), -1.6, -0.9)[1] for mode in ("legacy", "true")
    ]
    assert saturated[0] == pytest.approx(20.0, abs=1.0)
    assert saturated[1] > 1e7


def test_the_published_law_as_it_is_printed():
    assert formula(PAPER) == {
        "z1": "pi + theta",
        "z3": "(hf - h)/h0",
        "z7": "z1*q1",
        "z8": "(z1 - z1^3)*z3*q2",
        "z11": "step(z3) + z8",
        "z12": "-cos(theta)*theta*q3",
        "z13": "1/q2 + sgn(z7)*(exp(|z7|) - 1) + exp(z11) + exp(z12)",
        "z14": "sgn(z3)*sqrt(|z3|) + z11 + sgn(z12)*(exp(|z12|) - 1)",
        "z15": "step(z8) + 1/z7 + (1 - exp(-z14))/(1 + exp(-z14))",
        "z16": "-z12 + exp(z13) + cbrt(z15)",
    }
    assert formula(BASIC) == {
        "z3": "(hf - h)/h0",
        "z15": "(pi + theta)*q1 + step(z3)*z3*q2",
        "z16": "-cos(theta)*theta*q3",
    }


FUNCTIONS = {
    "step": step,
    "sgn": sign,
    "clip": lambda z, low, high: min(max(z, low), high),
    "cbrt": lambda z: math.copysign(abs(z) ** (1.0 / 3.0), z),
    "ln": lambda z: math.log(max(z, 1e-8)),
    **{name: getattr(math, name) for name in ("sqrt", "cos", "sin", "atan", "pi", "exp")},
    "max": max,
    "min": min,
}


def read_back(law, theta, d):
    """Evaluate the printed lines as Python, with their bars and powers; without saturation."""
    values = dict(zip(("q1", "q2", "q3"), law.q, strict=True), theta=theta, h0=1.0, hf=d, h=0.0)
    for name, text in formula(law).items():
        code = re.sub(r"\|([^|]+)\|", r"abs(\1)", text).replace("^", "**")
        values[name] = eval(code, {"__builtins__": {"abs": abs}, **FUNCTIONS}, values)
    return values["z15"], values["z16"]


def test_what_is_printed_is_what_is_evaluated():
    """Random laws, where nothing saturates and no argument is near a jump or a pole."""
    random = np.random.default_rng(7)
    compared = set()
    for _ in range(either(4000, 1500)):
        law = NetworkOperator("random", random_matrix(random), tuple(random.uniform(0.1, 2.0, 3)), "true")
        theta, d = random.uniform(-3.0, 0.5), random.uniform(-1.0, 1.0)
        if all(1e-3 < abs(value) < 15.0 for value in node_values(law, theta, d)):
            actual = evaluate_tree(law, theta, d)
            assert actual == pytest.approx(read_back(law, theta, d), rel=1e-9), formula(law)
            compared |= set(np.ravel(law.matrix).tolist())
    assert compared == {0, *network_operator.UNARY_OPERATIONS}


def node_values(law, theta, d):
    """Return all nodes that the outputs depend on, by the kernel."""
    matrix = Matrix([list(row) for row in law.matrix])
    edges = [0] * network_operator.MAXIMUM_EDGES
    count = network_operator.decode(matrix, edges)
    nodes = [math.pi + theta, law.q[0], d, law.q[1], theta, law.q[2]]
    nodes += [network_operator.neutral(law.matrix[node][node]) for node in range(SOURCES, 16)]
    network_operator.evaluate(matrix, edges, count, 1e8, nodes)
    reach = depends(law.matrix)[:, 14:].any(axis=1)
    reach[14:] = True
    return [value for value, used in zip(nodes, reach, strict=True) if used]


@settings(deadline=None)
@given(matrices(), st.tuples(*[st.floats(-20.0, 20.0)] * 3), st.floats(-7.0, 7.0), st.floats(-2.0, 2.0))
def test_the_tree_gives_the_kernels_bits(matrix, q, theta, d):
    law = NetworkOperator("random", matrix, q, "true")
    assert evaluate_tree(law, theta, d) == tuple(node_values(law, theta, d)[-2:])


@given(matrices())
def test_the_tree_holds_what_the_outputs_depend_on(matrix):
    reach = depends(matrix)[:, 14:].any(axis=1)
    reach[14:] = True
    assert [node.number for node in nodes_of(expression_tree(matrix))] == (np.flatnonzero(reach) + 1).tolist()
