"""Names of axes on the page of a run: in legends, titles and tables, with and without scripts.

Truth: the declared names, and the signal of each name.
"""

from __future__ import annotations

import numpy as np
import pytest
from selenium.webdriver.common.by import By

from perilune.analysis.documents.of.simulation.final_values import key_values, signal_table
from perilune.analysis.documents.of.simulation.histories import signal_plot
from perilune.analysis.documents.of.simulation.trajectory import trajectory_reading
from perilune.analysis.documents.render.words import cell_text
from tests.support.documents.run_page import write_run_report
from tests.support.documents.subsections import first_histories, trajectory_panels
from tests.support.pages.checks import parse
from tests.support.pages.driven import driven, scroll_to_plot
from tests.support.pages.samples import run_result

AXES = ("north", "west", "up")
SHIP = "(//h3[.='ship'])[1]"
POSITIONS = ("ship.position", "crew.cook.position")


def named_run():
    """Return the run of the samples, its positions along named axes, and a quaternion without."""
    run = run_result()
    run.provenance["axes"] = {f"{vector}[{k}]": axis for vector in POSITIONS for k, axis in enumerate(AXES, 1)}
    for k in range(1, 5):
        name = f"ship.quaternion[{k}]"
        run.signals[name], run.units[name], run.types[name] = np.cos(k * run.time), None, "Real"
    return run


@pytest.fixture
def page(tmp_path):
    write_run_report(named_run(), tmp_path / "page.html", "Named")
    return tmp_path / "page.html"


def test_a_legend_has_axes_and_the_indices_of_what_has_none():
    histories = first_histories(named_run())
    assert [label for _, label in histories[0].legend] == [*AXES, "[1]", "[2]", "[3]", "[4]"]
    (panel,) = (each for each in histories[0].panels if each.label.startswith("position"))
    assert [curve.name for curve in panel.figure.charts[0].curves] == list(AXES)
    assert [label for _, label in first_histories(run_result())[0].legend] == ["[1]", "[2]", "[3]"]


def test_tables_have_the_axis_next_to_the_name():
    run = named_run()
    (row,) = (row for row in key_values(run) if row.label == "ship.position" and len(row.values) == 3)
    assert row.note == "north, west, up"
    expected = [" ".join([name, *run.provenance["axes"].get(name, "").split()]) for name in run.signals]
    assert [cell_text(label) for label, *_ in signal_table(run).rows] == expected


def test_views_of_a_trajectory_are_called_by_axes_that_all_paths_have():
    run = named_run()
    run.signals["crew.cook.position[1]"] = run["crew.cook.position[1]"] + 1.0  # else it repeats the ship's
    plan, side = trajectory_panels(run)
    assert [panel.figure.charts[0].x.label for panel in (plan, side)] == ["west, m", "west, m"]
    assert [f">{words}<" in str(panel.figure.svg) for panel, words in ((plan, "north, m"), (side, "up, m"))] == [
        True,
        True,
    ]
    for k in (1, 2, 3):
        run.provenance["axes"][f"crew.cook.position[{k}]"] = "xyz"[k - 1]
    plan, _ = trajectory_panels(run)
    assert plan.figure.charts[0].x.label == "position[2], m"
    assert "Elements of the position" in trajectory_reading(run)


def test_a_figure_for_a_notebook_has_them():
    figure = signal_plot(named_run(), ["ship.position", "ship.position[3]", "ship.quaternion"])
    texts = [[text.get_text() for text in axes.get_legend().get_texts()] for axes in figure.axes if axes.get_legend()]
    assert texts == [list(AXES), ["[1]", "[2]", "[3]", "[4]"]]
    assert "ship.position up, m" in {axes.get_title(loc="left") for axes in figure.axes}


def test_scripts_have_the_same_names_and_an_entry_hides_its_axis_alone(browser, page):
    entries = parse(page.read_text(encoding="utf-8")).xpath(f"{SHIP}/following-sibling::p[1]/span")
    static = [entry.text_content().strip() for entry in entries]
    with driven(browser, page) as driver:
        entries = driver.find_elements(By.XPATH, f"{SHIP}/following-sibling::p[1]/span")
        assert [entry.text for entry in entries] == static
        frames = driver.find_elements(By.XPATH, f"{SHIP}/following-sibling::div[1]//div[contains(@class, 'live')]")
        for frame in frames:
            scroll_to_plot(driver, frame)
        at = "document.dispatchEvent(new CustomEvent('perilune-time', {detail: {time: 5.0, from: 'test'}}))"
        driver.execute_script(at)

        def named():
            outputs = [frame.find_element(By.XPATH, "following-sibling::output") for frame in frames]
            texts = [[span.text for span in output.find_elements(By.TAG_NAME, "span")] for output in outputs]
            return [text.split()[0] for several in texts if len(several) > 1 for text in several]

        assert sorted(named()) == sorted(static)
        driver.execute_script("arguments[0].click()", entries[static.index("west")])
        assert sorted(named()) == sorted(set(static) - {"west"})
