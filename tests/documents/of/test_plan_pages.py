"""Pages of plans: content, no requests, reproducible bytes; rendering in a browser, wide and narrow.

Truth: the displayed studies; the widths in the layout of the browser.
"""

import math
import re

import numpy as np
import pytest
from matplotlib import image

from perilune.analysis.design.trajectories.landing_study import landing_study
from perilune.analysis.design.trajectories.vehicle import Landing, Margins, Transfer, Vehicle
from perilune.analysis.design.transfers.hover_study import hover_study
from perilune.analysis.design.transfers.programme import find_programme
from perilune.analysis.documents.of.design.landing_bound import landing_bound_document
from perilune.analysis.documents.of.design.programme_sketch import sketch_chart
from perilune.analysis.documents.of.design.transfer import transfer_document
from perilune.analysis.documents.render.html import write_document
from tests.support.lengths import either
from tests.support.pages.browser import start
from tests.support.pages.checks import assert_self_contained, data_values, parse, text_of, without_policy

ENGINE = 4707.192
VEHICLE = Vehicle(600.0, 0.0, 300.0, ENGINE, ENGINE / 15.0, math.radians(1.0))
MARGINS = Margins(0.90, 0.10, math.radians(0.70))
LANDER = Vehicle(940.13, 440.0, 319.0, 5099.0, 0.0, math.inf)
LANDING = Landing(285e3, 14995.3, 1692.342, 0.0, 4.0, 1.7374e6, 4.9028e12)
COLOURS = {"hover": ((0, 114, 178), (213, 94, 0), (0, 158, 115)), "landing": ((0, 114, 178),)}
MEASURE = """<script>
onerror = message => document.body.dataset.error = message;
addEventListener("load", () => {
  const page = document.documentElement;
  const inside = element => element.closest(".scroll") !== null || element.closest("figure") !== null;
  const wide = [...document.querySelectorAll("body *")].filter(
    element => !inside(element) && element.getBoundingClientRect().right > innerWidth + 1);
  document.body.dataset.overflow = page.scrollWidth - page.clientWidth;
  document.body.dataset.wide = wide.map(element => element.tagName + "." + element.className).join(" ");
});
</script></body>"""


@pytest.fixture(scope="module")
def hover():
    transfer = Transfer(1600.0, 2300.0, 1.622)
    more = {"adjoint": True, "finite_switches": True, "free_fall": True, "distances": (0.0, 500.0)}
    return hover_study(VEHICLE, transfer, MARGINS, optimum=True, bound=True, intervals=either(40, 20), **more)


@pytest.fixture(scope="module")
def landing():
    return landing_study(LANDER, LANDING, direct=True, intervals=either(40, 20))


@pytest.fixture(scope="module")
def pages(hover, landing, tmp_path_factory):
    folder = tmp_path_factory.mktemp("plans")
    write_document(transfer_document(hover), folder / "hover.html")
    write_document(landing_bound_document(landing), folder / "landing.html")
    return {name: folder / f"{name}.html" for name in ("hover", "landing")}


def test_transfer(hover, pages):
    text = pages["hover"].read_text(encoding="utf-8")
    assert_self_contained(text)
    values = data_values(text)
    for path in (hover.path, hover.optimum, hover.bound):
        assert repr(path.propellant_fraction) in values
        assert repr(path.duration) in values
    for time in hover.programme.times:
        assert repr(time) in values
    for plan in (hover.finite, hover.free_fall):
        assert repr(plan.propellant_fraction) in values
        assert all(repr(time) in values for burn in plan.full_thrust for time in burn)
    assert all(repr(time) in values for time in (*hover.adjoint.singular_span, *hover.adjoint.switching_times))
    assert repr(hover.comparisons[1].free_fall * VEHICLE.mass) in values
    for plan in (hover.finite.times, hover.free_fall.times.elements()):
        assert all(repr(time) in values for time in plan)
    words = text_of(text)
    for name in ("simplified programme", "true optimum", "point-mass bound", "the plan's throttle 0.1 to 0.9"):
        assert name in words
    assert "its angular acceleration 0.7 deg/s²" in words
    assert "Not computed" not in words
    assert len(parse(text).xpath("//*[local-name()='svg' and @class='figure']")) == 6


