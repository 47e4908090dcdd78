"""Interactive figures of a run's page: values at the cursor and zoom, by pointer, keys and touch; unchanged on paper.

Truth: the table of the run (parquet), rounded to float32, with the digits of the page's tables.
"""

from __future__ import annotations

import re
from time import sleep

import numpy as np
import pyarrow.parquet as parquet
import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from perilune.analysis.documents.common.quantities import display_factor, display_unit, number
from perilune.analysis.runtime.ssp.names import elements
from tests.support.pages.driven import driven, scroll_to_plot

pytestmark = pytest.mark.usefixtures("fmus")

LAST = 20.0  # s
UNITS = {"position": "m", "altitude": "m", "velocity": "m/s", "tilt": "rad", "angular_rate": "rad/s", "mass": "kg"}
# Each key pressed, what the panels of states and commands show: by the label of the picture, the texts of its lines.
READ = """
const [plot, keys] = arguments;
const rows = [];
for (const key of keys) {
  plot.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  const texts = {};
  for (const frame of document.querySelectorAll(".live")) {
    const label = frame.querySelector("svg").getAttribute("aria-label");
    const section = frame.closest("section").querySelector("h2").textContent;
    if (!label.endsWith(" over time") || section !== "States and commands") continue;
    texts[label.slice(0, -10)] = [...frame.nextElementSibling.querySelectorAll("span")].map((span) => span.textContent);
  }
  rows.push([document.querySelector(".explore output").textContent, texts]);
}
return rows;
"""

AT = "document.dispatchEvent(new CustomEvent('perilune-time', {detail: {time: arguments[0], from: 'test'}}))"
# The figures that show both or neither of picture and plots.
UNCLEAR = """
const isShown = (picture) => getComputedStyle(picture).visibility === "visible";
return [...document.querySelectorAll(".live")].filter((frame) => frame.clientHeight
  && isShown(frame.querySelector("svg")) === (frame.querySelector("canvas") !== null)).length;
"""
POINT = "document.querySelector(arguments[0]).dispatchEvent(new PointerEvent('pointermove', {clientX: 9, clientY: 9}))"


def panel_of(driver, label):
    """Return the area of the plot of a signal over time, scrolled to."""
    frame = driver.find_element(By.XPATH, f"//*[@aria-label='{label} over time']/..")
    area = scroll_to_plot(driver, frame)
    return frame.find_element(By.CSS_SELECTOR, ".chart"), area


def drag(driver, area, begin, end):
    """Drag from one fraction of an area's width to another."""
    width = area.size["width"]
    left, right = (round((fraction - 0.5) * (width - 2)) for fraction in (begin, end))
    ActionChains(driver).move_to_element_with_offset(area, left, 0).click_and_hold().move_by_offset(
        right - left, 0
    ).release().perform()


def values_of(table, label, row):
    """Return the values that a panel shall show of a signal at a row."""
    names = elements(label, table.column_names)
    unit = UNITS.get(label.rpartition(".")[2])
    return [number(float(np.float32(table[name][row].as_py())) * display_factor(unit), 6) for name in names], unit


def test_the_last_rows_of_a_landing(browser, flight):
    table = parquet.read_table(flight / "flight.parquet")
    time = table["time"].to_numpy()
    with driven(browser, flight / "page.html", unfolded=True) as driver:
        plot, area = panel_of(driver, "plant.altitude")
        drag(driver, area, 0.95, 1.0)
        drag(driver, area, 0.905, 1.0)
        ticks = driver.execute_script("return document.querySelectorAll('.live').length")
        assert ticks > 30
        assert driver.execute_script(UNCLEAR) == 0
        rows = np.flatnonzero(time >= time[-1] - LAST - 1e-9)
        assert rows.size == 201
        read = driver.execute_script(READ, plot, ["End", *["ArrowLeft"] * 200])
        for row, (cursor, texts) in zip(reversed(rows), read, strict=True):
            assert cursor == f"time {number(float(np.float32(time[row])), 6)} s"
            assert len(texts) >= 10
            for label in ("plant.position", "plant.altitude", "plant.velocity", "plant.tilt", "plant.mass"):
                expected, unit = values_of(table, label, int(row))
                pattern = re.compile(rf"(?:(?:\[\d\]|north|west|up) )?(\S+)(?: {re.escape(display_unit(unit))})?$")
                assert [pattern.match(text)[1] for text in texts[label]] == expected, (label, row)
        plot.send_keys("0")
        ActionChains(driver).send_keys(Keys.HOME, Keys.ARROW_RIGHT).perform()
        assert driver.find_element(By.CSS_SELECTOR, ".explore output").text == "time 0.1 s"


