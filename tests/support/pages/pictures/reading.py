"""Figures of a page with and without scripts, in one browser: content of pictures, and of their replacements."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import hypot
from pathlib import Path
from typing import Any

from selenium.webdriver import Chrome
from selenium.webdriver.support.ui import WebDriverWait

from tests.support.pages.driven import FLAGS, PATIENCE, READ_BACK, READY, started
from tests.support.pages.scripts import require_scripts

SCRIPT = Path(__file__).with_name("reading.js").read_text(encoding="utf-8")
READ = "const done = arguments[0]; perilune_read().then(done, (error) => done(String(error.stack)));"
LONGEST = 500.0  # ms, of a task
TRIES = 3  # of loading a page, since others may have the processor
TEXT = 8.0  # px, by which a text may lie elsewhere
INK = 24  # px that may be inked in one of them alone


@dataclass(frozen=True)
class Comparison:
    """The figures of a page that are pictures, and those that answer, with what of each differs from its picture."""

    pictures: list[str]
    answering: list[str]
    marks: int
    differences: list[str]


@contextmanager
def reading(browser: str, *, phone: bool = False) -> Iterator[Chrome]:
    """Yield a browser that notes drawings of pages."""
    require_scripts()
    driver = started(browser, (*FLAGS, "--window-size=1400,1200"), phone=phone)
    driver.set_script_timeout(PATIENCE)
    driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": SCRIPT})
    try:
        yield driver
    finally:
        driver.quit()


def read_page(driver: Chrome, page: Path) -> Comparison:
    """Read the figures of a page; no console message, and no task longer than `LONGEST` in the best of `TRIES`."""
    for attempt in range(1, TRIES + 1):
        read = _read(driver, page)
        if read["longest"] <= LONGEST:
            break
        assert attempt < TRIES, f"{page}: a task of {read['longest']:.0f} ms"
    figures = read["figures"]
    answering = [each for each in figures if each["interactive"]]
    return Comparison(
        [each["name"] for each in figures if not each["interactive"]],
        [each["name"] for each in answering],
        sum(each["values"]["marks"] for each in answering),
        [f"{each['name']}: {difference}" for each in answering for difference in _differences(each)],
    )


def _read(driver: Chrome, page: Path) -> Any:
    driver.get(page.as_uri())
    WebDriverWait(driver, PATIENCE, 0.05).until(lambda each: each.execute_script(READY))
    read = driver.execute_async_script(READ)
    assert isinstance(read, dict), read
    messages = [entry for entry in driver.get_log("browser") if entry["level"] not in ("DEBUG", "INFO")]  # type: ignore[no-untyped-call]
    messages = [entry for entry in messages if READ_BACK not in entry["message"]]
    assert not messages, messages
    return read


def _differences(figure: Any) -> Iterator[str]:
    """Yield the differences of a figure from its picture: texts and their places, values at ten instants, ink."""
    stated, written = (Counter(text for text, *_ in figure[key]) for key in ("stated", "written"))
    if lost := sorted((stated - written).elements()):
        yield f"lost {lost}"
    if added := sorted((written - stated).elements()):
        yield f"added {added}"
    for text, x, y in figure["stated"]:
        away = min((hypot(x - u, y - v) for other, u, v in figure["written"] if other == text), default=0.0)
        if away > TEXT:
            yield f"{text!r} is {away:.0f} px away"
    if figure["hidden"]:
        yield f"hidden {figure['hidden']}"
    if figure["values"]["off"]:
        yield f"values beside the line: {figure['values']['off']}"
    for kind, ink in figure["different"].items():
        if ink["count"] > INK:
            yield f"{kind} ink, {ink['count']} px: {ink['first']}"
