"""Drawing of a law.

Truth: the properties of a layered drawing (edges lead to the right by layers of longest paths, minimum distances of
nodes); crossings counted by the geometry of the segments; small graphs with known best drawings.
"""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from perilune.analysis.design.laws.formula import formula
from perilune.analysis.design.laws.law import NetworkOperator, find_law, read_law
from perilune.analysis.design.laws.layers import JOINT_GAP, NODE_GAP, GraphLayout, longest_paths
from perilune.analysis.documents.font.text import text_width
from perilune.analysis.documents.of.design.law_figures import law_chart, law_diagram
from perilune.analysis.documents.render.diagram import diagram_svg
from tests.support.laws.networks import matrices
from tests.support.lengths import either

GRAPHS = st.integers(2, 12).flatmap(
    lambda size: st.tuples(
        st.just(list(range(size))),
        st.lists(st.sampled_from(list(itertools.combinations(range(size), 2))), unique=True, max_size=24),
    )
)


def longest(node, edges):
    """Evaluate the definition, by recursion."""
    return max((1 + longest(start, edges) for start, end in edges if end == node), default=0)


@settings(deadline=None)
@given(GRAPHS)
def test_layers_gaps_and_ends(graph):
    nodes, edges = graph
    layout = GraphLayout(nodes, edges)
    lengths = longest_paths(nodes, edges)
    for node in nodes:
        assert lengths[node] == layout.nodes[node][0] == longest(node, edges)
    for (start, end), path in layout.paths.items():
        assert path[0] == layout.nodes[start]
        assert path[-1] == layout.nodes[end]
        assert [x for x, _ in path] == list(range(lengths[start], lengths[end] + 1))
    assert set(layout.paths) == set(edges)
    for layer in layout.layers:
        heights = [
            layout.nodes[place][1] if not isinstance(place, tuple) else dict(layout.paths[place[0]])[place[1]]
            for place in layer
        ]
        for (a, low), (b, high) in itertools.pairwise(zip(layer, heights, strict=True)):
            joint = isinstance(a, tuple) or isinstance(b, tuple)
            assert high - low >= (JOINT_GAP if joint else NODE_GAP) - 1e-9


@settings(deadline=None)
@given(GRAPHS)
def test_crossings_are_those_of_the_segments(graph):
    layout = GraphLayout(*graph)
    segments = {pair for path in layout.paths.values() for pair in itertools.pairwise(path)}
    crossing = 0
    for ((x, a), (_, b)), ((other, c), (_, d)) in itertools.combinations(sorted(segments), 2):
        crossing += x == other and (a - c) * (b - d) < 0
    assert layout.crossings() == crossing


def test_a_graph_that_can_be_drawn_without_crossings_is():
    ladder = [(0, 5), (1, 4), (2, 3), (5, 6), (4, 7), (3, 8)]
    assert GraphLayout(list(range(9)), ladder).crossings() == 0
    tree = [(0, 4), (3, 4), (1, 5), (2, 5), (4, 6), (5, 6)]
    assert GraphLayout(list(range(7)), tree).crossings() == 0


@pytest.mark.parametrize("name", ["diveev_2013", "diveev_2013_basic"])
def test_the_svg_is_the_same_every_time(name):
    law = read_law(find_law(name))
    drawing = diagram_svg(law_diagram(law))
    assert drawing == diagram_svg(law_diagram(law))
    root = etree.fromstring(drawing)
    assert root.tag == "{http://www.w3.org/2000/svg}svg"


def texts(law):
    """Return texts of the drawing with their left, right, upper and lower ends, pt."""
    chart, width, height = law_chart(law)
    boxes = []
    for note in chart.notes:
        x, y = (
            (at - low) / (high - low) * size
            for at, (low, high), size in zip(note.at, (chart.x.ends, chart.y.ends[::-1]), (width, height), strict=True)
        )
        half, tall = text_width(note.text, note.size) / 2.0, 1.2 * note.size
        top = y - note.offset[1] - (tall / 2.0 if note.align[1] == "center" else 0.0)
        boxes.append((note.text, (x - half, x + half, top, top + tall)))
        assert 0.0 <= x - half < x + half <= width
        assert 0.0 <= top < top + tall <= height
    return boxes


def test_everything_the_law_is_made_of_is_in_the_drawing():
    actual = [text for text, _ in texts(read_law(find_law("diveev_2013")))]
    for name in ("π + θ", "q1", "q2", "θ", "q3", "z7", "z14", "u1 = z15", "u2 = z16", "exp", "step", "1/z", "cos"):
        assert name in actual
    assert actual.count("exp") == 3
    assert actual.count("+") == 5  # z11, z13, z14 and the outputs gather by sum


def test_labels_do_not_lie_on_each_other():
    boxes = [box for _, box in texts(read_law(find_law("diveev_2013")))]
    for first, second in itertools.combinations(boxes, 2):
        across = min(first[1], second[1]) - max(first[0], second[0])
        down = min(first[3], second[3]) - max(first[2], second[2])
        assert across <= 1.0 or down <= 1.0


@settings(deadline=None, max_examples=either(10, 5))
@given(matrices())
def test_any_law_can_be_drawn(matrix):
    assert len(texts(NetworkOperator("random", matrix, (1.0, 1.0, 1.0), "true"))) >= 2


def test_a_law_of_one_edge():
    matrix = np.zeros((16, 16), dtype=int)
    matrix[0, 14] = matrix[0, 15] = 1
    law = NetworkOperator("one", tuple(map(tuple, matrix.tolist())), (1.0, 1.0, 1.0), "true")
    assert {text for text, _ in texts(law)} == {"π + θ", "u1 = z15", "u2 = z16"}


def test_a_law_of_nothing_and_one_with_an_edge_into_a_source():
    empty = np.zeros((16, 16), dtype=int)
    law = NetworkOperator("none", tuple(map(tuple, empty.tolist())), (1.0, 1.0, 1.0), "true")
    assert {text for text, _ in texts(law)} == {"u1 = z15", "u2 = z16"}
    assert formula(law) == {"z15": "0", "z16": "0"}
    empty[1, 2] = 3
    empty[2, 14] = empty[2, 15] = 1
    law = NetworkOperator("fed source", tuple(map(tuple, empty.tolist())), (1.0, 1.0, 1.0), "true")
    assert "z3, from (hf \N{MINUS SIGN} h)/h0" in {text for text, _ in texts(law)}
    assert formula(law) == {"z3": "(hf - h)/h0 - q1", "z15": "z3", "z16": "z3"}
