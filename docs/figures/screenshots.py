"""Screenshots of pages in Chromium, docs/images/pages: `make screenshots`, after build_fmus.py."""

from __future__ import annotations

import io
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from PIL import Image
from selenium.webdriver import Chrome
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.ui import WebDriverWait

from perilune.analysis.cli import main as perilune
from perilune.common.process import exit_process
from tests.support.campaigns.showing import showing
from tests.support.pages.driven import PATIENCE, driven, scroll_to_plot

from .pictures import IMAGES, LARGEST

TIME = 3930.0  # s, of landing_mission: the approach
TURNING = 20.0  # s, of orbital_attitude: it turns to the orbital frame
CAMPAIGN = ["lunar_terminal_guidance", "--campaign", "paper", "--trials", "2000"]
QUALITY = 88  # of WebP
FLAGS = ("--window-size=1000,1000", "--hide-scrollbars")
AT = "document.dispatchEvent(new CustomEvent('perilune-time', {detail: {time: arguments[0], from: 'screenshots'}}))"
POINT = """
const { right, top } = arguments[0].getBoundingClientRect();
arguments[0].dispatchEvent(new PointerEvent("pointermove", { clientX: right, clientY: top + 60 }));
"""
OPEN = "for (let e = arguments[0].closest('details'); e; e = e.parentElement.closest('details')) e.open = true"
HIDE = "document.querySelector('.explore')?.remove()"  # it covers the page


def main(folder: Path = IMAGES / "pages") -> None:
    """Write the four pictures. Raises ValueError for one that is too large."""
    browser = shutil.which("chromium")
    if browser is None:
        raise SystemExit("no Chromium: make browser")
    with tempfile.TemporaryDirectory() as scratch:
        results = Path(scratch) / "results"
        perilune(["batch", *CAMPAIGN, "--output", str(results)])
        for name, (system, shoot) in RUN.items():
            page = Path(scratch) / f"{system}.html"
            if not page.is_file():
                perilune(["run", system, "--report", str(page)])
            with driven(browser, page, flags=FLAGS) as driver:
                _write(shoot(driver), folder / f"{name}.webp")
        with showing([results]) as (address, _), driven(browser, address, flags=FLAGS) as driver:
            _write(_campaign(driver), folder / "show.webp")


def _scene(driver: Chrome) -> bytes:
    driver.execute_script(HIDE)
    holder = driver.find_element(By.CSS_SELECTOR, "[data-scene]")
    _scroll_to(driver, holder)
    WebDriverWait(driver, PATIENCE).until(lambda _: holder.find_elements(By.CSS_SELECTOR, "[data-drawn]"))
    driver.execute_script(AT, TIME)
    _settle(driver)
    return holder.screenshot_as_png


def _curves(driver: Chrome) -> bytes:
    """Capture the last minute of the altitude and neighbouring panels, with a cursor."""
    frame = driver.find_element(By.XPATH, "//*[@aria-label='plant.altitude over time']/..")
    driver.execute_script(OPEN, frame)
    area = scroll_to_plot(driver, frame)
    width = area.size["width"]
    ActionChains(driver).move_to_element_with_offset(area, round(0.46 * width), 0).click_and_hold().move_by_offset(
        round(0.038 * width), 0
    ).release().perform()
    driver.execute_script(AT, TIME)
    _settle(driver)
    return driver.get_screenshot_as_png()


def _diagram(driver: Chrome) -> bytes:
    driver.execute_script(HIDE)
    diagram = driver.find_element(By.CSS_SELECTOR, "svg.diagram")
    driver.execute_script(OPEN, diagram)
    _scroll_to(driver, diagram)
    driver.execute_script(AT, TURNING)
    driver.execute_script(POINT, driver.find_element(By.CSS_SELECTOR, "g.block[data-block=plant]"))
    _settle(driver)
    return driver.get_screenshot_as_png()


def _campaign(driver: Chrome) -> bytes:
    canvas = driver.find_element(By.CSS_SELECTOR, ".counted canvas")
    ActionChains(driver).move_to_element(canvas).click_and_hold().move_by_offset(60, 0).release().perform()
    _settle(driver)
    _scroll_to(driver, canvas)
    _settle(driver)
    return driver.get_screenshot_as_png()


RUN: dict[str, tuple[str, Callable[[Chrome], bytes]]] = {
    "scene": ("landing_mission", _scene),
    "curves": ("landing_mission", _curves),
    "diagram": ("orbital_attitude", _diagram),
}


def _scroll_to(driver: Chrome, element: WebElement) -> None:
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)


def _settle(driver: Chrome) -> None:
    """Wait until the page has finished drawing."""
    driver.execute_async_script("setTimeout(arguments[0], 1500)")


def _write(picture: bytes, path: Path) -> None:
    Image.open(io.BytesIO(picture)).convert("RGB").save(path, quality=QUALITY, method=6)
    if path.stat().st_size > LARGEST:
        raise ValueError(f"{path.name} has {path.stat().st_size} bytes, {LARGEST} are permitted: take less of the page")
    print(path)


if __name__ == "__main__":
    main()
    exit_process(0)
