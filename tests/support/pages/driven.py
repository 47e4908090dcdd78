"""Page in a browser driven by a test: pointer, touch and keys, by Selenium and Debian's chromium-driver."""

from __future__ import annotations

import shutil
from collections import defaultdict
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from selenium.webdriver import Chrome, ChromeOptions
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.ui import WebDriverWait

from tests.support.pages.scripts import require_scripts

COMPOSITING = "--disable-gpu-compositing"
# As Chromium does without a graphics processor: WebGL by SwiftShader, the page drawn and composed by the processor.
FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    COMPOSITING,
)
READ_BACK = "GPU stall due to ReadPixels"  # Chromium's own, when the page is composed by the processor
PHONE = {"width": 390, "height": 844, "pixelRatio": 2.0, "touch": True}
PATIENCE = 60  # s


# Browsers between two tests, by what they were started with: a start takes a second and a half of processor time.
_idle: defaultdict[tuple[str, ...], list[Chrome]] = defaultdict(list)


@contextmanager
def driven(
    browser: str, page: Path | str, *, phone: bool = False, unfolded: bool = False, flags: Sequence[str] = ()
) -> Iterator[Chrome]:
    """Open a file or an address once its scripts are ready; at the end nothing above "info" may be in the console.

    The page has a new window in a browser that earlier pages may have used. ``unfolded`` opens all sections
    before scripts see them.
    """
    require_scripts()
    arguments = (browser, "phone" if phone else "screen", *FLAGS, "--window-size=1400,1200", *flags)
    driver = _idle[arguments].pop() if _idle[arguments] else started(browser, arguments[2:], phone=phone)
    try:
        if unfolded:
            driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": UNFOLD})
        driver.get(page if isinstance(page, str) else page.as_uri())
        WebDriverWait(driver, PATIENCE).until(lambda each: each.execute_script(READY))
        yield driver
        messages = [entry for entry in driver.get_log("browser") if entry["level"] not in ("DEBUG", "INFO")]
        messages = [entry for entry in messages if READ_BACK not in entry["message"]]
        assert not messages, messages
        _renew_window(driver)
    except BaseException:
        driver.quit()
        raise
    _idle[arguments].append(driver)


def started(browser: str, arguments: Sequence[str], *, phone: bool) -> Chrome:
    """Return a browser that is started with arguments, as a telephone if ``phone``."""
    options = ChromeOptions()
    options.binary_location = browser
    for argument in arguments:
        options.add_argument(argument)
    if phone:
        options.add_experimental_option("mobileEmulation", {"deviceMetrics": PHONE})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return Chrome(options=options, service=Service(shutil.which("chromedriver")))


def _renew_window(driver: Chrome) -> None:
    """Replace all windows by a new one, without scripts, media and messages of the former page."""
    former = driver.window_handles
    driver.switch_to.new_window("window")
    current = driver.current_window_handle
    for each in former:
        driver.switch_to.window(each)
        driver.close()
    driver.switch_to.window(current)
    driver.execute_cdp_cmd("Page.bringToFront", {})
    driver.get_log("browser")


def quit_browsers() -> None:
    """Quit the browsers that no test uses."""
    for drivers in _idle.values():
        while drivers:
            drivers.pop().quit()


def scroll_to_plot(driver: Chrome, frame: WebElement) -> WebElement:
    """Return the area of a figure's first plot, which is drawn once the figure is near to the screen."""
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", frame)
    return WebDriverWait(driver, PATIENCE, 0.05).until(lambda _: frame.find_elements(By.CSS_SELECTOR, ".area"))[0]


UNFOLD = """
const observer = new MutationObserver(() => {
  for (const folded of document.querySelectorAll("main details:not([open])")) folded.open = true;
});
observer.observe(document, { childList: true, subtree: true });
addEventListener("load", () => observer.disconnect());
"""
READY = "return document.documentElement.dataset.ready !== undefined"
