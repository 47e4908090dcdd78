"""Diagrams of arbitrary graphs are legible, in one row or several.

Truth: the edges of the graph, and the geometry of the SVG.
"""

from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.analysis.documents.diagram import rows
from perilune.analysis.documents.diagram.drawing import draw
from perilune.analysis.documents.diagram.layout import lay_out
from tests.support.diagrams.geometry import EXACT, Drawing, assert_readable
from tests.support.diagrams.graphs import graphs
from tests.support.lengths import either


@given(graph=graphs(), widest=st.sampled_from([150.0, 300.0, 1360.0]))
@settings(max_examples=either(60, 20))
def test_any_graph(engine, graph, widest):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rows, "WIDEST", widest)  # so that small graphs have several rows
        drawing = Drawing(str(draw(graph, lay_out(graph, engine))))
    assert_readable(drawing)
    edges = list(graph.all_edges())
    assert Counter(drawing.connections()) == Counter(pair for edge in edges for pair in edge.pairs)
    frames = {block.path for block in graph.all_blocks() if block.blocks}
    for line in drawing.lines:
        for end, name in enumerate(line.connections[0]):
            x, y = line.points[-end]
            owner = name.rpartition(".")[0]
            if owner in frames and (not owner or all(each.startswith(f"{owner}.") for each in line.connections[0])):
                continue  # a terminal
            box = drawing.blocks[owner]
            assert x == pytest.approx(box.left if end else box.right, abs=EXACT)
            assert box.top < y < box.bottom
