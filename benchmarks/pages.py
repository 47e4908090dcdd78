"""Sizes and loading times of report pages: a run of landing_mission, and a batch of 3 x 10 000 trials.

    python -m benchmarks.pages [--trials N] [--swiftshader]

Prints the table of docs/reports.md: medians over newly opened pages in headless Chromium without a graphics processor,
where SwiftShader draws WebGL and the processor draws and composes the page; with ``--swiftshader`` SwiftShader also
composes it. Needs Chromium and its driver. Times of pictures include the frame in which they are drawn.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from selenium.webdriver import Chrome, ChromeOptions
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

from perilune.analysis.cli import main as perilune
from tests.support.pages.driven import COMPOSITING, FLAGS

OPENED = 3  # times that each page is opened
FRAMES = 40
SCENE = (1200, 800)  # px
# From the end of parsing on: when all figures are ready, and when the scene has its first picture.
WATCH = """
window.times = {};
const note = (name) => requestAnimationFrame(() => { window.times[name] ??= performance.now(); });
new MutationObserver(() => {
  if (document.documentElement?.dataset.ready) note("ready");
  if (document.querySelector("[data-drawn]")) note("drawn");
}).observe(document, { attributes: true, subtree: true, attributeFilter: ["data-ready", "data-drawn"] });
"""
SINCE = "return window.times[arguments[0]] - performance.getEntriesByType('navigation')[0].domInteractive"
# Mean time of a frame in which a statement is executed, including WebGL.
LOOP = """
const [frames, begin, done] = [arguments[0], performance.now(), arguments[1]];
const canvas = document.querySelector(".scene-view canvas");
let frame = 0;
const step = () => {
  if (frame++ < frames) { STATEMENT; requestAnimationFrame(step); return; }
  canvas?.getContext("webgl2").finish();
  done((performance.now() - begin) / frames);
};
requestAnimationFrame(step);
"""
KEY = "document.querySelector('SELECTOR').dispatchEvent(new KeyboardEvent('keydown', { key: KEYS, bubbles: true }))"
TURN = KEY.replace("SELECTOR", ".scene-view").replace("KEYS", "'ArrowLeft'")
CURSOR = KEY.replace("SELECTOR", "#measured").replace("KEYS", "'ArrowRight'")
ZOOM = KEY.replace("SELECTOR", "#measured").replace("KEYS", "frame % 2 ? '+' : '0'")
SIZE = "Object.assign(document.querySelector('.scene-view').style, { width: arguments[0], height: arguments[1] })"
# Scrolls to a figure over time; all such figures share cursor and zoom, a path has a separate zoom.
MEASURED = """
const pictures = [...document.querySelectorAll(".live > svg[aria-label$=' over time']")];
const frame = pictures.find((each) => each.getClientRects().length).parentElement;
frame.scrollIntoView();
frame.querySelector(".chart").id = "measured";
"""
# Draws all figures, which otherwise are drawn when they approach the screen.
ALL = """
const done = arguments[0];
const frames = [...document.querySelectorAll(".live")].filter((each) => each.clientHeight);
const next = () => {
  const frame = frames.shift();
  if (!frame) { scrollTo(0, 0); requestAnimationFrame(() => requestAnimationFrame(done)); return; }
  frame.scrollIntoView();
  requestAnimationFrame(() => requestAnimationFrame(next));
};
next();
"""
BRUSH = """
const area = document.querySelector("[data-figure]").closest(".live").querySelector(".chart > .area");
const { left, top, width, height } = area.getBoundingClientRect();
const send = (type, x, y) => area.dispatchEvent(new PointerEvent(type, { pointerId: 1, pointerType: "mouse", button: 0,
  bubbles: true, clientX: left + x * width, clientY: top + y * height }));
