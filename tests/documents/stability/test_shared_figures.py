"""Indistinguishable figures of several loops are drawn once, and no other figures are omitted.

Truth: loops derived from one another, whose responses differ by known amounts.
"""

from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.documents.chart.axes import fine_axis, linear_axis
from perilune.analysis.documents.chart.lines import line
from perilune.analysis.documents.interactive.charts import NO_BOX, Chart
from perilune.analysis.documents.of.stability.figures import overview_figures
from perilune.analysis.documents.of.stability.shared import are_indistinguishable, combine_loop_names, picture_of
from perilune.analysis.documents.pictures import Figure
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
    return picture_of(overview_figures(loop, name)[0])


@pytest.mark.parametrize(("change", "same"), [(1e-9, True), (1e-4, True), (-1e-4, True), (0.1, False), (1.0, False)])
def test_what_is_closer_than_half_a_line_is_the_same(loop, bode, change, same):
    """An axis of some 60 dB over 70 pt: 1e-4 is a thousandth of a point, 10 % is 0.83 dB, a point."""
    other = bode_picture(scaled(loop, 1.0 + change), "second")
    assert are_indistinguishable(bode, other) == same
    assert are_indistinguishable(other, bode) == same


def test_other_words_are_another_figure(loop, bode):
    figure = overview_figures(loop, "other")[0]
    phase = figure.below
    (tick, _), *ticks = phase.x.ticks
    changed = (
        replace(phase, x=replace(phase.x, label="rad")),
        replace(phase, x=replace(phase.x, ticks=[(tick, "first"), *ticks])),
        replace(phase, title="gain"),
        replace(phase, curves=[replace(phase.curves[0], colour="#000000"), *phase.curves[1:]]),
        replace(phase, rules=phase.rules[:-1]),
    )
    assert are_indistinguishable(bode, picture_of(figure))
    for chart in changed:
        assert not are_indistinguishable(bode, picture_of(replace(figure, below=chart))), chart.title


@pytest.fixture(scope="module")
def page(studies, loop, tmp_path_factory):
    """Write a page of three axes, of which x and y are the same and z is not."""
    factors = dict(zip(AXES, (1.0, 1.0 + 1e-7, 1.5), strict=True))
    loops = tuple(scaled(loop, factor, name=f"force[{axis}]") for axis, factor in factors.items())
    path = tmp_path_factory.mktemp("shared") / "page.html"
    replace(studies.late, loops=loops, sweeps=()).report(path)
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
    assert combine_loop_names(named) == "torque[1], [2], roll"
    assert combine_loop_names([loop, replace(loop, point="elsewhere")]) == f"late at {loop.point}, late at elsewhere"


def test_places_are_those_on_paper():
    """A figure of 4.95 in by 2 in, whose abscissa is logarithmic: what lies beyond the axes is at their edge."""
    points = line(np.array([1.0, 10.0, 1000.0]), np.array([0.0, np.nan, 1.0]), "#000000")
    chart = Chart(NO_BOX, fine_axis((1.0, 100.0)), linear_axis((0.0, 2.0), 2), curves=[points])
    picture = picture_of(Figure("a", "a", "a", chart, 2.0))
    np.testing.assert_allclose(picture.points[-6:], [0.0, 0.5 * 356.4, 356.4, 0.0, np.nan, 72.0])
