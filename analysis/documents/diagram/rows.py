"""Division of columns of blocks into rows if they would be wider than a page. Lengths are in px."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import accumulate

from .placement import PlacedBlock, Terminal

WIDEST = 1360.0  # largest width of a row of several columns


@dataclass
class BoxColumn:
    """Boxes one above the other between the abscissas ``left`` and ``right``, between which there is no other box."""

    left: float
    right: float
    boxes: list[PlacedBlock | Terminal]


def columns_of(boxes: Iterable[PlacedBlock | Terminal]) -> list[BoxColumn]:
    """Return the columns of boxes from left to right."""
    columns: list[BoxColumn] = []
    for box in sorted(boxes, key=lambda box: box.x):
        if columns and box.x < columns[-1].right:
            columns[-1].right = max(columns[-1].right, box.x + box.width)
            columns[-1].boxes.append(box)
        else:
            columns.append(BoxColumn(box.x, box.x + box.width, [box]))
    return columns


def cut_into_rows(columns: Sequence[BoxColumn], arcs: Sequence[tuple[int, int]]) -> list[range]:
    """Return the columns of each row: as few rows as `WIDEST` allows, with as many edges as possible within rows.

    ``arcs`` are the columns that each edge connects. Among equal solutions the most uniform widths are chosen. The
    method is dynamic programming over the ends of rows.
    """
    count = len(columns)
    inside = _edges_inside(count, arcs)
    begins_of_rows: list[dict[int, int]] = []  # for each number of rows: begin of the last row by its end
    costs: dict[int, tuple[int, float]] = {0: (0, 0.0)}  # by end: minus edges in rows, sum of squared widths
    while count not in costs:
        following: dict[int, tuple[int, float]] = {}
        begins: dict[int, int] = {}
        for begin, (edges, squares) in costs.items():
            for end in range(begin + 1, count + 1):
                width = columns[end - 1].right - columns[begin].left
                if width > WIDEST and end > begin + 1:
                    break
                cost = (edges - inside[begin][end], squares + width * width)
                if end not in following or cost < following[end]:
                    following[end], begins[end] = cost, begin
        costs = following
        begins_of_rows.append(begins)
    rows, end = [], count
    for begins in reversed(begins_of_rows):
        rows.append(range(begins[end], end))
        end = begins[end]
    return rows[::-1]


def _edges_inside(count: int, arcs: Sequence[tuple[int, int]]) -> list[list[int]]:
    """Return, by [begin][end], the number of edges among the columns begin to end - 1."""
    table = [[0] * (count + 1) for _ in range(count + 1)]
    for arc in arcs:
        table[min(arc)][max(arc) + 1] += 1
    for begin in range(count - 1, -1, -1):
        table[begin] = [
            total + longer for total, longer in zip(accumulate(table[begin]), table[begin + 1], strict=True)
        ]
    return table
