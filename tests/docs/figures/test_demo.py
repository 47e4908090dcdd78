"""docs.figures.demo and the figure of the README, from real simulations of a few trials."""

import numpy as np
import pyarrow.parquet
import pytest

from docs.figures.demo import fly, fly_mission
from docs.figures.page import PUBLISHED
from docs.figures.readme_figure import draw_readme_figure
from perilune.common.paths import ROOT
from tests.papers.test_fomichev_li import TABLE
from tests.support.pages.checks import assert_self_contained, data_values, parse, text_of

TRIALS = 12
FILES = {"landing.html", "mission.html", "comparison.html", "landing.csv", "landing.csv.json"}
FILES |= {"draws.parquet", "summary.json"}


@pytest.fixture(scope="module")
def demo(fmus, tmp_path_factory):
    page = fly(tmp_path_factory.mktemp("demo"), TRIALS)
    fly_mission(page.parent)
    return page


def test_page_stands_alone_and_its_links_lead_somewhere(demo):
    page = demo.read_text(encoding="utf-8")
    assert_self_contained(page)
    links = set(parse(page).xpath("//a/@href"))
    assert links == FILES
    assert all((demo.parent / link).is_file() for link in links)


def test_reports_beside_it_stand_alone(demo):
    for name in ("landing.html", "mission.html", "comparison.html"):
        assert_self_contained((demo.parent / name).read_text(encoding="utf-8"))


def test_the_mission_has_a_scene_and_a_diagram(demo):
    page = parse((demo.parent / "mission.html").read_text(encoding="utf-8"))
    assert page.xpath("//section[h2='Landing']//*[@data-scene] | //section[h2='Landing']/p[@class='empty']")
    assert page.xpath("//*[contains(@class, 'diagram')] | //p[contains(., 'No block diagram')]")


def test_the_published_values_are_those_of_the_table():
    actual = {
        name: (round(100.0 * row.success_rate, 9), row.position_error, row.velocity_error)
        for name, row in PUBLISHED.items()
    }
    assert actual == {name: (row.success, row.miss, row.velocity) for name, row in TABLE.items()}


def test_ours_stand_beside_the_published_values(demo):
    page = demo.read_text(encoding="utf-8")
    text, values = text_of(page), data_values(page)
    trials = pyarrow.parquet.read_table(demo.parent / "trials").to_pydict()
    for variant, published in PUBLISHED.items():
        good = [ok for name, ok in zip(trials["variant"], trials["success"], strict=True) if name == variant]
        assert len(good) == TRIALS
        assert repr(float(np.mean(good))) in values
        assert repr(published.success_rate) in values
        for mean, std in (published.position_error, published.velocity_error):
            assert f"{mean:.4f} / {std:.4f}" in text


def test_the_landing_arrives(demo):
    facts = parse(demo.read_text(encoding="utf-8")).xpath("//dl//data/@value")
    flight_time, miss, speed, step = map(float, facts)
    assert 190.0 < flight_time < 225.0
    assert miss < 0.1
    assert speed < 1.0
    assert step == 0.1


def test_figure_of_the_readme_is_what_make_demo_draws(fmus, tmp_path):
    """To the last digit of a path: marks are named after the file, which has to have the same name."""
    retained = ROOT / "docs" / "images" / "landing.svg"
    draw_readme_figure(tmp_path / retained.name)
    assert (tmp_path / retained.name).read_bytes() == retained.read_bytes()
    assert b"<dc:date>" not in retained.read_bytes()
