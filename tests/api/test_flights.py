"""Result of a simulation in Python: plots draw its signals, notebooks show it, and its page equals the command's page.

Truth: the signals themselves, read back from the drawn lines; lxml; the command's page.
"""

from __future__ import annotations

from base64 import b64decode
from pathlib import Path

import numpy as np
import pytest
from lxml import etree, html

import perilune
from perilune.analysis.cli import main

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"


@pytest.fixture(scope="module")
def flight(fmus):
    return perilune.simulate(SYSTEM, stop_time=60.0)


def pictures(text: str) -> list[etree._Element]:
    """Return the images of a notebook's HTML, parsed."""
    sources = html.fromstring(text).xpath("//img/@src")
    return [etree.fromstring(b64decode(source.removeprefix("data:image/svg+xml;base64,"))) for source in sources]


def test_plots_draw_the_signals(flight):
    figure = flight.plot("plant.velocity", "guidance.thrust_direction_rate[3]", "allocation.thrust")
    assert [len(axes.lines) for axes in figure.axes] == [3, 1, 1]
    for axes, name in zip(figure.axes, ("plant.velocity", "guidance.thrust_direction_rate[3]"), strict=False):
        degrees = np.degrees(1.0) if "rate" in name and flight.units[name] == "rad/s" else 1.0
        for line, column in zip(axes.lines, flight[name].reshape(flight.time.size, -1).T, strict=True):
            np.testing.assert_array_equal(line.get_xdata(), flight.time)
            np.testing.assert_allclose(line.get_ydata(), degrees * column, rtol=1e-15)
    trajectory = flight.plot_trajectory()
    x, y = trajectory.axes[0].lines[0].get_data()
    np.testing.assert_allclose(x, 1e-3 * flight["plant.position"][:, 0])
    np.testing.assert_allclose(y, 1e-3 * flight["plant.position"][:, 2])
    assert etree.fromstring(trajectory._repr_svg_().encode()).tag.endswith("svg")


def test_angles_are_drawn_in_degrees(fmus):
    flight = perilune.simulate("orbital_attitude", stop_time=2.0)
    figure = flight.plot("plant.angles")
    np.testing.assert_allclose(figure.axes[0].lines[0].get_ydata(), np.degrees(flight["plant.angles"][:, 0]))
    assert figure.axes[0].get_title(loc="left") == "plant.angles, deg"
    with pytest.raises(ValueError, match=r"orbital_attitude: no signal COMPONENT\.position"):
        flight.plot_trajectory()


def test_names_that_are_wrong_get_the_nearest(flight):
    for wrong in (lambda: flight["plant.positon"], lambda: flight.plot("plant.positon")):
        with pytest.raises(KeyError, match=r"no signal plant\.positon; the nearest of .*plant\.position"):
            wrong()


def test_a_notebook_shows_a_table_and_a_figure(flight):
    text = flight._repr_html_()
    page = html.fromstring(text)
    assert "stop time reached at t = 60 s, 601 samples" in page.text_content()
    rows = {row.xpath("td[1]")[0].text_content(): row for row in page.xpath("//tbody/tr")}
    assert "FAIL" in rows["distance from the target"].text_content()
    assert len(pictures(text)) == 1
    assert not page.xpath("//*[@id]")  # nothing that another cell could hold too
    assert "<script" not in text
    assert len(repr(flight)) < 100


def test_a_flight_that_asks_for_its_own_figures_shows_these(fmus):
    flight = perilune.simulate("orbital_attitude", stop_time=2.0)
    (figure,) = pictures(flight._repr_html_())
    assert len(figure.xpath("//*[starts-with(@id, 'axes_')]")) >= 1


def test_the_page_is_that_of_the_command(flight, tmp_path):
    flight.report(str(tmp_path / "own.html"))
    assert main(["run", SYSTEM, "--stop-time", "60", "--report", str(tmp_path / "command.html")]) == 1
    assert (tmp_path / "own.html").read_bytes() == (tmp_path / "command.html").read_bytes()


def test_pandas_has_the_signals(flight):
    table = flight.to_pandas()
    np.testing.assert_array_equal(table["plant.position[3]"], flight["plant.position[3]"])
    np.testing.assert_array_equal(table.index, flight.time)


