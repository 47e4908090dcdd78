"""First screen of pages and navigation from there: contents, search, keys, with and without scripts.

Truth: the layout of a browser, and the words of the page.
"""

import re

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from tests.support.lengths import either
from tests.support.pages.browser import start
from tests.support.pages.checks import parse
from tests.support.pages.driven import driven
from tests.support.pages.written import write_comparison_page

pytestmark = pytest.mark.usefixtures("fmus")

HIGHEST_RUN, HIGHEST_COMPARISON = 6000, 10_000  # px, at a width of 1400
HEIGHT = "return document.documentElement.scrollHeight"
VISIBLE = """
return [...document.querySelectorAll("main figure")].filter((each) => each.getClientRects().length)
  .map((each) => each.querySelector("svg")?.getAttribute("aria-label"))
  .filter((name) => !name?.startsWith("Landing at"));
"""  # without the picture of the scene, which is there until the scene is drawn


@pytest.fixture(scope="module")
def six_variants(recorded, tmp_path_factory):
    page = tmp_path_factory.mktemp("six") / "page.html"
    write_comparison_page([recorded / "out"], page)
    return page


def test_a_mission_is_short_and_its_limits_come_first(browser, flight):
    with driven(browser, flight / "page.html") as driver:
        assert driver.execute_script(HEIGHT) < HIGHEST_RUN
        bottom = driver.execute_script(
            "return document.querySelector('header .verdict').getBoundingClientRect().bottom"
        )
        assert bottom < driver.execute_script("return innerHeight") / 2


@pytest.mark.slow
def test_a_comparison_of_six_variants_is_short(browser, six_variants):
    with driven(browser, six_variants) as driver:
        assert driver.execute_script(HEIGHT) < HIGHEST_COMPARISON
        rows = driver.find_elements(By.CSS_SELECTOR, "header .verdicts tbody tr")
        assert len(rows) == 6
        assert all(row.rect["y"] + row.rect["height"] < 600 for row in rows)


@pytest.mark.parametrize("made", either(["flight", "recorded"], ["flight"]))
def test_contents_lead_to_every_section(browser, request, made):
    path = request.getfixturevalue(made) / "page.html"
    page = parse(path.read_text(encoding="utf-8"))
    links = page.xpath("//nav//a")
    assert [link.text_content() for link in links] == [heading.text_content() for heading in page.xpath("//main//h2")]
    with driven(browser, path) as driver:
        column, main = (driver.find_element(By.CSS_SELECTOR, each).rect for each in (".contents", "main"))
        assert column["x"] + column["width"] < main["x"]
        for name in (link.get("href") for link in links):
            link = driver.find_element(By.CSS_SELECTOR, f'nav a[href="{name}"]')
            assert driver.execute_script("return arguments[0].checkVisibility()", link)
            driver.execute_script("arguments[0].click()", link)
            WebDriverWait(driver, 10).until(
                lambda _, name=name: driver.find_element(By.CSS_SELECTOR, name).is_displayed()
            )
        canvases = "return [...document.querySelectorAll('.live')].filter((each) => !each.clientHeight).length"
        assert driver.execute_script(canvases) == 0


def test_a_link_opens_what_it_leads_to_without_scripts(browser, flight, tmp_path):
    page = tmp_path / "page.html"
    text = (flight / "page.html").read_text(encoding="utf-8")
    page.write_text(re.sub(r"<script.*?</script>", "", text, flags=re.DOTALL), encoding="utf-8")
    for fragment, count in (("", 0), ("#section-provenance", 1)):
        dom = start(browser, page, tmp_path, "--dump-dom", fragment=fragment)
        assert len(re.findall(r'<details class="fold" open', dom)) == count


def test_the_search_shows_figures_of_a_name_alone(browser, flight):
    with driven(browser, flight / "page.html") as driver:
        before = driver.execute_script(VISIBLE), driver.execute_script(HEIGHT)
        search = driver.find_element(By.CSS_SELECTOR, ".search input")
        search.send_keys("plant tilt")
        count = driver.find_element(By.CSS_SELECTOR, ".search output")
        WebDriverWait(driver, 10).until(lambda _: count.text)
        names = driver.execute_script(VISIBLE)
        assert names == ["Tilt of the thrust axis: plant.tilt over time", "plant.tilt over time"]
        assert count.text.startswith("2 figures, ")
        rows = driver.find_elements(By.CSS_SELECTOR, ".signals tbody tr")
        assert "plant.tilt" in [row.text.split(" ")[0] for row in rows if row.is_displayed()]
        assert all("plant.tilt" in row.text for row in rows if row.is_displayed())
        search.send_keys(Keys.BACKSPACE * 10)
        WebDriverWait(driver, 10).until(lambda _: not count.text)
        assert driver.execute_script(VISIBLE) == before[0]


def test_keys_skip_the_contents(browser, flight):
    with driven(browser, flight / "page.html") as driver:
        ActionChains(driver).send_keys(Keys.TAB).perform()
        assert driver.switch_to.active_element.text == "Skip the contents"
        ActionChains(driver).send_keys(Keys.ENTER, Keys.TAB).perform()
        assert driver.execute_script("return document.activeElement.closest('main') !== null")


def test_contents_are_folded_on_a_telephone(browser, flight):
    with driven(browser, flight / "page.html", phone=True) as driver:
        assert not driver.find_element(By.CSS_SELECTOR, "nav a").is_displayed()
        driver.find_element(By.CSS_SELECTOR, "nav summary").click()
        assert driver.find_element(By.CSS_SELECTOR, "nav a").is_displayed()
