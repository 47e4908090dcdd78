"""Margins over the time of flight: loops drawn as one line, content and place of the figure.

Truth: python-control's crossings of the delayed double integrator, with a different gain for each time.
"""

from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.documents.of.stability.over_time import margin_histories, over_time_chart
from perilune.analysis.stability.loops.margin_values import MarginQuantity
from perilune.analysis.stability.loops.readings import Crossing
from tests.support.loops.exact_margins import crossings
from tests.support.loops.exact_systems import late_double_integrator
from tests.support.pages.checks import assert_self_contained, parse, text_of

GAINS = {30.0: 0.25, 10.0: 0.2, 20.0: 0.3}  # derivative gain (s) by time (s), not in order
DECIBEL = 20.0 / np.log(10.0)


def with_gain(loop, derivative, point, **changed):
    gain, phase, at = crossings(late_double_integrator(derivative=derivative).loop)
    classical = replace(
        loop.classical,
        gain=tuple(Crossing(float(value), 1.0) for value in gain),
        phase=tuple(Crossing(float(value), float(w)) for value, w in zip(phase, at, strict=True)),
    )
    return replace(loop, point=point, classical=classical, dispersion=None, **changed)


@pytest.fixture(scope="module")
def report(studies):
    """Return a report of two axes that are the same, and one that is unstable at the last time."""
    late = studies.late
    points = tuple(replace(late.points[0], name=f"p{time:g}", time=time) for time in GAINS)
    loops = [with_gain(late.loops[0], gain, f"p{time:g}") for time, gain in GAINS.items()]
    axes = [replace(loop, name=f"axis[{index}]") for index in (1, 2) for loop in loops]
    axes += [replace(loop, name="other", stable=loop.point != "p30") for loop in loops]
    return replace(late, points=points, loops=tuple(axes), sweeps=())


def test_what_is_drawn_is_python_controls(report):
    same, other = margin_histories(report)
    assert [loops[0].name for loops in same.loops] == ["axis[1]", "axis[2]"]
    assert same.times.tolist() == other.times.tolist() == [10.0, 20.0, 30.0]
    for quantity, place in ((MarginQuantity.GAIN, 0), (MarginQuantity.PHASE, 1)):
        chart = over_time_chart([same, other], quantity)
        exact = [crossings(late_double_integrator(derivative=GAINS[time]).loop)[place] for time in same.times]
        displayed = [DECIBEL * np.log(values) if place == 0 else np.degrees(values) for values in exact]
        upper = [min(values[values >= 0.0]) for values in displayed]
        np.testing.assert_allclose(chart.curves[0].y, upper, rtol=1e-6)
        limit = 6.0 if place == 0 else 30.0
        assert limit in [rule.at for rule in chart.rules]
        (cross,) = (curve for curve in chart.curves if curve.marker and len(curve.marker.outline) == 2)
        assert (cross.x.tolist(), cross.y.tolist()) == ([30.0], [0.0])


def test_another_flight_is_no_part_of_the_line(report):
    """A point with other settings, and loops that are studied at one time only."""
    points = (replace(report.points[0], settings={"plant.mass": 2.0}), *report.points[1:])
    assert all(course.times.tolist() == [10.0, 20.0] for course in margin_histories(replace(report, points=points)))
    same_time = tuple(replace(point, time=5.0) for point in report.points)
    assert margin_histories(replace(report, points=same_time)) == []


def test_the_page_begins_with_it(report, stability_page, tmp_path):
    two = [loop for loop in report.loops if loop.name != "other" and loop.point != "p20"]
    replace(report, loops=tuple(two)).report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert_self_contained(page)
    headings = [element.text for element in parse(page).xpath("//h2")]
    assert headings[:2] == ["Margins over the time of flight", "Verdict"]
    text = " ".join(text_of(page).split())
    assert "p10 at 10 s, p30 at 30 s" in text
    assert "axis[1], [2]" in text
    assert "time of flight" not in text_of(stability_page.read_text(encoding="utf-8"))  # each loop at one time