def test_the_second_cursor_and_the_visible_range(browser, flight):
    """Truth: differences, slopes, extremes and root mean squares of the rows, by numpy."""
    table = parquet.read_table(flight / "flight.parquet")
    time, altitude = (table[name].to_numpy().astype(np.float32).astype(float) for name in ("time", "plant.altitude"))
    first, second = 50, 90
    with driven(browser, flight / "page.html", unfolded=True) as driver:
        plot, area = panel_of(driver, "plant.altitude")
        keys = ["Home", *["ArrowRight"] * first, "m", *["ArrowRight"] * (second - first)]
        cursor, texts = driver.execute_script(READ, plot, keys)[-1]
        run, rise = time[second] - time[first], altitude[second] - altitude[first]
        assert cursor == f"time {number(time[second], 6)} s, \u0394 {number(run, 6)} s"
        value, difference, slope = texts["plant.altitude"][0].split(", ")
        assert value == f"{number(altitude[second], 6)} m"
        assert difference == f"\u0394 {number(rise, 6)} m"
        assert slope == f"slope {number(rise / run, 6)} m per s"
        assert driver.execute_script("return !arguments[0].querySelector('.mark').hidden", area)

        _, texts = driver.execute_script(READ, plot, ["m", "r"])[-1]
        assert texts["plant.altitude"][0].startswith(f"{number(altitude[second], 6)} m, \u0394 ")  # of the other mark
        _, texts = driver.execute_script(READ, plot, ["m"])[-1]
        statistics = texts["plant.altitude"][0].split(", ")[1:]
        rms = np.sqrt(np.mean(altitude**2))
        exact = {"least": altitude.min(), "greatest": altitude.max(), "rms": rms}
        assert statistics == [f"{name} {number(quantity, 6)}" for name, quantity in exact.items()]


@pytest.mark.slow
def test_a_block_shows_its_signals(browser, flight):
    table = parquet.read_table(flight / "flight.parquet")
    row = int(np.searchsorted(table["time"].to_numpy(), 3900.0 - 1e-6))
    with driven(browser, flight / "page.html") as driver:
        driver.execute_script(AT, float(table["time"][row].as_py()))
        block = "g.block[data-block=plant]"
        driver.execute_script(POINT, block)
        card = next(each for each in driver.find_elements(By.CSS_SELECTOR, ".card") if each.is_displayed())
        WebDriverWait(driver, 10).until(lambda _: "plant.position[3]" in card.text)
        for index, expected in enumerate(values_of(table, "plant.position", row)[0], 1):
            assert f"plant.position[{index}]\n{expected} m" in card.text
        driver.execute_script(f"document.querySelector('{block}').dispatchEvent(new MouseEvent('click'))")
        focused = "return document.activeElement.closest('details[open]') && document.activeElement.ariaLabel"
        assert "plant." in WebDriverWait(driver, 10).until(lambda _: driver.execute_script(focused))


def test_touch_and_buttons_reach_a_row(browser, flight):
    with driven(browser, flight / "page.html", phone=True, unfolded=True) as driver:
        _, area = panel_of(driver, "plant.altitude")
        bounds = driver.execute_script(
            "const b = arguments[0].getBoundingClientRect(); return [b.x, b.y, b.width, b.height]", area
        )
        touch = {"x": bounds[0] + 0.5 * bounds[2], "y": bounds[1] + 0.5 * bounds[3]}
        bar = driver.find_element(By.CSS_SELECTOR, ".explore")
        assert (bar.size["height"], bar.text.split("\n")[0]) == (48, "Tap a figure.")  # px of 844
        driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [touch]})
        driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        cursor = driver.find_element(By.CSS_SELECTOR, ".explore output")
        before = float(re.fullmatch(r"time (\S+) s", cursor.text)[1])
        assert 1500.0 < before < 2500.0
        assert bar.size["height"] == 48
        buttons = [each for each in driver.find_elements(By.CSS_SELECTOR, ".explore button") if each.is_displayed()]
        assert len(buttons) == 6
        for button in buttons:
            assert button.size["height"] >= 40
            assert 0 <= button.location["x"] <= 390 - button.size["width"]
        next(button for button in buttons if button.get_attribute("aria-label") == "next row").click()
        assert float(re.fullmatch(r"time (\S+) s", cursor.text)[1]) == pytest.approx(before + 0.1, abs=1e-6)
        assert driver.execute_script("return document.documentElement.scrollWidth") == 390