def test_an_interrupted_flight_has_a_page(flight, tmp_path):
    broken = type(flight)(**{**vars(flight), "status": "interrupted", "message": "by Ctrl-C"})
    broken.report(tmp_path / "page.html")
    assert "interrupted" in (tmp_path / "page.html").read_text(encoding="utf-8")


def test_an_own_guidance_from_python(tmp_path, monkeypatch):
    source = """
from perilune import TerminalGuidance, TerminalStatus, vector


class Coasting(TerminalGuidance):
    \"\"\"No thrust.\"\"\"

    def solve(self) -> None:
        self.time_to_go = 10.0
        self.command.thrust_acceleration = 0.0
        self.command.thrust_direction = vector(1.0, 0.0, 0.0)
        self.status = TerminalStatus.GOOD
"""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "coasting.py").write_text(source)
    exported = perilune.export("coasting.py", flavour="python")
    assert exported.paths == (Path("build/fmus/python/coasting.fmu"),)
    flight = perilune.simulate(SYSTEM, use={"guidance": "coasting"}, stop_time=10.0, set={"guidance.gravity": 1.62})
    fall = flight["plant.velocity"][:, 2] - flight["plant.velocity"][0, 2]
    slope = np.polyfit(flight.time, fall, 1)[0]
    assert np.ptp(np.diff(fall)) < 1e-12  # free fall
    assert 1.6 < -slope < 1.65


def test_a_vector_is_set_as_a_whole(fmus, tmp_path):
    """As a list, an array or a text: the same flight as by elements."""
    target = [10.0, -5.0, 2100.0]
    by_element = {f"guidance.target_position[{index}]": value for index, value in enumerate(target, 1)}
    expected = perilune.simulate(SYSTEM, stop_time=2.0, set=by_element)
    for value in (target, tuple(target), np.array(target), "10, -5, 2100"):
        actual = perilune.simulate(SYSTEM, stop_time=2.0, set={"guidance.target_position": value})
        np.testing.assert_array_equal(actual["guidance.thrust_acceleration"], expected["guidance.thrust_acceleration"])
    campaign = tmp_path / "c.toml"
    metric = '[metric.last]\nexpression = "guidance.thrust_acceleration"\nreduction = "final"\n'
    text = f'system = "{SYSTEM}"\ntrials = 1\nseed = 1\n[set]\n"guidance.target_position" = {target}\n{metric}'
    campaign.write_text(f'{text}[success]\nexpression = "1 < 2"\n')
    batch = perilune.batch(SYSTEM, str(campaign), stop_time=2.0, workers=1)
    assert batch.trials["default"].metrics["last"][0] == expected["guidance.thrust_acceleration"][-1]


def test_faults_are_given_as_texts_too(fmus):
    fault = perilune.Fault("plant.thrust", "override", 0.0, 1.0)
    expected = perilune.simulate(SYSTEM, stop_time=3.0, faults=[fault])
    actual = perilune.simulate(SYSTEM, stop_time=3.0, faults=[str(fault)])
    np.testing.assert_array_equal(actual["plant.velocity"], expected["plant.velocity"])
    with pytest.raises(perilune.InputError, match=r"faults: plant\.thrust=broken@1: unknown kind broken"):
        perilune.simulate(SYSTEM, stop_time=3.0, faults=["plant.thrust=broken@1"])
    with pytest.raises(perilune.InputError, match="a single name, but a list is needed"):
        perilune.simulate(SYSTEM, stop_time=3.0, faults=str(fault))


def test_tables_without_pandas_say_what_to_install(flight, monkeypatch):
    monkeypatch.setattr("perilune.analysis.runtime.flight.results.find_spec", lambda name: None)
    with pytest.raises(ImportError, match=r"pip install 'perilune\[notebook\]'"):
        flight.to_pandas()


def test_the_end_is_said_in_digits_that_mean_something(fmus):
    result = perilune.simulate(SYSTEM, stop_time=0.3)
    assert result.time[-1] == pytest.approx(0.3, abs=1e-12)
    assert repr(result.summary()["end_time"]) == "0.3"
