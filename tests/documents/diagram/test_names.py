"""Foreign names in a diagram are always shown as plain text.

Truth: lxml reads the same names back, in SVG and in JSON; the page has the same elements as with plain names.
"""

import json

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from lxml import etree, html

from perilune.analysis.documents.diagram.diagram import BlockDiagram
from perilune.analysis.documents.diagram.drawing import draw
from perilune.analysis.documents.diagram.layout import lay_out
from perilune.analysis.documents.font.text import shorten
from perilune.analysis.documents.model import Table
from perilune.analysis.documents.of.system import diagram_document
from perilune.analysis.documents.render.html import write_document
from tests.support.diagrams.geometry import Drawing, assert_readable
from tests.support.diagrams.graphs import block_of, connect
from tests.support.lengths import either

HOSTILE = (
    "</script><script>alert(1)</script>", "<!--", "]]>", "&amp;", '"quoted"', "it's", "a\u2028b", "a\u2029b",
    "\u202eabc", "\u200f", "__proto__", "constructor", "x" * 500, "漢字", "a b", "${1}", "{{ 1 }}", "e\u0301",
)  # fmt: skip
names = st.text(st.characters(exclude_categories=("Cs", "Cc")), min_size=1, max_size=30)


def system(one, other, unit):
    """Return two blocks in a loop, with these names, and a unit."""
    blocks = block_of("system", {}, {})
    first, second = block_of(one, {other: unit}, {one: unit}, "a"), block_of(other, {one: unit}, {other: unit}, "b")
    blocks.path = ""
    blocks.blocks += [first, second]
    first.faults = [f"{one}.{other}=freeze@1"]
    connect(blocks, ("a", one), ("b", one))
    connect(blocks, ("b", other), ("a", other), change=one)
    return blocks


def check_svg(engine, one, other, unit):
    graph = system(one, other, unit)
    svg = draw(graph, lay_out(graph, engine))
    drawing = Drawing(str(svg))
    assert_readable(drawing)
    assert {line.connections[0] for line in drawing.lines} == {(f"a.{one}", f"b.{one}"), (f"b.{other}", f"a.{other}")}
    assert {element.tag.rpartition("}")[2] for element in drawing.root.iter()} <= {
        "svg", "g", "title", "path", "rect", "text", "circle",
    }  # fmt: skip
    assert not {"\u2028", "\u2029", "\u202e", "\u200f"} & set(svg)
    return graph, svg


@given(one=names, other=names, unit=names)
@settings(max_examples=either(40, 13))
@example(one="__proto__", other="constructor", unit="</script>")
def test_any_names(engine, one, other, unit):
    check_svg(engine, one, other, unit)


@pytest.mark.parametrize("name", HOSTILE)
def test_a_page_with_hostile_names(engine, name, tmp_path):
    graph, svg = check_svg(engine, name, f"{name}2", name)
    page = tmp_path / "page.html"
    write_document(diagram_document(name, name, {}, BlockDiagram(graph, svg), Table((), ())), page)
    root = html.document_fromstring(page.read_text(encoding="utf-8"))
    assert not root.xpath("//script | //iframe | //img | //comment()")
    edges = root.xpath("//*[@class='edge']")
    assert [json.loads(edge.get("data-signals")) for edge in edges] == [[f"a.{name}"], [f"b.{name}2"]]
    assert root.findtext(".//h1") == name
    if len(name) < 30 and name.isprintable():
        assert name in etree.tostring(root.xpath("//*[@data-block='a']")[0], method="text", encoding="unicode")


def test_long_names_keep_both_ends():
    assert shorten("abcdefgh", 8) == "abcdefgh"
    assert shorten("abcdefghi", 8) == "abcd…ghi"
    assert len(shorten("x" * 500, 40)) == 40
