"""Overlapping lines of a diagram are drawn once.

Truth: raster points, each of which belongs to the line and to no earlier line.
"""

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.documents.diagram.strokes import uncovered

SIZE = 6
steps = st.lists(st.integers(0, SIZE), min_size=2, max_size=5)


def corners(numbers):
    """Return a line that goes to abscissas and ordinates in turn."""
    points = [(0.0, 0.0)]
    for position, number in enumerate(numbers):
        x, y = points[-1]
        points.append((float(number), y) if position % 2 == 0 else (x, float(number)))
    return points


def halves(points):
    """Return the middles of the unit lengths that a line covers."""
    middles = set()
    for (x0, y0), (x1, y1) in pairwise(points):
        for k in range(int(min(x0, x1)), int(max(x0, x1))):
            middles.add((k + 0.5, y0))
        for k in range(int(min(y0, y1)), int(max(y0, y1))):
            middles.add((x0, k + 0.5))
    return middles


@given(line=steps, others=st.lists(steps, max_size=3))
def test_every_stretch_once(line, others):
    earlier = [segment for other in others for segment in pairwise(corners(other))]
    stretches = uncovered(corners(line), earlier)
    covered = {middle for other in others for middle in halves(corners(other))}
    assert {middle for stretch in stretches for middle in halves(stretch)} == halves(corners(line)) - covered
    assert all(start != end for stretch in stretches for start, end in pairwise(stretch))


def test_alone_it_is_the_line():
    line = [(0.0, 0.0), (5.0, 0.0), (5.0, 3.0), (2.0, 3.0)]
    assert uncovered(line, []) == [line]
