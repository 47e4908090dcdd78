"""From a mark on a batch's page to its trial, by pointer and by keys: replay command, and brush.

Truth: the table of the campaign; the output of the copied command.
"""

from __future__ import annotations

import re
import shlex

import pyarrow.parquet as parquet
import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from perilune.analysis.cli import main
from perilune.analysis.documents.common.quantities import number
from tests.support.pages.driven import driven, scroll_to_plot

pytestmark = pytest.mark.usefixtures("fmus")

VARIANT = "astar_guidance"
# How many px of a figure's canvases have about the colour of failures, fully opaque.
STRONG = """
const all = [...arguments[0].querySelectorAll("canvas")];
const [{ width, height }] = all;
const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
for (const canvas of all) copy.drawImage(canvas, 0, 0);
const pixels = copy.getImageData(0, 0, width, height).data;
let count = 0;
for (let at = 0; at < pixels.length; at += 4) {
  const [red, green, blue, opacity] = pixels.subarray(at, at + 4);
  if (opacity > 200 && Math.abs(red - 213) + Math.abs(green - 94) + blue < 60) count++;
}
return count;
"""


def frame_of(driver, label):
    frame = driver.find_element(By.XPATH, f"//*[starts-with(@aria-label, '{label}')]/..")
    return frame, scroll_to_plot(driver, frame)


def entries(card):
    terms, texts = (card.find_elements(By.TAG_NAME, tag) for tag in ("dt", "dd"))
    return {term.text: text.text for term, text in zip(terms, texts, strict=True)}


def test_from_a_failure_to_its_flight(browser, batch, capsys):
    table = parquet.read_table(batch / "out" / "trials").to_pylist()
    trials = {row["trial"]: row for row in table if row["variant"] == VARIANT}
    with driven(browser, batch / "page.html", unfolded=True) as driver:
        frame, _ = frame_of(driver, f"Failures of {VARIANT} over heading_error")
        frame.find_element(By.CSS_SELECTOR, ".chart").send_keys(Keys.ARROW_RIGHT)  # the leftmost mark: a failure
        hovered = entries(driver.find_element(By.CSS_SELECTOR, ".card:not(.pinned)"))
        trial, variant = re.fullmatch(r"(\d+) of (\w+)", hovered["trial"]).groups()
        leftmost = min(trials.values(), key=lambda row: row["draw.heading_error"])
        assert (int(trial), variant) == (leftmost["trial"], VARIANT)
        assert hovered["outcome"] == f"failure, {leftmost['status']}"
        for name in ("metric.position_error", "metric.flight_time", "draw.speed", "draw.heading_error"):
            assert hovered[name.partition(".")[2]].split()[0] == number(leftmost[name], 6)
        ActionChains(driver).send_keys(Keys.ENTER).perform()
        pinned = driver.find_element(By.CSS_SELECTOR, ".card.pinned")
        command = pinned.find_element(By.TAG_NAME, "code").text
        copy = next(each for each in pinned.find_elements(By.TAG_NAME, "button") if each.text == "Copy command")
        copy.click()
        WebDriverWait(driver, 10).until(lambda _: copy.text == "Copied")
        listed = driver.find_elements(By.CSS_SELECTOR, "code.command + .copy")
        assert len(listed) == len(driver.find_elements(By.CSS_SELECTOR, "code.command")) > 0
        driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", listed[0])
        listed[0].click()
        WebDriverWait(driver, 10).until(lambda _: listed[0].text == "Copied")
    program, *arguments = shlex.split(command)
    assert program == "perilune"
    capsys.readouterr()
    assert main(arguments) in (0, 1)
    printed = capsys.readouterr().out
    assert "identical to the stored trial, bit for bit" in printed
    assert f"{VARIANT}: trial {trial}: " in printed


def test_a_brush_chooses_trials_in_all_figures(browser, batch):
    with driven(browser, batch / "page.html", unfolded=True) as driver:
        frame, area = frame_of(driver, f"Failures of {VARIANT} over heading_error")
        before = driver.execute_script(STRONG, frame)
        assert before > 100
        width, height = area.size["width"], area.size["height"]
        ActionChains(driver).move_to_element_with_offset(area, 0, -height // 2 + 2).click_and_hold().move_by_offset(
            width // 2 - 2, height - 4
        ).release().perform()
        within = driver.execute_script(STRONG, frame)
        assert 0 < within < 0.7 * before  # failures lie at both ends; those at the left are faint now
        ActionChains(driver).send_keys(Keys.ESCAPE).perform()
        assert driver.execute_script(STRONG, frame) == before


