"""Page of a run: header, faults, numbers, parameters, figures, short and failed runs. Truth: a hand-written run."""

import numpy as np
import pytest

from perilune.analysis.documents.of.simulation.run import ENDINGS
from perilune.analysis.runtime.flight.results import LOST
from tests.support.documents.run_page import write_run_report
from tests.support.documents.subsections import trajectory_panels
from tests.support.pages.checks import assert_self_contained, data_values, parse, section_of, text_of
from tests.support.pages.samples import DIGEST, run_result


def write(result, path):
    write_run_report(result, path, "A voyage & more")
    return path.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return write(run_result(), tmp_path_factory.mktemp("run") / "new" / "run.html")


def test_stands_alone(page):
    assert_self_contained(page)


def test_same_result_same_bytes(page, tmp_path):
    assert write(run_result(), tmp_path / "again.html") == page
    assert "<metadata" not in page


def test_header(page):
    text = text_of(page)
    for words in ("A voyage & more", ENDINGS["finished"], "99.5 s", "0.5 s", "sequential", "0.0.1"):
        assert words in text


def test_faults_are_listed_where_there_are_any(page, tmp_path):
    result = run_result()
    result.provenance["faults"] = ["ship.mass=bias:1@2", "ship.status=freeze@3..4"]
    assert "Faults: ship.mass=bias:1@2; ship.status=freeze@3..4." in text_of(write(result, tmp_path / "x.html"))
    assert "Faults" not in page


def test_every_signal_has_its_numbers(page):
    result, text, values = run_result(), text_of(page), set(data_values(page))
    for name, signal in result.signals.items():
        assert name in text
        if result.types[name] == "Real":
            for number in (signal[0], signal.min(), signal.max(), signal[-1]):
                assert repr(float(number)) in values, name


def test_parameters_and_hashes(page):
    text, values = text_of(page), data_values(page)
    assert "ship.length = 3.25" in text
    assert "ship.armed = false" in text
    assert "ship.name = <b>Beagle</b>" in text  # as text, not as markup
    assert not parse(page).xpath("//b")
    assert {"3.25", "2", "false"} <= set(values)
    assert DIGEST in text
    assert text.count(DIGEST[::-1]) == 2


def test_key_values(page):
    rows = [
        " ".join(row.xpath(".//text()[normalize-space()]"))
        for row in section_of(page, "Final values").xpath(".//tbody/tr")
    ]
    assert rows[0] == "finished true"
    assert any("".join(row.split()).startswith("ship.position\N{MINUS SIGN}990,4950.12,149.5m") for row in rows)
    assert "ship.status maximum over run 2" in rows
    assert not any(row.startswith("crew.cook.position") for row in rows)  # the same values again


def test_angles_are_in_degrees_on_screen_and_rad_inside(page):
    row = next(row for row in parse(page).xpath("//tr") if row[0].text_content() == "ship.tilt")
    assert row[1].text_content() == "deg"
    assert row[5].text_content().startswith("57.00")
    assert float(row[5][0].get("value")) == run_result()["ship.tilt"][-1]


def test_constants_copies_and_spikes_are_said(page):
    text = text_of(page)
    assert "ship.mass = 12.5 kg" in text
    assert "crew.cook.position = ship.position" in text
    assert "clipped; full range −1 to 1e6"  # noqa: RUF001 in text


def test_figures_are_labelled(page):
    labels = parse(page).xpath("//*[local-name()='svg']/@aria-label")
    assert labels[0].startswith("Plan view of ship")
    assert any("tilt" in label for label in labels)
    assert "tilt, deg" in text_of(page)


@pytest.mark.parametrize("status", ["nonfinite", "failed", *LOST])
def test_a_run_that_broke_off_says_why(status, tmp_path):
    result = run_result(status=status, message="ship.tilt is nan at t = 24.5 s")
    result["ship.tilt"][-1] = np.nan
    result["crew.cook.spike"][:] = np.nan
    page = write(result, tmp_path / "run.html")
    assert_self_contained(page)
    assert ENDINGS[status] in text_of(page)
    assert result.message in text_of(page)
    assert "not a number" in text_of(page)


@pytest.mark.parametrize("rows", [0, 1, 2])
def test_short_runs(rows, tmp_path):
    page = write(run_result(rows=rows, status="failed", message="at once"), tmp_path / "run.html")
    assert_self_contained(page)
    assert ("The run ended before its first sample" in text_of(page)) == (rows == 0)


