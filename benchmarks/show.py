"""`perilune show` for a campaign too large for a page: 10^6 trials of 40 metrics in 200 shards.

    python -m benchmarks.show [TRIALS]

Prints the times from the start of the command to the first figure and to all figures, the time from a brush to the new
picture, and the server's memory. Counts on the page are compared with counts by pyarrow. Needs Chromium and its driver.
"""

from __future__ import annotations

import json
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil
import pyarrow.compute
import pyarrow.dataset
from selenium.webdriver import Chrome, ChromeOptions
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from tests.support.campaigns.many_metrics import write_many
from tests.support.pages.driven import FLAGS

SHARDS = 200
BRUSHES = 9
COMMAND = "from perilune.analysis.cli import run; run()"
# Reports the time from the release of the pointer to the frame with the new counts.
TIMER = """
const done = arguments[arguments.length - 1];
const before = document.querySelector(".summary tbody").textContent;
window.brushed = null;
addEventListener("pointerup", () => {
  const begin = performance.now();
  const look = () => {
    if (document.querySelector(".summary tbody").textContent === before) requestAnimationFrame(look);
    else requestAnimationFrame(() => { window.brushed = performance.now() - begin; });
  };
  look();
}, { once: true, capture: true });
done();
"""


def main(trials: int) -> None:
    """Write the campaign, serve it, measure, print a table."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "results"
        write_many(folder, trials, max(1, trials // SHARDS))
        options = ChromeOptions()
        for flag in (*FLAGS, "--window-size=1400,1200"):
            options.add_argument(flag)
        driver = Chrome(options=options, service=Service(shutil.which("chromedriver")))
        begin = time.perf_counter()
        command = [sys.executable, "-c", COMMAND, "show", str(folder)]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        try:
            rows = _measure(driver, process, folder, begin)
        finally:
            interrupted = time.perf_counter()
            process.send_signal(signal.SIGINT)
            process.wait()
            ended = time.perf_counter() - interrupted
            driver.quit()
        rows.append(["end, s after Ctrl-C with the page open", f"{ended:.2f}", "2"])
    print(f"{trials} trials, 40 metrics, {SHARDS} shards\n\n| | measured | goal |\n| --- | --- | --- |")
    for row in rows:
        print("| " + " | ".join(row) + " |")


def _measure(driver: Any, process: subprocess.Popen[str], folder: Path, begin: float) -> list[list[str]]:
    assert process.stdout is not None
    address = process.stdout.readline().split()[1]
    listening = time.perf_counter() - begin
    driver.get(address)
    first = _until(driver, begin, "return document.documentElement.dataset.first !== undefined")
    complete = _until(driver, begin, "return document.documentElement.dataset.ready !== undefined")
    canvas = driver.find_elements(By.CSS_SELECTOR, ".counted canvas")
    brushes = [_brush(driver, canvas[number % 3], 20 + 4 * number) for number in range(BRUSHES)]
    memory = psutil.Process(process.pid).memory_info()
    greatest = json.loads(Path(f"/proc/{process.pid}/status").read_text().split("VmHWM:")[1].split()[0]) / 1024
    counted = _selected(driver)
    assert counted == _by_pyarrow(folder, driver), counted
    return [
        ["listening, s after the command", f"{listening:.2f}", ""],
        ["first figure, s after the command", f"{first:.2f}", "3"],
        ["all figures and the table, s", f"{complete:.2f}", ""],
        ["brush to picture, s: median, greatest", f"{statistics.median(brushes):.3f}, {max(brushes):.3f}", "0.3"],
        ["memory of the server, MB: now, greatest", f"{memory.rss / 2**20:.0f}, {greatest:.0f}", "1000"],
    ]


def _until(driver: Any, begin: float, script: str) -> float:
    WebDriverWait(driver, 120, 0.02).until(lambda each: each.execute_script(script))
    return time.perf_counter() - begin


def _brush(driver: Any, canvas: Any, by: int) -> float:
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas)
    driver.execute_async_script(TIMER)
    ActionChains(driver).move_to_element_with_offset(canvas, -by, 0).click_and_hold().move_by_offset(
        2 * by, 0
    ).release().perform()
    WebDriverWait(driver, 30, 0.02).until(lambda each: each.execute_script("return window.brushed !== null"))
    return float(driver.execute_script("return window.brushed")) / 1000


def _selected(driver: Any) -> list[int]:
    """Return the numbers of successes and failures on the page."""
    texts = [each.text for each in driver.find_elements(By.CSS_SELECTOR, ".summary tbody td.n")]
    return [int(text) for text in texts[1:3]]


def _by_pyarrow(folder: Path, driver: Any) -> list[int]:
    """Return the numbers of successes and failures for the ranges of the page's last request, by pyarrow."""
    entries = "performance.getEntriesByType('resource').map(each => each.name)"
    script = f"return {entries}.filter(each => each.includes('/counts'))"
    last = driver.execute_script(script)[-1]
    answer = driver.execute_async_script("fetch(arguments[0]).then(each => each.json()).then(arguments[1])", last)
    ranged = driver.execute_script(
        "return JSON.parse(new URL(arguments[0]).searchParams.get('query')).ranges.map(each => each.column)", last
    )
    table = pyarrow.dataset.dataset(folder / "trials").to_table([*(f"metric.m{each}" for each in ranged), "success"])
    field: Callable[[str], pyarrow.compute.Expression] = pyarrow.compute.field
    where = pyarrow.compute.scalar(True)
    for column, ends in zip(ranged, answer["ranges"], strict=True):
        where &= (field(f"metric.m{column}") >= ends["low"]) & (field(f"metric.m{column}") < ends["high"])
    successes = table.filter(where)["success"]
    count = pyarrow.compute.sum(successes).as_py() or 0
    return [count, len(successes) - count]


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