area.setPointerCapture = () => undefined;
const end = 0.3 + 0.6 * (frame / frames);
send("pointerdown", 0.1, 0.1);
send("pointermove", end, end);
send("pointerup", end, end);
"""


def main(trials: int, flags: Sequence[str]) -> None:
    """Write the pages, open them, print the table."""
    with tempfile.TemporaryDirectory() as scratch:
        run, batch = Path(scratch) / "run.html", Path(scratch) / "batch.html"
        perilune(["run", "landing_mission", "--report", str(run)])
        options = ["--campaign", "paper", "--trials", str(trials), "--output", str(Path(scratch) / "results")]
        perilune(["batch", "lunar_terminal_guidance", *options, "--report", str(batch)])
        opened = [_open(run, _of_run, flags) for _ in range(OPENED)]
        brushed = [_open(batch, _of_batch, flags) for _ in range(OPENED)]
        sizes = [path.stat().st_size / 1e6 for path in (run, batch)]
    rows = [
        ("page of a run of landing_mission, MB", f"{sizes[0]:.2f}", "5"),
        (f"page of a batch of 3 x {trials} trials, MB", f"{sizes[1]:.2f}", "8"),
        *(_row(name, goal, opened) for name, goal in GOALS_OF_RUN.items()),
        *(_row(name, goal, brushed) for name, goal in GOALS_OF_BATCH.items()),
    ]
    print("\n| | median, greatest | goal |\n| --- | --- | --- |")
    for row in rows:
        print("| " + " | ".join(row) + " |")


GOALS_OF_RUN = {
    "run: all figures answer, s after the page is parsed": "1.0",
    "run: first picture of the scene, s after the page is parsed": "1.0",
    "run: cursor by one row, ms": "",
    "run: zoom of all figures over time near the screen, ms": "50",
    f"run: picture of the scene, {SCENE[0]} x {SCENE[1]}, ms": "50",
}
GOALS_OF_BATCH = {"batch: all figures answer, s after the page is parsed": "1.0", "batch: brush, ms": "100"}


def _row(name: str, goal: str, opened: list[dict[str, float]]) -> tuple[str, str, str]:
    measured = [each[name] for each in opened]
    return name, f"{statistics.median(measured):.3g}, {max(measured):.3g}", goal


def _open(page: Path, measure: Callable[[Any], list[float]], flags: Sequence[str]) -> dict[str, float]:
    options = ChromeOptions()
    for flag in (*flags, "--window-size=1400,1300"):
        options.add_argument(flag)
    driver = Chrome(options=options, service=Service(shutil.which("chromedriver")))
    try:
        driver.set_script_timeout(120)
        driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": WATCH})
        driver.get(page.as_uri())
        goals = GOALS_OF_RUN if measure is _of_run else GOALS_OF_BATCH
        return dict(zip(goals, measure(driver), strict=True))
    finally:
        driver.quit()


def _of_run(driver: Any) -> list[float]:
    since = [_since(driver, name) for name in ("ready", "drawn")]
    driver.execute_script(SIZE, *(f"{length}px" for length in SCENE))
    picture = _frame(driver, TURN)
    driver.execute_async_script(ALL)
    driver.execute_script(MEASURED)
    return [*since, _frame(driver, CURSOR), _frame(driver, ZOOM), picture]


def _of_batch(driver: Any) -> list[float]:
    since = _since(driver, "ready")
    driver.execute_async_script(ALL)
    driver.execute_script("document.querySelector('.live').scrollIntoView()")
    return [since, _frame(driver, BRUSH)]


def _since(driver: Any, name: str) -> float:
    WebDriverWait(driver, 120, 0.02).until(lambda each: each.execute_script("return arguments[0] in times", name))
    return float(driver.execute_script(SINCE, name)) / 1000


def _frame(driver: Any, statement: str) -> float:
    return float(driver.execute_async_script(LOOP.replace("STATEMENT", statement), FRAMES))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=10_000, metavar="N")
    parser.add_argument("--swiftshader", action="store_true")
    options = parser.parse_args()
    main(options.trials, [flag for flag in FLAGS if not (options.swiftshader and flag == COMPOSITING)])
