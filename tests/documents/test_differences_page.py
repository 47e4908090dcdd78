"""Page of two compared runs: the element of each line, and lines hidden by the legend.

Truth: hand-written runs with elements that differ by known amounts.
"""

import numpy as np
import pytest
from lxml import html
from selenium.webdriver.common.by import By

from perilune.analysis.differences.differences import compare_runs
from perilune.analysis.differences.recorded_run import RecordedRun
from perilune.analysis.documents.common.colours import COLOURS, INK
from perilune.analysis.documents.of.differences import differences_document
from perilune.analysis.documents.render.html import write_document
from tests.support.pages.checks import parse
from tests.support.pages.driven import driven, scroll_to_plot

TIME = np.linspace(0.0, 10.0, 101)


@pytest.fixture
def page(tmp_path):
    """Write two runs: the first element of v is the same in both; the others differ, as the height does."""

    def run(turn):
        signals = {"h": turn * TIME, "v[1]": 0.0 * TIME, "v[2]": turn * TIME**2, "v[3]": turn - TIME}
        return RecordedRun("run", "", TIME, signals, dict.fromkeys(signals, "m"), frozenset())

    path = tmp_path / "page.html"
    write_document(differences_document(compare_runs(run(1.0), run(1.5)), 1e-9), path)
    return path


def test_the_legend_names_runs_and_elements(page):
    root = parse(page.read_text(encoding="utf-8"))
    legend = root.xpath("//p[contains(@class, 'legend')]/span[@class='who']")
    assert [" ".join(entry.text_content().split()) for entry in legend] == ["first", "second", "[2]", "[3]"]
    colours = [entry.xpath(".//*[local-name()='line']/@stroke")[0] for entry in legend]
    assert colours == [INK, INK, COLOURS[0], COLOURS[1]]
    (vector,) = root.xpath("//*[@aria-label='v in both runs over time']")
    picture = html.tostring(vector).decode().upper()
    assert all(colour in picture for colour in COLOURS[:2])
    assert COLOURS[2] not in picture


def test_elements_along_axes_have_their_names(tmp_path):
    """An axis has the colour of its index, as elements without a name; a run that knows none gets the other's."""

    def run(turn, axes):
        signals = {f"{name}[{k}]": turn * TIME**k + ord(name) for name in "vwxyz" for k in (1, 2)}
        return RecordedRun("run", "", TIME, signals, {}, frozenset(), axes=axes)

    axes = {"v[1]": "east", "v[2]": "north", "w[1]": "east", "w[2]": "north"}
    write_document(differences_document(compare_runs(run(1.0, {}), run(1.5, axes)), 1e-9), tmp_path / "page.html")
    root = parse((tmp_path / "page.html").read_text(encoding="utf-8"))
    entries = root.xpath("//span[@class='who']")
    assert [entry.get("data-lines") for entry in entries] == ["first", "second", "east [1]", "north [2]"]


@pytest.mark.slow
@pytest.mark.usefixtures("fmus")
def test_a_legend_hides_a_run_and_an_element_of_all_plots(browser, page):
    """The lines that are still drawn, as the values at the cursor name them."""
    with driven(browser, page) as driver:
        frame = driver.find_element(By.XPATH, "//*[@aria-label='v in both runs over time']/..")
        scroll_to_plot(driver, frame)
        at = "document.dispatchEvent(new CustomEvent('perilune-time', {detail: {time: 5.0, from: 'test'}}))"
        driver.execute_script(at)
        values = frame.find_element(By.XPATH, "following-sibling::output")
        entries = {entry.text: entry for entry in driver.find_elements(By.CSS_SELECTOR, ".legend .who")}

        def named(*toggled):
            for name in toggled:
                driver.execute_script("arguments[0].click()", entries[name])
            return sorted(span.text for span in values.find_elements(By.TAG_NAME, "span"))

        whole = {
            "first [2]": "25",
            "first [3]": "\N{MINUS SIGN}4",
            "second [2]": "37.5",
            "second [3]": "\N{MINUS SIGN}3.5",
        }
        texts = {name: f"{name} {value} m" for name, value in whole.items()}
        assert named() == sorted(texts.values())
        assert named("second") == [texts["first [2]"], texts["first [3]"]]
        assert named("second", "[2]") == [texts["first [3]"], texts["second [3]"]]
        assert named("[2]", "first") == [texts["second [2]"], texts["second [3]"]]
