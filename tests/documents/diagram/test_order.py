"""Order of blocks in a diagram, and division of its columns into rows.

Truth: enumeration of all orders and divisions; Eades, Lin and Smyth's bound.
"""

from itertools import combinations, permutations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.documents.diagram.order import count_feedback_edges, order_blocks, short_loops
from perilune.analysis.documents.diagram.rows import WIDEST, BoxColumn, cut_into_rows

COUNT = 6
arcs = st.lists(st.tuples(st.integers(0, COUNT - 1), st.integers(0, COUNT - 1)), max_size=14)


@given(arcs=arcs)
def test_short_loops(arcs):
    positions = short_loops(COUNT, arcs)
    assert sorted(positions) == list(range(COUNT))
    proper = [arc for arc in arcs if arc[0] != arc[1]]
    assert count_feedback_edges(positions, proper) <= len(proper) / 2
    fewest = min(count_feedback_edges(order, arcs) for order in permutations(range(COUNT)))
    if fewest == 0:
        assert count_feedback_edges(positions, arcs) == 0
    assert count_feedback_edges(order_blocks(COUNT, arcs), arcs) <= max(
        fewest, 2 * count_feedback_edges(positions, arcs)
    )


def test_the_order_of_the_description_unless_it_is_much_worse():
    assert order_blocks(3, [(0, 1), (1, 2), (2, 0)]) == [0, 1, 2]
    assert order_blocks(3, [(2, 1), (1, 0)]) == [2, 1, 0]


@given(
    widths=st.lists(st.floats(100.0, 800.0), min_size=1, max_size=6),
    arcs=st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)), max_size=10),
)
def test_cuts(widths, arcs):
    columns, left = [], 0.0
    for width in widths:
        columns.append(BoxColumn(left, left + width, []))
        left += width + 20.0
    count = len(columns)
    arcs = [(a % count, b % count) for a, b in arcs]
    rows = cut_into_rows(columns, arcs)
    assert [number for row in rows for number in row] == list(range(count))

    def cost(cuts):
        """Return rows, edges between rows; None where a row is too wide."""
        spans = [range(a, b) for a, b in zip((0, *cuts), (*cuts, count), strict=True)]
        if any(len(row) > 1 and columns[row[-1]].right - columns[row[0]].left > WIDEST for row in spans):
            return None
        return len(spans), sum(not any(a in row and b in row for row in spans) for a, b in arcs)

    possible = (cost(cuts) for size in range(count) for cuts in combinations(range(1, count), size))
    assert cost(tuple(row.start for row in rows[1:])) == min(each for each in possible if each is not None)


@pytest.mark.parametrize("count", [1, 40])
def test_one_column_each(count):
    columns = [BoxColumn(1000.0 * k, 1000.0 * k + 900.0, []) for k in range(count)]
    assert len(cut_into_rows(columns, [])) == count
