"""Small variations of a network operator's matrix: the difference between a candidate and the basic solution.

Every sequence of variations turns an admissible matrix into an admissible one. An admissible matrix is upper
triangular, every node with an outgoing edge that is not a source also has an incoming edge, and each output has an
incoming edge. A variation that does not apply changes nothing; it may apply after another variation, or on another
basis.

Source: Diveev 2010; Diveev and Sofronova 2012 (small variations of the basic solution).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from ....fmus_src.mathlib.network_operator import SIZE, SOURCES
from ..laws.law import Matrix

OUTPUTS = (14, 15)  # nodes count from 0, as everywhere except in output
NOTHING, CHANGE_UNARY, CHANGE_BINARY, ADD_EDGE, REMOVE_EDGE = range(5)
PLACES = [(row, column) for column in range(SOURCES, SIZE) for row in range(column)]  # where edges may be
UNARY_CHOICE = (*range(1, 20), 23)  # operations that a synthesis uses
BINARY_CHOICE = (0, 1)


class Variation(NamedTuple):
    """Variation at row and column, from 0; ``operation`` is unary, or binary on the diagonal."""

    kind: int
    row: int
    column: int
    operation: int


NO_VARIATION = Variation(NOTHING, 0, 0, 0)


def random_variation(random: np.random.Generator, matrix: Matrix) -> Variation:
    """Draw a variation: each kind equally likely, at a random admissible place, with any operation."""
    kind = int(random.integers(CHANGE_UNARY, REMOVE_EDGE + 1))
    if kind == CHANGE_BINARY:
        node = int(random.integers(SOURCES, SIZE))
        return Variation(kind, node, node, BINARY_CHOICE[random.integers(len(BINARY_CHOICE))])
    fits = [place for place in PLACES if (matrix[place[0]][place[1]] == 0) == (kind == ADD_EDGE)]
    row, column = fits[random.integers(len(fits))] if fits else PLACES[random.integers(len(PLACES))]
    return Variation(kind, row, column, UNARY_CHOICE[random.integers(len(UNARY_CHOICE))])


def edges_in(matrix: Sequence[Sequence[int]], node: int) -> int:
    return sum(matrix[row][node] != 0 for row in range(node))


def edges_out(matrix: Sequence[Sequence[int]], node: int) -> int:
    return sum(entry != 0 for entry in matrix[node][node + 1 :])


def apply_variations(matrix: Matrix, variations: Iterable[Variation]) -> Matrix:
    rows = [list(row) for row in matrix]
    for kind, row, column, operation in variations:
        there = rows[row][column] != 0
        if kind == CHANGE_BINARY or (kind == CHANGE_UNARY and there):
            rows[row][column] = operation
        elif kind == ADD_EDGE and not there:
            if row < SOURCES or edges_in(rows, row):  # else it would carry a constant
                rows[row][column] = operation
        elif kind == REMOVE_EDGE and there and edges_in(rows, column) > 1 and edges_out(rows, row) > 1:
            rows[row][column] = 0
    return tuple(tuple(row) for row in rows)


def prune(matrix: Matrix) -> Matrix:
    """Return the same law without nodes on which no output depends."""
    needed = [node in OUTPUTS for node in range(SIZE)]
    for node in reversed(range(SIZE)):
        needed[node] |= any(
            entry and is_needed for entry, is_needed in zip(matrix[node][node + 1 :], needed[node + 1 :], strict=True)
        )
    blank = (0,) * SIZE
    return tuple(
        tuple(entry if is_needed else 0 for entry, is_needed in zip(matrix[row], needed, strict=True))
        if needed[row]
        else blank
        for row in range(SIZE)
    )