def test_a_brush_counts_its_trials_and_has_their_command(browser, batch):
    """Truth: the trials of the variant in the table."""
    table = parquet.read_table(batch / "out" / "trials").to_pylist()
    mine = [row for row in table if row["variant"] == VARIANT]
    failures = sum(not row["success"] for row in mine)
    with driven(browser, batch / "page.html", unfolded=True) as driver:
        _, area = frame_of(driver, f"Failures of {VARIANT} over heading_error")
        width, height = area.size["width"], area.size["height"]
        ActionChains(driver).move_to_element_with_offset(
            area, 2 - width // 2, 2 - height // 2
        ).click_and_hold().move_by_offset(width - 4, height - 4).release().perform()
        note = driver.find_element(By.CSS_SELECTOR, ".chosen")
        assert note.text.startswith(f"{len(mine)} of {len(table)} trials, {failures} failures")
        code = note.find_element(By.TAG_NAME, "code")
        assert code.get_attribute("textContent").endswith("\u2026")
        code.click()  # as who selects it does
        command = code.get_attribute("textContent")
        numbers, _, end = command.removeprefix("for trial in ").partition("; do perilune replay ")
        assert [int(number) for number in numbers.split()] == sorted(row["trial"] for row in mine)
        assert end.endswith("; done")
        area.find_element(By.XPATH, "..").send_keys(Keys.ESCAPE)
        assert not note.is_displayed()


def test_a_distribution_names_its_trials(browser, batch):
    table = parquet.read_table(batch / "out" / "trials").to_pylist()
    with driven(browser, batch / "page.html", unfolded=True) as driver:
        _, area = frame_of(driver, "Cumulative distribution of flight_time")
        for step in range(20):  # from top to bottom over the steep lines, until one is near
            height = area.size["height"]
            left = -round(0.34 * area.size["width"])
            ActionChains(driver).move_to_element_with_offset(area, left, round((step / 20 - 0.5) * height)).perform()
            card = driver.find_element(By.CSS_SELECTOR, ".card:not(.pinned)")
            if card.is_displayed():
                break
        trial, variant = re.fullmatch(r"(\d+) of (\w+)", entries(card)["trial"]).groups()
        (row,) = [row for row in table if (row["trial"], row["variant"]) == (int(trial), variant)]
        displayed = float(entries(card)["flight_time"].replace("about ", "").split()[0])
        assert displayed == pytest.approx(row["metric.flight_time"], rel=1e-3)


@pytest.mark.slow
def test_keys_go_along_a_distribution_and_pin(browser, batch):
    """Truth: the table's trials in the order of the metric."""
    table = parquet.read_table(batch / "out" / "trials").to_pylist()
    with driven(browser, batch / "page.html", unfolded=True) as driver:
        frame, _ = frame_of(driver, "Cumulative distribution of flight_time")
        plot = frame.find_element(By.CSS_SELECTOR, ".chart")
        plot.send_keys(Keys.ARROW_RIGHT)
        first = entries(driver.find_element(By.CSS_SELECTOR, ".card:not(.pinned)"))
        _, variant = re.fullmatch(r"(\d+) of (\w+)", first["trial"]).groups()
        ranked = sorted(row["metric.flight_time"] for row in table if row["variant"] == variant)
        assert first["flight_time"].split()[0] == number(ranked[0], 6)
        plot.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_LEFT, Keys.ENTER)
        pinned = driver.find_element(By.CSS_SELECTOR, ".card.pinned")
        assert pinned.is_displayed()
        about = entries(pinned)["flight_time"].split()[-2]
        assert float(about) == pytest.approx(ranked[1], rel=1e-3)
        trial, _ = re.fullmatch(r"(\d+) of (\w+)", entries(pinned)["trial"]).groups()
        assert f" {trial} " in f"{pinned.find_element(By.TAG_NAME, 'code').text} "
