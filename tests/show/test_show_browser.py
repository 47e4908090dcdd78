"""Page of `perilune show`: figures, brushes by pointer, keys and touch, trials and their commands, hostile names.

Truth: pyarrow's counts of the folder in the ranges stated on the page.
"""

from __future__ import annotations

import json

import pyarrow.compute
import pyarrow.dataset
import pytest
from pyarrow.compute import field
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from tests.support.campaigns.many_metrics import write_many
from tests.support.campaigns.showing import showing
from tests.support.pages.driven import driven

HOSTILE = "</script><script>window.hacked=1</script><img src=x onerror='window.hacked=2'>\u2028\u202e\"__proto__"
TOUCH = """
const [canvas, from, to] = arguments;
const { left, top, width, height } = canvas.getBoundingClientRect();
const send = (type, x) => canvas.dispatchEvent(new PointerEvent(type, {
  pointerId: 1, pointerType: "touch", isPrimary: true, button: 0, bubbles: true,
  clientX: left + x * width, clientY: top + height / 2,
}));
canvas.setPointerCapture = () => undefined;
send("pointerdown", from); send("pointermove", to); send("pointerup", to);
"""
SIZES = """
return [...document.querySelectorAll("#show button, #show select, #show label")]
  .filter((each) => each.getClientRects().length)
  .map((each) => {
    const { left, right, height } = each.getBoundingClientRect();
    return [each.textContent.slice(0, 30), left, right, height];
  });
"""
WRITTEN = """
const write = CanvasRenderingContext2D.prototype.fillText;
window.written = [];
CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
  const wide = this.measureText(text).width, start = { center: wide / 2, right: wide }[this.textAlign] ?? 0;
  window.written.push([text, x - start, x - start + wide, this.canvas.clientWidth]);
  write.call(this, text, x, y);
};
"""
SELECTED = """
return [...document.querySelectorAll(".summary tbody tr")].map((row) =>
  [...row.querySelectorAll("td.n")].slice(0, 3).map((each) => Number(each.textContent)));
"""
RANGES = """
return [...document.querySelectorAll(".ranges li:not(.note)")].map((each) =>
  [each.firstChild.textContent.trim(), ...[...each.querySelectorAll("data")].map(({ value }) => Number(value))]);
"""


@pytest.fixture(scope="module")
def table(campaign_folder):
    return pyarrow.dataset.dataset(campaign_folder / "trials").to_table()


def canvases(driver):
    return driver.find_elements(By.CSS_SELECTOR, ".counted canvas")


def selected(driver):
    """Return selected, successes and failures of each variant."""
    return driver.execute_script(SELECTED)


def ranges(driver):
    """Return exact ends of ranges, by name."""
    return {name.split()[0]: (low, high) for name, low, high in driver.execute_script(RANGES)}


def wait_for_change(driver, before):
    WebDriverWait(driver, 30).until(lambda each: selected(each) != before)


def expected(table, driver):
    where = pyarrow.compute.scalar(True)
    for name, (low, high) in ranges(driver).items():
        column = f"metric.{name}" if name.startswith("m") else f"draw.{name}"
        where = where & (field(column) >= low) & (field(column) < high)
    rows = table.filter(where)
    counts = []
    for variant in ("alpha", "beta", "gamma"):
        success = rows.filter(field("variant") == variant)["success"].to_pylist()
        counts.append([len(success), sum(success), len(success) - sum(success)])
    return counts


def assert_counted(driver, table):
    assert selected(driver) == expected(table, driver)