# Each action done with the cursor in the middle, the times at both ends of a plot.
ENDS = """
const [area, actions, done] = arguments;
const { left, top, width, height } = area.getBoundingClientRect();
const at = (fraction) => {
  const place = { clientX: left + fraction * width, clientY: top + height / 2 };
  area.dispatchEvent(new PointerEvent("pointermove", { ...place, pointerType: "mouse" }));
  return parseFloat(document.querySelector(".explore output").textContent.split(" ")[1]);
};
const send = {
  key: (key) => area.closest(".chart").dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true })),
  wheel: (deltaY) => area.dispatchEvent(new WheelEvent("wheel", { deltaY, ctrlKey: true, clientX: left + width / 2 })),
  button: (label) => document.querySelector(`.explore button[aria-label="${label}"]`).click(),
};
const all = [];
const next = () => {
  at(0.5);
  const [kind, detail] = actions.shift() ?? [];
  if (!kind) { done(all); return; }
  send[kind](detail);
  requestAnimationFrame(() => { all.push([at(0), at(1)]); next(); });
};
next();
"""


def test_keys_wheel_and_buttons_zoom_about_the_cursor(browser, flight):
    """Truth: the range that is left of the whole one, by arithmetic; a row is 0.1 s."""
    with driven(browser, flight / "page.html", unfolded=True) as driver:
        plot, area = panel_of(driver, "plant.altitude")
        driver.execute_script("arguments[0].focus()", plot)
        actions = [
            ("key", "0"), ("key", "+"), ("key", "-"), ("wheel", -400.0), ("key", "0"),
            ("button", "zoom in"), ("button", "zoom out"), ("key", "+"), ("key", "PageDown"), ("key", "PageUp"),
        ]  # fmt: skip
        ends = np.array(driver.execute_async_script(ENDS, area, actions))
        scale = np.exp(0.0015 * -400.0)
        middle, half = ends[0].mean(), 1.1 * ends[0].mean()  # axes reach a twentieth of the flight beyond both its ends
        expected = [(0.0, 1.0), (0.0, 0.5), (0.0, 1.0), (0.0, scale), (0.0, 1.0)]
        expected += [(0.0, 0.5), (0.0, 1.0), (0.0, 0.5), (0.5, 0.5), (0.0, 0.5)]
        for actual, (shift, size) in zip(ends, expected, strict=True):
            ideal = middle + half * shift + half * size * np.array([-1.0, 1.0])
            assert actual == pytest.approx(np.clip(ideal, *ends[0]), abs=0.004 * half)


@pytest.mark.slow
def test_the_values_under_two_fingers_follow_them(browser, flight):
    with driven(browser, flight / "page.html", phone=True, unfolded=True) as driver:
        _, area = panel_of(driver, "plant.altitude")
        left, top, width, height = driver.execute_script(
            "const b = arguments[0].getBoundingClientRect(); return [b.x, b.y, b.width, b.height]", area
        )

        def touch(kind, *fractions):
            points = [
                {"x": left + fraction * width, "y": top + height / 2, "id": number}
                for number, fraction in enumerate(fractions)
            ]
            driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        def time_at(fraction):
            touch("touchStart", fraction)
            touch("touchEnd")
            text = driver.find_element(By.CSS_SELECTOR, ".explore output").text
            sleep(0.4)  # two taps at once show the whole range
            return float(re.fullmatch(r"time (\S+) s", text)[1])

        before = [time_at(fraction) for fraction in (0.4, 0.6)]
        touch("touchStart", 0.4, 0.6)
        for step in range(1, 11):
            touch("touchMove", 0.4 - 0.02 * step, 0.6 + 0.02 * step)
        touch("touchEnd")
        after = [time_at(fraction) for fraction in (0.2, 0.8)]
        assert after == pytest.approx(before, abs=0.005 * (before[1] - before[0]))


def test_a_script_of_others_does_not_run(browser, flight, tmp_path):
    """The policy permits the page's scripts alone, neither another one nor what an attribute has."""
    text = (flight / "page.html").read_text(encoding="utf-8")
    hostile = "<script>document.title = 'hostile'</script><img src='data:,' onerror=\"document.title = 'hostile'\">"
    page = tmp_path / "page.html"
    page.write_text(text.replace("<main ", f"{hostile}<main ", 1), encoding="utf-8")
    with pytest.raises(AssertionError, match="Content Security Policy"), driven(browser, page) as driver:
        assert driver.title == "landing_mission"
