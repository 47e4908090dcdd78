"""Pictures of the documentation: small, used by a page, at least one for each system's page, and drawn by the sources.

Truth: the files in git and the pages; an SVG path written out by hand.
"""

import re

import pytest
from lxml import etree
from matplotlib.figure import Figure

from docs.figures.concept import concept_figure
from docs.figures.folders import folders_figure
from docs.figures.papers.huang import draw_hover_figures
from docs.figures.pictures import IMAGES, LARGEST, write_picture
from docs.figures.system_figures import PICTURES, POINTS, system_figure
from perilune import simulate
from perilune.analysis.documents.common.style import house_style
from perilune.common.paths import ROOT
from tests.support.lengths import either

PAGES = {path: path.read_text(encoding="utf-8") for path in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]}


def test_every_picture_is_small_and_on_a_page():
    pictures = sorted(path for path in IMAGES.rglob("*") if path.is_file())
    assert len(pictures) > 10
    for picture in pictures:
        assert picture.stat().st_size <= LARGEST
        assert any(f"images/{picture.relative_to(IMAGES)})" in text for text in PAGES.values()), picture.name


def test_every_page_of_a_system_has_a_picture():
    for path, text in PAGES.items():
        if path.parent.name == "systems":
            assert re.search(r"!\[[^\]]+\]\(\.\./images/[\w/]+\.svg\)", text), path.name


def shapes(path):
    """Return labels and groups, which say what a picture shows."""
    root = etree.parse(path).getroot()
    return [comment.text for comment in root.iter(etree.Comment)], [group.get("id") for group in root.iter("{*}g")]


@pytest.mark.parametrize(("name", "figure"), [("concept", concept_figure), ("folders", folders_figure)])
def test_a_picture_of_the_architecture_comes_from_its_source(name, figure, tmp_path):
    with house_style():
        write_picture(figure(), tmp_path / f"{name}.svg")
    assert (tmp_path / f"{name}.svg").read_bytes() == (IMAGES / "architecture" / f"{name}.svg").read_bytes()


@pytest.mark.parametrize("system", either(["lunar_landing", "orbital_attitude"], ["orbital_attitude"]))
def test_a_picture_of_a_system_comes_from_its_source(fmus, system, tmp_path):
    with house_style():
        figure = system_figure(PICTURES[system], simulate(system, **PICTURES[system].options))
        written = write_picture(figure, tmp_path / f"{system}.svg")
    assert shapes(written) == shapes(IMAGES / f"{system}.svg")


def test_a_line_is_relative_and_loses_no_more_than_a_twentieth_of_a_point(tmp_path):
    figure = Figure(figsize=(1.0, 1.0))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.axis("off")
    axes.set(xlim=(0.0, 72.0), ylim=(72.0, 0.0))  # points of SVG, y downwards
    axes.plot([1.01, 11.02, 11.02, 20.06], [2.0, 2.0, 30.33, 40.1])
    text = write_picture(figure, tmp_path / "line.svg").read_text(encoding="utf-8")
    assert 'd="M1 2h10v28.3l9.1 9.8"' in text


def test_too_large_a_picture_is_refused(tmp_path):
    figure = Figure()
    axes = figure.subplots()
    for shift in range(100):
        axes.plot([(7 * k + shift) % 41 for k in range(POINTS)])
    with pytest.raises(ValueError, match="draw fewer points"):
        write_picture(figure, tmp_path / "large.svg")
    assert not (tmp_path / "large.svg").exists()


@pytest.mark.slow
def test_pictures_of_the_hover_transfer_come_from_their_source(tmp_path):
    for path in draw_hover_figures(tmp_path):
        assert shapes(path) == shapes(IMAGES / path.name)