def test_a_campaign_is_explored(browser, campaign_folder, table):
    with showing([campaign_folder]) as (address, _), driven(browser, address) as driver:
        assert "token" not in driver.current_url
        assert len(canvases(driver)) == 7
        whole = selected(driver)
        assert whole == expected(table, driver)
        canvas = canvases(driver)[0]
        ActionChains(driver).move_to_element_with_offset(canvas, -40, 0).click_and_hold().move_by_offset(
            70, 0
        ).release().perform()
        wait_for_change(driver, whole)
        assert list(ranges(driver)) == ["m0"]
        assert_counted(driver, table)
        brushed = selected(driver)
        canvases(driver)[2].send_keys(Keys.ARROW_LEFT)  # by keys: the last ten bars of whole numbers
        keys = ActionChains(driver).key_down(Keys.SHIFT)
        for _ in range(9):
            keys.send_keys(Keys.ARROW_LEFT)
        keys.key_up(Keys.SHIFT).perform()
        wait_for_change(driver, brushed)
        WebDriverWait(driver, 30).until(lambda each: list(ranges(each)) == ["m0", "m2"])
        ActionChains(driver).pause(0.6).perform()
        assert_counted(driver, table)
        both = selected(driver)
        ActionChains(driver).send_keys(Keys.ESCAPE).perform()
        wait_for_change(driver, both)
        assert selected(driver) == brushed
        ActionChains(driver).pause(0.6).perform()  # after which the table follows
        first = driver.find_element(By.CSS_SELECTOR, ".trials td button")
        number = first.text
        first.click()
        card = driver.find_element(By.CSS_SELECTOR, ".card")
        WebDriverWait(driver, 30).until(lambda _: card.is_displayed())
        assert (
            card.find_element(By.TAG_NAME, "code").text
            == f"perilune replay {campaign_folder} {number} --configuration alpha"
        )
        reset = next(each for each in driver.find_elements(By.TAG_NAME, "button") if each.text == "Select all trials")
        driver.execute_script("arguments[0].click()", reset)
        WebDriverWait(driver, 30).until(lambda each: selected(each) == whole)


@pytest.mark.slow
def test_ticks_stand_whole_on_their_canvas(browser, campaign_folder):
    """As a canvas is asked to write them when it is drawn for another choice of variants."""
    with showing([campaign_folder]) as (address, _), driven(browser, address) as driver:
        driver.execute_script(WRITTEN)
        whole = selected(driver)
        driver.execute_script("document.querySelector('.summary input').click()")
        wait_for_change(driver, whole)
        written = driver.execute_script("return window.written")
        assert len(written) > 20
        assert all(left >= 0.0 and right <= width for _, left, right, width in written), written


def test_on_a_telephone(browser, campaign_folder, table):
    with showing([campaign_folder]) as (address, _), driven(browser, address, phone=True) as driver:
        whole = selected(driver)
        driver.execute_script(TOUCH, canvases(driver)[1], 0.3, 0.7)
        wait_for_change(driver, whole)
        assert list(ranges(driver)) == ["m1"]
        assert driver.execute_script("return document.documentElement.scrollWidth") == 390
        for text, left, right, height in driver.execute_script(SIZES):
            assert left >= 0, text
            assert right <= 390, text
            assert height >= 40, text


def test_hostile_names_are_text(browser, tmp_path):
    folder = tmp_path / "results\"'<b>"
    folder.mkdir()
    write_many(folder, 60, 30, metrics=3)
    path = folder / "summary.json"
    document = json.loads(path.read_text())
    document["description"] = document["success"] = HOSTILE
    for metric in document["metrics"].values():
        metric["unit"] = metric["description"] = HOSTILE
    rewrite(folder, document)
    with showing([folder]) as (address, _), driven(browser, address) as driver:
        assert driver.find_element(By.CLASS_NAME, "lead").text == HOSTILE.replace("\u2028", " ").strip()
        assert driver.execute_script(
            "return [window.hacked, document.querySelectorAll('main img, main b').length]"
        ) == [None, 0]


def rewrite(folder, document):
    """Rewrite the folder with another summary, which its shards are of."""
    import pyarrow.parquet

    from perilune.analysis.campaigns.folder.provenance import batch_digest
    from perilune.analysis.campaigns.folder.summary_file import without_summary

    (folder / "summary.json").write_text(json.dumps(document))
    digest = batch_digest(without_summary(document))
    for path in (folder / "trials").iterdir():
        table = pyarrow.parquet.read_table(path)
        about = json.loads(table.schema.metadata[b"perilune"]) | {"batch": digest}
        pyarrow.parquet.write_table(table.replace_schema_metadata({"perilune": json.dumps(about)}), path)
