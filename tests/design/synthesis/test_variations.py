"""Variations of a network operator.

Truth: the properties of a network operator, checked on the matrix with a transitive closure in numpy; evaluation by the
blocks' kernel, before and after.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.analysis.design.laws.law import find_law, read_law
from perilune.analysis.design.synthesis.variations import (
    ADD_EDGE,
    CHANGE_BINARY,
    CHANGE_UNARY,
    NO_VARIATION,
    NOTHING,
    REMOVE_EDGE,
    Variation,
    apply_variations,
    prune,
    random_variation,
)
from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib import network_operator
from tests.support.laws.networks import SIZE, SOURCES, depends, matrices

BASIC = read_law(find_law("diveev_2013_basic")).matrix
SEEDS = st.integers(0, 2**32)


def drawn(seed, count, matrix=BASIC):
    """Draw variations for one matrix, that is mostly not where the others leave something to vary."""
    random = np.random.Generator(np.random.PCG64(seed))
    return [random_variation(random, matrix) for _ in range(count)]


@settings(deadline=None)
@given(matrices(), SEEDS, st.integers(0, 60))
def test_variations_keep_what_a_network_operator_is(matrix, seed, count):
    actual = np.array(apply_variations(matrix, drawn(seed, count, matrix)))
    assert not np.tril(actual, -1).any()
    edges = actual[np.triu_indices(SIZE, 1)]
    assert set(edges.tolist()) <= {0, *network_operator.UNARY_OPERATIONS}
    assert set(np.diagonal(actual).tolist()) <= set(network_operator.BINARY_OPERATIONS)
    before, after = depends(matrix), depends(actual)
    for node in range(SOURCES, SIZE):
        leads_on = after[node].any()
        if leads_on or before[:SOURCES, node].any():
            assert after[:SOURCES, node].any(), f"node {node + 1} has lost the sources"
    assert after[:SOURCES, SIZE - 2].any()
    assert after[:SOURCES, SIZE - 1].any()


@given(SEEDS)
def test_no_edge_leads_to_a_source(seed):
    actual = np.array(apply_variations(BASIC, drawn(seed, 100)))
    assert not actual[:, :SOURCES].any()


def test_each_kind_does_what_it_says():
    changed = np.array(apply_variations(BASIC, [Variation(CHANGE_UNARY, 2, 7, 12)]))
    assert changed[2, 7] == 12
    changed = np.array(apply_variations(BASIC, [Variation(CHANGE_BINARY, 10, 10, 0)]))
    assert changed[10, 10] == 0
    changed = np.array(apply_variations(BASIC, [Variation(ADD_EDGE, 0, 15, 6)]))
    assert changed[0, 15] == 6
    # z8 gathers z3 and z4; z3 leads to z8 and z11
    changed = np.array(apply_variations(BASIC, [Variation(REMOVE_EDGE, 2, 7, 1)]))
    assert changed[2, 7] == 0
    for variation in (
        Variation(CHANGE_UNARY, 0, 15, 6),  # no edge there
        Variation(ADD_EDGE, 2, 7, 12),  # an edge is there
        Variation(REMOVE_EDGE, 3, 7, 1),  # the only edge from z4
        Variation(REMOVE_EDGE, 9, 14, 1),  # the only edge from z10
        Variation(REMOVE_EDGE, 12, 15, 1),  # the only edge into z16
        NO_VARIATION,
    ):
        assert apply_variations(BASIC, [variation]) == BASIC


def test_an_edge_from_a_node_that_gathers_nothing_is_not_added():
    empty = [list(row) for row in BASIC]
    empty[6][9] = 0
    empty[9][14] = 0  # z10 gathers nothing, leads nowhere
    matrix = tuple(map(tuple, empty))
    assert apply_variations(matrix, [Variation(ADD_EDGE, 9, 14, 1)]) == matrix
    fed = apply_variations(matrix, [Variation(ADD_EDGE, 6, 9, 1), Variation(ADD_EDGE, 9, 14, 1)])
    assert fed == BASIC


def test_random_variations_are_of_all_kinds_and_places():
    actual = drawn(1, 20_000)
    kinds = [variation.kind for variation in actual]
    assert NOTHING not in kinds
    for kind in (CHANGE_UNARY, CHANGE_BINARY, ADD_EDGE, REMOVE_EDGE):
        assert kinds.count(kind) == pytest.approx(5000, abs=5 * math.sqrt(20_000 * 3 / 16))
    there = {(int(row), int(column)) for row, column in np.argwhere(np.triu(BASIC, 1))}
    free = {(row, column) for column in range(SOURCES, SIZE) for row in range(column)} - there
    places = {kind: {(v.row, v.column) for v in actual if v.kind == kind} for kind in set(kinds)}
    assert places[CHANGE_UNARY] == places[REMOVE_EDGE] == there
    assert places[ADD_EDGE] == free
    assert places[CHANGE_BINARY] == {(node, node) for node in range(SOURCES, SIZE)}
    operations = {variation.operation for variation in actual if variation.kind == ADD_EDGE}
    assert operations == {*range(1, 20), 23}
    assert {variation.operation for variation in actual if variation.kind == CHANGE_BINARY} == {0, 1}


def test_a_matrix_without_room_for_a_kind_can_still_be_varied():
    full = tuple(tuple(int(column > max(row, SOURCES - 1)) for column in range(SIZE)) for row in range(SIZE))
    for variation in drawn(2, 200, full):
        apply_variations(full, [variation])


def kernel_outputs(matrix, sources, exp_saturation=1e8):
    """Return z15 and z16 by the kernel functions of the blocks."""
    rows = Matrix([list(row) for row in matrix])
    edges = [0] * network_operator.MAXIMUM_EDGES
    count = network_operator.decode(rows, edges)
    nodes = [*sources, *(network_operator.neutral(matrix[node][node]) for node in range(SOURCES, SIZE))]
    network_operator.evaluate(rows, edges, count, exp_saturation, nodes)
    return nodes[14], nodes[15]


@settings(deadline=None)
@given(matrices(), SEEDS, st.tuples(*[st.floats(-20.0, 20.0)] * SOURCES))
def test_what_leads_nowhere_is_pruned_and_nothing_else(matrix, seed, sources):
    matrix = apply_variations(matrix, drawn(seed, 8))
    actual = prune(matrix)
    assert kernel_outputs(actual, sources) == kernel_outputs(matrix, sources)
    assert prune(actual) == actual
    reach = depends(actual)
    for row in range(SIZE - 2):
        assert not np.array(actual)[row].any() or reach[row, SIZE - 2 :].any()
    retained = np.array(actual) == np.array(matrix)
    leads = depends(matrix)[:, SIZE - 2 :].any(axis=1)
    leads[SIZE - 2 :] = True
    assert retained[np.ix_(leads, leads)].all()
