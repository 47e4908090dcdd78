"""From a mark on a batch's page to the record of its trial: plots next to its numbers, and the scene of all trials.

Truth: the traces and the table of the campaign.
"""

from __future__ import annotations

import numpy as np
import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

from perilune import open_results
from perilune.analysis.documents.common.quantities import number
from tests.support.pages.driven import driven, scroll_to_plot

pytestmark = pytest.mark.usefixtures("fmus")

VARIANT = "analytic_guidance"
AT = "document.dispatchEvent(new CustomEvent('perilune-time', { detail: { time: arguments[0], from: 'test' } }))"


class Card:
    """The pinned card of a driven page."""

    def __init__(self, driver):
        self.driver = driver
        self.element = driver.find_element(By.CSS_SELECTOR, ".card.pinned")

    @property
    def trial(self):
        return self.element.find_element(By.TAG_NAME, "dd").text

    def panels(self):
        """Return values at the cursor by panel, once there are any."""
        WebDriverWait(self.driver, 20).until(lambda _: self.element.find_elements(By.CSS_SELECTOR, ".flight canvas"))
        sections = self.element.find_elements(By.CSS_SELECTOR, ".flight section")
        read = (
            "return arguments[0].querySelector('h4').textContent + '|' + arguments[0].querySelector('output').innerText"
        )
        texts = (self.driver.execute_script(read, section).split("|") for section in sections)
        return {title: values.split("\n") for title, values in texts}

    def press(self, text):
        clickable = self.element.find_elements(By.CSS_SELECTOR, "button, a")
        next(each for each in clickable if each.text == text).click()


def pin_first(driver):
    """Pin the leftmost trial of a figure by keys."""
    frame = driver.find_element(By.XPATH, "//*[starts-with(@aria-label, 'Cumulative distribution')]/..")
    area = scroll_to_plot(driver, frame)
    for step in range(20):
        height = round((step / 20 - 0.5) * area.size["height"])
        ActionChains(driver).move_to_element_with_offset(area, 0, height).click().perform()
        card = Card(driver)
        if card.element.is_displayed():
            return card
    raise AssertionError("no trial was pinned")


def trace(folder, name):
    trial, _, variant = name.split()
    return open_results(folder / "out").traces(variant=variant).sel(trial=int(trial)).dropna("time")


def test_a_pinned_trial_shows_what_it_recorded(browser, recorded):
    with driven(browser, recorded / "page.html") as driver:
        card = pin_first(driver)
        card.panels()
        flight = trace(recorded, card.trial)
        for row in (0, 17, flight.time.size - 1):
            driver.execute_script(AT, float(flight.time[row]))
            panels = card.panels()
            assert len(panels) >= 10
            for name, unit in (("plant.mass", "kg"), ("plant.altitude", "m"), ("allocation.thrust", "N")):
                assert panels[f"{name}, {unit}"] == [f"{number(float(np.float32(flight[name][row])), 6)} {unit}"]
            position = [number(float(np.float32(flight[f"plant.position[{k}]"][row])), 6) for k in (1, 2, 3)]
            assert panels["plant.position, m"] == [
                f"{axis} {text} m" for axis, text in zip(("north", "west", "up"), position, strict=True)
            ]
        first = card.element.find_element(By.CSS_SELECTOR, ".flight .chart")
        first.send_keys(Keys.HOME, Keys.ARROW_RIGHT)
        assert card.panels()["plant.mass, kg"] == [f"{number(float(np.float32(flight['plant.mass'][1])), 6)} kg"]


def test_card_and_scene_show_one_trial_at_one_time(browser, recorded):
    with driven(browser, recorded / "page.html") as driver:
        card = pin_first(driver)
        card.panels()
        trial, _, variant = card.trial.split()
        card.press("Show in the scene")
        WebDriverWait(driver, 30).until(lambda each: each.find_elements(By.CSS_SELECTOR, "[data-drawn]"))
        menu = Select(driver.find_element(By.CSS_SELECTOR, "select[aria-label=body]"))
        assert menu.first_selected_option.text == f"{variant}, trial {trial}"
        assert len(menu.options) == driver.execute_script("return document.querySelectorAll('.scene-mark').length") - 1
        menu.select_by_visible_text(f"{VARIANT}, trial 5")
        WebDriverWait(driver, 20).until(lambda _: card.trial == f"5 of {VARIANT}")
        card.panels()
        slider = driver.find_element(By.CSS_SELECTOR, ".scene-controls input")
        driver.execute_script("arguments[0].value = 40; arguments[0].dispatchEvent(new Event('input'))", slider)
        flight = trace(recorded, card.trial)
        time = float(slider.get_attribute("aria-valuetext").split()[0])
        row = int(np.argmin(np.abs(flight.time.to_numpy() - time)))
        assert flight.time[row] == pytest.approx(time, abs=1e-3)
        mass = f"{number(float(np.float32(flight['plant.mass'][row])), 6)} kg"
        WebDriverWait(driver, 10).until(lambda _: card.panels()["plant.mass, kg"] == [mass])


@pytest.mark.slow
def test_on_a_phone_every_control_is_within_the_screen(browser, recorded):
    with driven(browser, recorded / "page.html", phone=True) as driver:
        driver.execute_script(
            "document.dispatchEvent(new CustomEvent('perilune-trial', { detail: arguments[0] }))",
            {"variant": VARIANT, "trial": 3, "from": "test"},
        )
        card = Card(driver)
        card.panels()
        for aside in (True, False):
            if not aside:
                card.press("Numbers")
            for control in card.element.find_elements(By.CSS_SELECTOR, "button, a"):
                if control.is_displayed():
                    box = control.rect
                    assert box["height"] >= 40 - 0.01
                    assert box["x"] >= 0
                    assert box["x"] + box["width"] <= 390
        assert driver.execute_script("return document.documentElement.scrollWidth") == 390
        card.press("Close")
        assert not card.element.is_displayed()
