"""Network operator: operations, decoding and evaluation.

Truth: the formulas of the operations in numpy; the same network evaluated from its outputs backwards, node by node,
with Python's functions; matrices with one error. Tolerance: 4 rounding errors for a single operation, and equality for
the evaluation, which is the same arithmetic in a different order of nodes.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib import network_operator as no
from tests.support.laws.operations import FORMULAS, LARGE, backwards
from tests.support.lengths import either

ROUNDING = 4 * 2.0**-53

# Beyond saturation and at the poles: (operation, argument, value).
EDGES = [
    (2, 1e5, LARGE),
    (2, -1e4, LARGE),
    (4, 0.0, 0.0),
    (5, 0.0, LARGE),
    (5, 1e-8, LARGE),
    (5, -1e-9, -LARGE),
    (6, -800.0, 0.0),
    (7, 0.0, math.log(1e-8)),
    (8, 1e8, 1.0),
    (8, -1e8, -1.0),
    (9, 0.0, 1.0),
    (10, 0.0, 1.0),
    (14, 1e3, LARGE),
    (14, -1e3, -LARGE),
    (15, 0.0, 0.0),
    (15, -8.0, -2.0),
    (16, 1.5, 1.0),
    (17, 0.0, 0.0),
    (18, 18.5, LARGE),
    (18, -1e8, -LARGE),
    (19, 0.0, 1.0),
    (19, 1e8, 0.0),
    (23, 1e3, -LARGE),
    (23, -1e3, LARGE),
]


def test_the_table_is_complete():
    assert sorted(FORMULAS) == list(no.UNARY_OPERATIONS)
    assert [k for k in range(-3, 40) if no.is_unary(k)] == list(no.UNARY_OPERATIONS)
    assert [k for k in range(-3, 40) if no.is_binary(k)] == list(no.BINARY_OPERATIONS)
    assert (no.EPSILON, no.LARGEST) == (1e-8, LARGE)
    assert math.exp(no.LOG_LARGEST) == pytest.approx(LARGE, rel=1e-14)


@pytest.mark.parametrize("operation", FORMULAS)
@given(z=st.floats(-18.0, 18.0).filter(lambda z: abs(z) > 1e-6))
@settings(max_examples=either(100, 8), deadline=None)
def test_unary_operations_are_their_formulas(operation, z):
    # 1 - exp(-z) and exp|z| - 1 lose what is below one rounding error of 1; so does the log of nearly 1
    assert no.unary(operation, z, LARGE) == pytest.approx(float(FORMULAS[operation](z)), rel=ROUNDING, abs=ROUNDING)


@pytest.mark.parametrize(("operation", "z", "value"), EDGES)
def test_unary_operations_saturate(operation, z, value):
    assert no.unary(operation, z, LARGE) == pytest.approx(value, rel=1e-15, abs=1e-300)


@pytest.mark.parametrize("saturation", [LARGE, no.LOG_LARGEST])
def test_exp_saturates_at_either_value(saturation):
    assert no.unary(6, 18.42, saturation) == math.exp(18.42)
    assert no.unary(6, 18.43, saturation) == saturation
    assert no.unary(6, 1e300, saturation) == saturation


@pytest.mark.parametrize(("operation", "truth"), [(0, lambda a, b: a + b), (1, lambda a, b: a * b), (2, max), (3, min)])
@given(a=st.floats(-1e4, 1e4), b=st.floats(-1e4, 1e4))
@settings(max_examples=either(60, 8), deadline=None)
def test_binary_operations(operation, truth, a, b):
    assert no.binary(operation, a, b) == truth(a, b)
    assert no.binary(operation, no.neutral(operation), a) == a


def test_products_saturate():
    assert no.binary(1, 1e5, 1e5) == LARGE
    assert no.binary(1, -1e5, 1e5) == -LARGE


# ---- whole networks ----------------------------------------------------------------------------------------


def a_network(generator, density=0.3):
    matrix = np.zeros((16, 16), int)
    for i in range(16):
        matrix[i, i] = generator.choice(no.BINARY_OPERATIONS) if i >= 6 else 0
        for j in range(max(i + 1, 6), 16):
            if generator.random() < density:
                matrix[i, j] = generator.choice(no.UNARY_OPERATIONS)
    return matrix


def evaluated(matrix, sources):
    edges = [0] * no.MAXIMUM_EDGES
    law = Matrix(matrix.tolist())
    count = no.decode(law, edges)
    assert count == np.count_nonzero(np.triu(matrix, 1))
    nodes = [*sources, *(no.neutral(law[j, j]) for j in range(len(sources), 16))]
    no.evaluate(law, edges, count, LARGE, nodes)
    return nodes


def test_random_networks_are_evaluated_in_order():
    generator = np.random.default_rng(1)
    for _ in range(100):
        matrix, sources = a_network(generator, 0.2), generator.normal(size=6).tolist()
        nodes = evaluated(matrix, sources)
        value_of = backwards(matrix, sources, lambda operation, z: no.unary(operation, z, LARGE))
        assert nodes == [value_of(node) for node in range(16)]


@given(
    seed=st.integers(0, 2**32 - 1),
    sources=st.lists(st.sampled_from([0.0, -0.0, 1e-12, 1.0, -1.0, math.pi, 1e8, -1e8]), min_size=6, max_size=6),
)
@settings(max_examples=either(200, 16), deadline=None)
def test_no_network_faults(seed, sources):
    nodes = evaluated(a_network(np.random.default_rng(seed), 0.8), sources)
    assert all(math.isfinite(value) for value in nodes)


@pytest.mark.parametrize(
    ("row", "column", "value"),
    [(0, 1, 22), (2, 5, 24), (0, 15, -1), (1, 0, 1), (15, 14, 3), (8, 8, 4), (15, 15, -1)],
)
def test_what_is_no_network_operator_is_told(row, column, value):
    """Unknown unary operations, entries below the diagonal, unknown binary operations."""
    matrix = a_network(np.random.default_rng(2))
    edges = [0] * no.MAXIMUM_EDGES
    assert no.decode(Matrix(matrix.tolist()), edges) >= 0
    matrix[row, column] = value
    assert no.decode(Matrix(matrix.tolist()), edges) == -1


def test_a_full_matrix_fits():
    matrix = np.triu(np.ones((16, 16), int))
    assert no.decode(Matrix(matrix.tolist()), [0] * no.MAXIMUM_EDGES) == no.MAXIMUM_EDGES
