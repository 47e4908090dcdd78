"""Page of `perilune describe --report`, and the diagram on the page of a run: files, browser, paper.

Truth: the SSD as read by lxml, and the display and print of Chromium.
"""

import re
import unicodedata

import numpy as np
import pytest
from lxml import etree
from matplotlib import image

from perilune.analysis.cli import main
from perilune.analysis.documents.diagram import diagram, elk
from perilune.analysis.documents.diagram.elk import MISSING
from perilune.analysis.documents.interactive import script_bundles
from perilune.common.paths import ROOT, SYSTEMS
from tests.support.lengths import either
from tests.support.pages.browser import start
from tests.support.pages.checks import assert_self_contained, parse, text_of
from tests.support.pages.paper import FORMATS, printed

pytestmark = pytest.mark.usefixtures("fmus")
LARGEST = "landing_mission"
SMALL = "lunar_descent_2d"


@pytest.fixture(scope="module")
def page_of(tmp_path_factory):
    """Return the page of a system, written once by the command line."""
    pages = {}

    def write(name):
        if name not in pages:
            pages[name] = tmp_path_factory.mktemp("pages") / f"{name}.html"
            assert main(["describe", name, "--report", str(pages[name])]) == 0
        return pages[name]

    return write


@pytest.mark.usefixtures("layout_bundle")
def test_the_same_bytes_twice(page_of, tmp_path):
    second = tmp_path / "second.html"
    assert main(["describe", LARGEST, "--report", str(second)]) == 0
    assert second.read_bytes() == page_of(LARGEST).read_bytes()
    assert_self_contained(second.read_text(encoding="utf-8"))


def test_tables_have_every_block_and_connection(page_of):
    ssd = etree.parse(SYSTEMS / LARGEST / "SystemStructure.ssd").getroot()
    blocks, connections, parameters = parse(page_of(LARGEST).read_text(encoding="utf-8")).xpath("//table")
    names = [row[0].text for row in blocks.xpath(".//tbody/tr")]
    assert names == [each.get("name") for each in ssd.iter("{*}Component")]
    values = sum(len(row[3].text_content().split(", ")) for row in parameters.xpath(".//tbody/tr"))
    plotted = sum(int(row[2].text_content()) for row in connections.xpath(".//tbody/tr"))
    assert plotted + values == len(list(ssd.iter("{*}Connection")))
    units = {row[0].text: row[3].text for row in connections.xpath(".//tbody/tr")}
    assert (units["plant.position[3]"], units["plant.specific_force[3]"]) == ("m", "m/s²")


def test_without_the_bundle_a_sentence_says_so(monkeypatch, tmp_path):
    monkeypatch.setattr(script_bundles, "BUNDLES", tmp_path)
    page = tmp_path / "page.html"
    assert main(["describe", SMALL, "--report", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert "<svg" not in text
    assert MISSING in text_of(text)
    assert len(parse(text).xpath("//table")) == 2


def test_a_system_too_large_to_read_has_tables(monkeypatch, tmp_path):
    monkeypatch.setattr(diagram, "MAX_BLOCKS", 3)
    page = tmp_path / "page.html"
    assert main(["describe", SMALL, "--report", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert "4 blocks and 9 connections; at most 3 and" in text_of(text)
    assert len(parse(text).xpath("//table")) == 2


@pytest.mark.parametrize(
    ("name", "limit", "reason"),
    [("PATIENCE", 1e-3, "it would take more than 0.001 s"), ("MEMORY", 1000, "it needs too much memory")],
)
def test_a_layout_that_does_not_end_costs_no_page(monkeypatch, tmp_path, name, limit, reason):
    monkeypatch.setattr(elk, name, limit)
    page = tmp_path / "page.html"
    assert main(["describe", SMALL, "--report", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert f"No block diagram of 4 blocks and 9 connections: {reason}" in text_of(text)
    assert len(parse(text).xpath("//table")) == 2


@pytest.mark.parametrize("what", [["terminal_guidance"], [SMALL, "plant"], [SMALL, "--campaign", "table1"]])
def test_what_has_no_diagram_is_refused(what, tmp_path, capsys):
    page = tmp_path / "page.html"
    assert main(["describe", *what, "--report", str(page)]) == 2
    error = capsys.readouterr().err
    assert error.startswith("perilune: --report: ")
    assert len(error.splitlines()) == 1
    assert not page.exists()


@pytest.mark.usefixtures("layout_bundle")
def test_an_fmu_has_a_page(tmp_path):
    page = tmp_path / "page.html"
    assert main(["describe", "kalman_navigation", "--report", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert str(ROOT) not in text  # a page that is passed on does not say where it was written
    labels = parse(text).xpath("//*[@class='block']/*[local-name()='text']/text()")
    assert {"measured_velocity[3]", "estimated_position[3]"} <= set(labels)


@pytest.mark.usefixtures("layout_bundle")
def test_the_page_of_a_run_has_it_with_faults(tmp_path):
    page = tmp_path / "page.html"
    fault = "sensor.measured_altitude=freeze@5..9"
    arguments = ["run", SMALL, "--stop-time", "10", "--fault", fault, "--report", str(page)]
    assert main(arguments) in (0, 1)
    text = page.read_text(encoding="utf-8")
    block = parse(text).xpath("//*[@data-block='sensor']")[0]
    assert fault in block.text_content()
    assert_self_contained(text)


@pytest.mark.usefixtures("layout_bundle")
@pytest.mark.parametrize("width", either([1400, 390], [390]))
def test_in_a_browser(browser, page_of, tmp_path, width):
    """No element is wider than the window: on a narrow one, which a frame is, the diagram scrolls in its box."""
    picture, page = tmp_path / "page.png", tmp_path / "page.html"
    frame = f'<iframe src="{page_of(LARGEST).as_uri()}" style="border: 0; width: {width}px; height: 3000px"></iframe>'
    page.write_text(f'<!DOCTYPE html><body style="margin: 0">{frame}')
    start(browser, page, tmp_path, f"--screenshot={picture}", f"--window-size={max(width, 500)},3000")
    pixels = image.imread(picture)[:, :width, :3] * 255.0
    for colour in ((0, 158, 115), (0, 114, 178), (230, 159, 0)):
        assert np.count_nonzero(np.all(np.abs(pixels - colour) < 90.0, axis=-1)) > 50
    inked = np.any(pixels < 250.0, axis=-1)
    assert not inked[:, -8:].any()


def plain(text):
    """Return letters and digits alone, ligatures taken apart."""
    return re.sub(r"\W", "", unicodedata.normalize("NFKC", text))


@pytest.mark.usefixtures("layout_bundle")
@pytest.mark.parametrize("paper", either(FORMATS, FORMATS[:1]))
@pytest.mark.parametrize(
    ("name", "is_broad"),
    either([(LARGEST, False), ("entry_attitude", True), (SMALL, False)], [(LARGEST, False), ("entry_attitude", True)]),
)
def test_on_paper_it_is_on_one_sheet(browser, page_of, tmp_path, name, is_broad, paper):
    sheets = printed(browser, page_of(name), tmp_path, paper)
    labels = parse(page_of(name).read_text(encoding="utf-8")).xpath("//*[@class='block']/*[local-name()='text']/text()")
    first = plain(sheets.pages[0].extract_text())
    assert len(labels) > 20
    assert [label for label in labels if plain(label) not in first] == []
    assert (sheets.pages[0].mediabox.width > sheets.pages[0].mediabox.height) is is_broad
    assert sheets.pages[-1].mediabox.width < sheets.pages[-1].mediabox.height
