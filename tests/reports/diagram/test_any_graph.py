"""Any graph is drawn readably, in one row or several.

Truth: the edges of the graph, and the geometry of the SVG.
"""

from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.analysis.reports.diagram import rows
from perilune.analysis.reports.diagram.drawing import draw
from perilune.analysis.reports.diagram.layout import lay_out
from tests.support.diagrams.geometry import EXACT, Drawing, assert_readable
from tests.support.diagrams.graphs import graphs


@given(graph=graphs(), widest=st.sampled_from([150.0, 300.0, 1360.0]))
@settings(max_examples=60)
def test_any_graph(engine, graph, widest):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rows, "WIDEST", widest)  # so that small graphs have several rows
        drawing = Drawing(str(draw(graph, lay_out(graph, engine))))
    assert_readable(drawing)
    assert Counter(drawing.connections()) == Counter(pair for edge in graph.edges for pair in edge.pairs)
    for line in drawing.lines:
        ((source, target),) = line.connections
        begin, end = (drawing.blocks[name.partition(".")[0]] for name in (source, target))
        assert line.points[0][0] == pytest.approx(begin.right, abs=EXACT)
        assert line.points[-1][0] == pytest.approx(end.left, abs=EXACT)
        assert begin.top < line.points[0][1] < begin.bottom
        assert end.top < line.points[-1][1] < end.bottom