def test_no_position_no_trajectory(page, tmp_path):
    assert "Trajectory" in text_of(page)
    result = run_result()
    for name in [name for name in result.signals if "position" in name]:
        del result.signals[name]
    assert "Trajectory" not in text_of(write(result, tmp_path / "run.html"))


@pytest.mark.parametrize("many", [False, True])
def test_a_system_without_any_of_what_one_looks_at_first(many, tmp_path):
    result = run_result()
    retained = {"ship.tilt", "ship.mass"}
    for name in set(result.signals) - retained:
        del result.signals[name]
    for index in range(20 if many else 0):
        name = f"ship.extra_{index}"
        result.signals[name], result.units[name], result.types[name] = result.time + index, None, "Real"
    page = write(result, tmp_path / "run.html")
    section = section_of(page, "Final values")
    words = " ".join(section.text_content().split())
    assert "before its first sample" not in text_of(page)
    assert ("ship.tilt" in words) != many
    assert ("No position, velocity or status" in words) == many
    if not many:
        assert {repr(float(result[name][-1])) for name in retained} <= set(section.xpath(".//data/@value"))


def sections_and_folds(page):
    """Return figures by their labels: those that are open, and those that are folded away."""
    labels = [
        (figure.get("aria-label"), bool(figure.xpath("ancestor::details[not(@open)]")))
        for figure in parse(page).xpath("//*[local-name()='svg'][@aria-label]")
    ]
    return [label for label, folded in labels if not folded], [label for label, folded in labels if folded]


def test_states_and_commands_come_first_and_the_rest_is_folded(page):
    """Moving states and commands by name first; everything else is in the page, without a script."""
    displayed, folded = sections_and_folds(page)
    assert "ship.position over time" in displayed
    assert "ship.tilt over time" in displayed
    assert {"crew.cook.spike over time", "crew.cook.awake over time", "finished over time"} <= set(folded)
    assert "ship.mass" not in " ".join(displayed)  # constant: said, not drawn
    headings = [heading.text for heading in parse(page).xpath("//h2")]
    assert headings[:4] == ["Trajectory", "Final values", "States and commands", "Other signals"]


def test_where_no_name_says_what_is_a_state_the_first_panels_are_open(tmp_path):
    result = run_result()
    for name in list(result.signals):
        del result.signals[name]
    for index in range(20):
        name = f"ship.extra_{index}"
        result.signals[name], result.units[name], result.types[name] = result.time + index, None, "Real"
    displayed, folded = sections_and_folds(write(result, tmp_path / "run.html"))
    assert [len(displayed), len(folded)] == [12, 8]


def over_the_moon(way):
    """Return a flight that descends from 50 km along ``way`` (rad of the Moon) to the origin."""
    result, radius = run_result(), 1.7374e6
    angle = np.linspace(-way, 0.0, result.time.size)
    altitude = 5e4 * np.abs(angle) / way
    position = [(radius + altitude) * np.sin(angle), 0.0 * angle, (radius + altitude) * np.cos(angle) - radius]
    for name in [name for name in result.signals if name.startswith("crew.cook.position")]:
        del result.signals[name]
    for k, values in enumerate(position, 1):
        result.signals[f"ship.position[{k}]"] = values
    result.signals["ship.altitude"], result.units["ship.altitude"], result.types["ship.altitude"] = (
        altitude,
        "m",
        "Real",
    )
    return result


@pytest.mark.parametrize("way", [0.15, 3.5])
def test_a_side_view_over_a_round_body_is_altitude_over_the_ground(way, tmp_path):
    """A steady descent stays one: on the tangent plane it would rise first (0.15 rad), or go round (3.5 rad)."""
    (side,) = trajectory_panels(over_the_moon(way))[-1].figure.charts
    x, y = side.curves[0].x, side.curves[0].y
    np.testing.assert_allclose(x, 1737.4 * np.linspace(-way, 0.0, x.size), atol=1e-3)
    np.testing.assert_allclose(y, np.linspace(50.0, 0.0, y.size), atol=1e-3)
    assert side.x.label == "downrange from the origin, km"
    assert [rule.at for rule in side.rules] == [0.0]  # the surface
    assert side.areas[0].y.max() == 0.0
    text = text_of(write(over_the_moon(way), tmp_path / "run.html"))
    assert "altitude, km" in text
    assert "a sphere of 1737.4 km radius" in text
    assert ("Ground track" in text) == (way > 1.0)
