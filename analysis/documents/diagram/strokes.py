"""Removal of duplicate strokes where lines of one port coincide, which would look bolder."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from .placement import Point, Segment


def uncovered(points: Sequence[Point], earlier: Iterable[Segment]) -> list[list[Point]]:
    """Return the stretches of an orthogonal line that no segment of earlier lines covers, each as its corners."""
    known = list(earlier)
    stretches: list[list[Point]] = []
    for segment in pairwise(points):
        for start, end in _iterate_uncovered(segment, known):
            if stretches and stretches[-1][-1] == start:
                stretches[-1].append(end)
            else:
                stretches.append([start, end])
    return stretches


def _iterate_uncovered(segment: Segment, earlier: Iterable[Segment]) -> Iterator[Segment]:
    """Yield the uncovered stretches of a segment, from its start to its end."""
    axis = 0 if segment[0][1] == segment[1][1] else 1
    start, end = segment[0][axis], segment[1][axis]
    across = segment[0][1 - axis]
    covered = sorted(
        tuple(sorted((one[axis], other[axis])))
        for one, other in earlier
        if one[1 - axis] == other[1 - axis] == across and one != other
    )
    free, position = [], min(start, end)
    for low, high in covered:
        if low > position:
            free.append((position, min(low, max(start, end))))
        position = max(position, high)
    free.append((position, max(start, end)))
    for low, high in free if end >= start else [(high, low) for low, high in reversed(free)]:
        if (high - low) * (end - start) > 0.0:
            yield ((low, across), (high, across)) if axis == 0 else ((across, low), (across, high))