def test_landing(landing, pages):
    text = pages["landing"].read_text(encoding="utf-8")
    assert_self_contained(text)
    values = data_values(text)
    assert repr(landing.propellant) in values
    assert repr(landing.direct.propellant_fraction * LANDER.mass) in values
    assert all(repr(time) in values for burn in landing.bound.burns() for time in burn)
    plotted = parse(text).xpath("//*[local-name()='svg' and starts-with(@class, 'figure')]/@class")
    assert sorted(plotted) == ["figure"] * 3


def test_the_same_bytes_again(hover, landing, pages, tmp_path):
    documents = {"hover": transfer_document(hover), "landing": landing_bound_document(landing)}
    for name in either(["hover", "landing"], ["landing"]):
        write_document(documents[name], tmp_path / "again.html")
        assert (tmp_path / "again.html").read_bytes() == pages[name].read_bytes()


def test_straight_down(tmp_path):
    study = hover_study(VEHICLE, Transfer(0.0, 2300.0, 1.622))
    write_document(transfer_document(study), tmp_path / "down.html")
    text = (tmp_path / "down.html").read_text(encoding="utf-8")
    assert_self_contained(text)
    assert parse(text).xpath("//dt[.='programme']/../dd/text()") == ["vertical"]
    assert "Not computed: true optimum, point-mass bound." in text_of(text)


@pytest.mark.parametrize("name", either(["hover", "landing"], ["hover"]))
@pytest.mark.parametrize(("width", "height"), either([(1200, 3200), (400, 4800)], [(400, 4800)]))
def test_page_renders(browser, pages, tmp_path, name, width, height):
    start(browser, pages[name], tmp_path, f"--window-size={width},{height}", f"--screenshot={tmp_path / 'page.png'}")
    pixels = image.imread(tmp_path / "page.png")[..., :3] * 255.0
    assert pixels.shape[:2] == (height, width)
    for colour in COLOURS[name]:
        assert np.count_nonzero(np.all(np.abs(pixels - colour) < 3.0, axis=-1)) > 150
    inked = np.any(pixels < 250.0, axis=-1)
    assert not inked[:, -8:].any()
    assert not inked[-40:].any()


@pytest.mark.parametrize("name", either(["hover", "landing"], ["hover"]))
def test_nothing_overflows(browser, pages, tmp_path, name):
    measured = tmp_path / "measured.html"
    text = without_policy(pages[name].read_text(encoding="utf-8"))
    measured.write_text(text.replace("</body>", MEASURE), encoding="utf-8")
    dom = start(browser, measured, tmp_path, "--window-size=500,2000", "--dump-dom")
    assert re.search(r"<body[^>]* data-overflow=\"0\"", dom)
    assert re.search(r"<body[^>]* data-wide=\"\"", dom)
    assert not re.search(r"<body[^>]* data-error", dom)


@pytest.mark.parametrize(("distance", "descent"), [(1600.0, 2300.0), (800.0, 1500.0), (0.0, 1000.0)])
def test_the_sketch_has_the_times_where_they_are(distance, descent):
    """Truth: the paper's pitch at t2, t5 and t7, and the level of k, which the tilt crosses w before t2."""
    programme = find_programme(VEHICLE, Transfer(distance, descent, 1.622))
    t2, t5, w, tp, t7 = programme.times
    chart = sketch_chart(programme)
    tilt, *arrows = chart.curves
    swing = math.degrees(VEHICLE.angular_acceleration)
    for at, expected in ((t2, -swing * t2**2 / 4.0), (t5, swing * (t7 - t5) ** 2 / 4.0), (t7, 0.0)):
        if t2 > 0.0:
            assert np.interp(at, tilt.x, tilt.y) == pytest.approx(expected, abs=0.01)
    spans = {note.text.split(" = ")[0]: tuple(each.x) for note, each in zip(chart.notes, arrows[::3], strict=False)}
    assert spans["tp"] == pytest.approx((t7 - tp, t7))
    assert spans["t7"] == pytest.approx((0.0, t7))
    shaded = [(area.x.min(), area.x.max()) for area in chart.areas]
    assert shaded[-1] == pytest.approx((t7 - tp, t7))
    if not distance:
        assert set(spans) == {"tp", "t7"}
        return
    assert spans["t2"] == pytest.approx((0.0, t2))
    assert spans["t5"] == pytest.approx((0.0, t5))
    if w > 0.0:
        assert spans["w"] == pytest.approx((t2, t2 + w))
        (level,) = [rule.at for rule in chart.rules if rule.colour == "#d55e00"]
        assert np.interp(shaded[0][0], tilt.x, tilt.y) == pytest.approx(level, abs=0.01)
