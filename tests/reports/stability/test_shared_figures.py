"""Figures of several loops that nobody could tell apart are drawn once, and nothing else is left out.

Truth: loops derived from one another, whose responses differ by as much as is said.
"""

from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.reports.stability.figures import sight_panels
from perilune.analysis.reports.stability.page import write_stability_page
from perilune.analysis.reports.stability.shared import alike, picture_of, together
from tests.support.pages.checks import assert_self_contained, parse, text_of

AXES = ("x", "y", "z")


def scaled(loop, factor, **changed):
    """Return the loop with a response larger by a factor, nothing else changed."""
    return replace(loop, curve=replace(loop.curve, value=factor * loop.curve.value), **changed)


@pytest.fixture(scope="module")
def loop(studies):
    return replace(studies.late.loops[0], dispersion=None)


@pytest.fixture(scope="module")
def bode(loop):
    return bode_picture(loop, "first")


def bode_picture(loop, name):
    return picture_of("".join(drawing.svg for drawing in sight_panels(loop, name)[0].figure.drawings))


@pytest.mark.parametrize(("change", "same"), [(1e-9, True), (1e-4, True), (-1e-4, True), (0.1, False), (1.0, False)])
def test_what_is_closer_than_half_a_line_is_the_same(loop, bode, change, same):
    """An axis of some 60 dB over 70 pt: 1e-4 is a thousandth of a point, 10 % is 0.83 dB, a point."""
    other = bode_picture(scaled(loop, 1.0 + change), "second")
    assert alike(bode, other) == same
    assert alike(other, bode) == same


def test_other_words_are_another_figure(loop, bode):
    label = bode.strokes.index(">rad/s<")
    assert not alike(bode, replace(bode, strokes=f"{bode.strokes[:label]}>rad<{bode.strokes[label + 7 :]}"))
    assert not alike(bode, replace(bode, places=bode.places[:-1]))


@pytest.fixture(scope="module")
def page(studies, loop, tmp_path_factory):
    """Write a page of three axes, of which x and y are the same and z is not."""
    factors = dict(zip(AXES, (1.0, 1.0 + 1e-7, 1.5), strict=True))
    loops = tuple(scaled(loop, factor, name=f"force[{axis}]") for axis, factor in factors.items())
    path = tmp_path_factory.mktemp("shared") / "page.html"
    write_stability_page(replace(studies.late, loops=loops, sweeps=()), path)
    return path.read_text(encoding="utf-8")


def test_identical_axes_are_one_figure(page):
    assert_self_contained(page)
    first, second, third = parse(page).xpath("//article[contains(@class, 'loop')]")
    captions = [" ".join(actual.text_content().split()) for actual in first.xpath(".//figcaption")]
    assert captions[:3] == ["Bode: force[x], [y]", "Nichols: force[x], [y]", "Nyquist: force[x], [y]"]
    assert second.xpath(".//figure") == []
    notes = [actual.text_content() for actual in second.xpath(".//p") if ": see force[x]" in actual.text_content()]
    for note, labels in zip(notes, ("Bode, Nichols: ", "Nyquist, "), strict=True):
        assert note.startswith(labels)
        assert "force[x]" in note
        assert "0.5 pt" in note
    assert [actual.text_content() for actual in third.xpath(".//figcaption")][:3] == ["Bode", "Nichols", "Nyquist"]


def test_the_tables_of_each_are_there(page):
    text = text_of(page)
    assert text.count("Classical") == text.count("Modes") == len(AXES)
    tables = [len(actual.xpath(".//table")) for actual in parse(page).xpath("//article[contains(@class, 'loop')]")]
    assert len(set(tables)) == 1


def test_names_of_loops_are_said_briefly(loop):
    named = [replace(loop, name=name) for name in ("torque[1]", "torque[2]", "roll")]
    assert together(named) == "torque[1], [2], roll"
    assert together([loop, replace(loop, point="elsewhere")]) == f"late at {loop.point}, late at elsewhere"


def test_numbers_of_places_are_read_as_they_stand():
    actual = picture_of('<path id="a-b" d="M 1.5 -2 L 3e-1 4"/><text x="5" style="font: 8px">6</text>')
    np.testing.assert_array_equal(actual.places, [1.5, -2.0, 0.3, 4.0, 5.0])
    assert ">6<" in actual.strokes
    assert "8px" in actual.strokes
