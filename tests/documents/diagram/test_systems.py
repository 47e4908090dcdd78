"""Block diagrams of all systems: every connection once, lines from port to port, no overlaps.

Truth: the connections of the SSD as lxml reads them, and the geometry of the SVG.
"""

import inspect
import json
from collections import Counter
from pathlib import Path

import pytest
from lxml import etree

import perilune
from perilune.analysis.documents.diagram.diagram import make_diagram
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.paths import SYSTEMS
from perilune.fmus_src.catalogue import block_kinds, catalogue
from tests.support.diagrams.geometry import EXACT, Drawing, assert_readable
from tests.support.large_systems import build_mixers, large_system
from tests.support.lengths import LONG, either

pytestmark = pytest.mark.usefixtures("fmus", "layout_bundle")
RING = either(60, 20)
SHORT = ["landing_mission", "lunar_descent_2d", "entry_attitude", "ring"]


@pytest.fixture(scope="module")
def folder_of(tmp_path_factory):
    """Return the folder of a system by name; a ring is written."""

    def find(name):
        if name != "ring":
            return SYSTEMS / name
        folder = tmp_path_factory.mktemp("ring")
        (folder / "fmus").mkdir()
        for built in build_mixers(folder):
            built.rename(folder / "fmus" / built.name)
        return large_system(folder / "ring", folder / "fmus", RING)

    return find


@pytest.fixture(scope="module", params=either([*system_names(), "ring"], SHORT))
def figure(request, folder_of):
    """Return the SSD's root, and the diagram."""
    folder = folder_of(request.param)
    prepared = prepare_system(folder)
    svg = make_diagram(prepared).svg
    if LONG:  # test_page.py compares those of the largest
        assert svg == make_diagram(prepare_system(folder)).svg
    return etree.parse(folder / "SystemStructure.ssd").getroot(), Drawing(str(svg))


def test_every_connection_is_there_once(figure):
    ssd, drawing = figure
    assert Counter(drawing.connections()) == Counter(
        tuple(
            ".".join(filter(None, (each.get(f"{end}Element"), each.get(f"{end}Connector")))) for end in ("start", "end")
        )
        for each in ssd.iter("{*}Connection")
    )
    assert sorted(drawing.blocks) == sorted(each.get("name") for each in ssd.iter("{*}Component"))


def test_nothing_is_over_anything_else(figure):
    assert_readable(figure[1])


def test_lines_end_at_their_ports(figure):
    """At the left of the target and at the right of the source, level with the label of the port."""
    _, drawing = figure
    for line in drawing.lines:
        for end, (x, y) in enumerate((line.points[0], line.points[-1])):
            names = [pair[end] for pair in line.connections]
            block, _, variable = names[0].partition(".")
            if not variable:
                (box,) = drawing.terminals[names[0]]
                assert y == pytest.approx((box.top + box.bottom) / 2.0, abs=EXACT)
                assert x == pytest.approx(box.left if end else box.right, abs=EXACT)
                continue
            box = drawing.blocks[block]
            assert x == pytest.approx(box.left if end else box.right, abs=EXACT)
            labels = [text for text, label in drawing.labels_of(block) if label.top < y < label.bottom]
            assert variable.partition("[")[0] in [text.partition("[")[0] for text in labels]
            if len(names) > 1:
                assert any(f"[{len(names)}]" in text for text in labels)


def test_loops_back_are_below_their_blocks(figure):
    """A line that goes to the left does so below the block, or the connector of the system, that it comes from."""
    _, drawing = figure
    loops = 0
    for line in drawing.lines:
        back = [end for start, end in zip(line.points, line.points[1:], strict=False) if end[0] < start[0] - EXACT]
        loops += bool(back)
        source = drawing.blocks.get(line.connections[0][0].partition(".")[0])  # none: a connector of the system
        bottom = line.points[0][1] if source is None else source.bottom
        assert all(y > bottom for _, y in back)
    assert loops > 0


@pytest.mark.parametrize("name", either(["lunar_descent_2d", "lunar_landing"], ["lunar_descent_2d"]))
def test_every_recorded_signal_is_that_of_a_block(name):
    drawing = Drawing(str(make_diagram(prepare_system(name)).svg))
    groups = drawing.root.xpath("//*[@class='block' or @class='terminal']")
    signals = [signal for group in groups for signal in json.loads(group.get("data-signals"))]
    assert len(signals) == len(set(signals))
    assert set(perilune.simulate(name, stop_time=1.0).signals) <= set(signals)


def test_the_kind_of_a_block_is_that_of_its_file():
    assert {name: block_kinds()[name] for name in catalogue()} == {
        name: Path(inspect.getfile(block)).parent.name for name, block in catalogue().items()
    }


def test_parameters_are_in_the_block_that_they_are_given_to(figure):
    _, drawing = figure
    for group in drawing.root.iter("{*}g"):
        if group.get("class") == "parameter":
            owner = group.getparent().get("data-block")
            assert all(name.startswith(f"{owner}.") for name in json.loads(group.get("data-targets")))
