"""Order of blocks from left to right, which determines the feedback edges."""

from __future__ import annotations

from collections.abc import Sequence

Arc = tuple[int, int]
MUCH = 2  # ratio of feedback edges from which the description's order is not used


def order_blocks(count: int, arcs: Sequence[Arc]) -> list[int]:
    """Return the positions of blocks numbered from 0; an arc is a pair of blocks for each edge.

    By default the blocks keep the order of the description, which reflects how its author thinks of the system. If this
    order has at least `MUCH` times as many feedback edges as that of `short_loops`, the latter is returned.
    """
    other = short_loops(count, arcs)
    mine = list(range(count))
    positions = (
        mine if count_feedback_edges(mine, arcs) < MUCH * count_feedback_edges(other, arcs) or not arcs else other
    )
    return mine if count_feedback_edges(mine, arcs) == count_feedback_edges(other, arcs) else positions


def count_feedback_edges(positions: Sequence[int], arcs: Sequence[Arc]) -> int:
    """Return the number of feedback edges."""
    return sum(positions[source] >= positions[target] for source, target in arcs)


def short_loops(count: int, arcs: Sequence[Arc]) -> list[int]:
    """Return positions by the heuristic of Eades, Lin and Smyth, Information Processing Letters 47 (1993), p. 319.

    Sinks are moved to the end and sources to the beginning; without either, the block with the greatest excess of
    outgoing over incoming edges is moved to the beginning.
    """
    remaining = dict.fromkeys(range(count))
    first: list[int] = []
    last: list[int] = []
    while remaining:
        out = dict.fromkeys(remaining, 0)
        into = dict.fromkeys(remaining, 0)
        for source, target in arcs:
            if source != target and source in remaining and target in remaining:
                out[source] += 1
                into[target] += 1
        if sinks := [block for block in remaining if not out[block]]:
            chosen, side = sinks[-1], last
        elif sources := [block for block in remaining if not into[block]]:
            chosen, side = sources[0], first
        else:
            chosen, side = max(remaining, key=lambda block: (out[block] - into[block], -block)), first
        side.append(chosen)
        del remaining[chosen]
    ordered = first + last[::-1]
    positions = [0] * count
    for position, block in enumerate(ordered):
        positions[block] = position
    return positions
