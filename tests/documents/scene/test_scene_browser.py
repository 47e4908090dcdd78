"""Scene of a run's page in a browser: software WebGL, control by pointer, keys and touch, message without WebGL.

Truth: the samples of the run in float32, and the visible and hidden content of pictures.
"""

import io
import re

import numpy as np
import pytest
from matplotlib import image
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from perilune.common.paths import BUILD
from tests.support.documents.run_page import write_run_report
from tests.support.pages.driven import driven
from tests.support.scenes.descent import descent
from tests.support.scenes.embedded import require_bundle
from tests.support.scenes.stills import arrow_tips

ROWS = 101
AXE = BUILD / "web" / "node_modules" / "axe-core" / "axe.min.js"
HOSTILE = "</script><b>\u202e__proto__'\""


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    require_bundle("scene")
    path = tmp_path_factory.mktemp("scene") / "page.html"
    result, declared = descent(rows=ROWS)
    write_run_report(result, path, "A landing", [declared])
    return path


@pytest.fixture(scope="module")
def desktop(browser, page):
    """Open one browser for mouse and keys."""
    with driven(browser, page) as driver:
        yield SceneView(driver)


@pytest.fixture
def scene(desktop):
    """Return the scene as it is at first."""
    desktop.press("Follow")
    desktop.press("reset the view")
    desktop.slider.send_keys(Keys.HOME)
    return desktop


class SceneView:
    """The scene of a driven page, scrolled to and drawn."""

    def __init__(self, driver):
        self.driver = driver
        scroll = "document.querySelector('[data-scene]').scrollIntoView({block: 'center'})"
        driver.execute_script(scroll)
        WebDriverWait(driver, 30).until(lambda each: each.find_elements(By.CSS_SELECTOR, "[data-drawn]"))
        driver.execute_script(scroll)
        self.stage = driver.find_element(By.CSS_SELECTOR, ".scene-view")
        self.slider = driver.find_element(By.CSS_SELECTOR, ".scene-controls input")

    @property
    def pictures(self):
        return int(self.driver.find_element(By.CSS_SELECTOR, "[data-drawn]").get_attribute("data-drawn"))

    def picture(self):
        """Return pixels once nothing is drawn any more."""
        self.driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")
        return image.imread(io.BytesIO(self.stage.screenshot_as_png))

    @property
    def values(self):
        """Time, height, thrust."""
        return [each.text for each in self.stage.find_elements(By.CSS_SELECTOR, ".scene-values dd")]

    @property
    def time(self):
        return self.values[0]

    def press(self, label):
        for button in self.driver.find_elements(By.CSS_SELECTOR, ".scene-controls button"):
            if label in (button.text, button.get_attribute("aria-label")):
                button.click()
                return
        raise AssertionError(label)


def differ(first, second):
    """Return True if more than 0.1 % of the pixels differ."""
    return np.mean(np.any(np.abs(first - second) > 0.02, axis=-1)) > 1e-3


def test_a_picture_changes_with_time_and_only_then(scene):
    first = scene.picture()
    assert np.ptp(first[..., :3], axis=(0, 1)).min() > 0.3
    before = scene.pictures
    assert not differ(first, scene.picture())
    assert scene.pictures == before  # nothing was drawn again
    assert scene.values == ["0 s", "50 m", "400"]
    scene.slider.send_keys(Keys.END)
    assert differ(first, scene.picture())
    assert scene.values == ["50 s", "0.005 m", "0"]  # 100 m aside, the sphere of 1000 km is 5 mm lower
    scene.slider.send_keys(Keys.HOME)
    assert not differ(first, scene.picture())


def test_script_and_picture_project_alike(scene, page):
    """The end of the arrow and the horizon of its name, over the height of either form, from its middle."""
    scene.picture()
    (name,) = scene.stage.find_elements(By.CSS_SELECTOR, ".scene-arrow")
    right, down = map(float, re.findall(r"-?[\d.]+(?=px)", name.get_attribute("style")))
    width, height = scene.driver.execute_script(
        "return [arguments[0].clientWidth, arguments[0].clientHeight]", scene.stage
    )
    still = arrow_tips(page.read_text(encoding="utf-8"))[0]
    assert ((right - width / 2) / height, (down - height / 2) / height) == pytest.approx(still, abs=2e-3)


def test_keys_reach_every_sample_and_all_scripts_have_its_time(scene):
    times = descent(rows=ROWS)[0].time
    scene.driver.execute_script(
        "window.times = []; document.addEventListener('perilune-time', ({detail}) => times.push(detail))"
    )
    scene.slider.send_keys(*[Keys.ARROW_RIGHT] * 7, Keys.ARROW_LEFT)
    scene.press("+1 sample")
    scene.picture()
    heard = scene.driver.execute_script("return times")
    assert {each["from"] for each in heard} == {"scene"}
    assert [each["time"] for each in heard] == [float(times[row]) for row in (1, 2, 3, 4, 5, 6, 7, 6, 7)]
    assert scene.time == "3.5 s"
    announce = "document.dispatchEvent(new CustomEvent('perilune-time', {detail: {time: 12.25, from: 'curves'}}))"
    scene.driver.execute_script(announce)
    scene.picture()
    assert scene.time == "12.25 s"  # between two samples
    assert len(scene.driver.execute_script("return times")) == len(heard) + 1  # it does not answer


def test_the_camera_moves_by_keys_buttons_and_pointer_and_comes_back(scene):
    first = scene.picture()
    scene.stage.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_UP, "+")
    assert differ(first, scene.picture())
    scene.stage.send_keys("0")
    assert not differ(first, scene.picture())
    ActionChains(scene.driver).drag_and_drop_by_offset(scene.stage, 120, 40).perform()
    assert differ(first, scene.picture())
    for mode in ("Chase", "Free", "Follow"):
        before = scene.picture()
        scene.press(mode)
        assert differ(before, scene.picture())
    assert not differ(first, scene.picture())


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_no_serious_fault(scene, scheme):
    if not AXE.is_file():
        pytest.skip("no axe-core")
    scene.driver.execute_script("document.documentElement.style.colorScheme = arguments[0]", scheme)
    scene.driver.execute_script(AXE.read_text(encoding="utf-8"))
    run = "axe.run(document.querySelector('[data-scene]')).then(arguments[0])"
    violations = scene.driver.execute_async_script(run)["violations"]
    scene.driver.execute_script("document.documentElement.style.colorScheme = ''")
    assert [each["help"] for each in violations if each["impact"] in ("serious", "critical")] == []


def test_it_plays_to_the_end(scene):
    scene.driver.execute_script(
        "const speed = document.querySelector('.scene-time select');"
        "speed.value = speed.lastElementChild.value; speed.dispatchEvent(new Event('change'))"
    )
    scene.press("Play")
    WebDriverWait(scene.driver, 30).until(lambda _: scene.time == "50 s")
    scene.picture()
    before = scene.pictures
    scene.picture()
    assert scene.pictures == before
    assert scene.driver.find_element(By.CSS_SELECTOR, ".scene-time button").text == "Play"


def test_a_phone_reaches_every_control_by_touch(browser, page):
    with driven(browser, page, phone=True) as driver:
        scene = SceneView(driver)
        controls = driver.find_elements(By.CSS_SELECTOR, ".scene-controls :is(button, select, input)")
        assert len(controls) >= 12
        for control in controls:
            assert control.size["height"] >= 40
            assert control.size["width"] >= 40
            assert 0 <= control.location["x"] <= 390 - control.size["width"]
        assert driver.execute_script("return document.documentElement.scrollWidth") == 390
        first = scene.picture()
        bounds = driver.execute_script(
            "const b = arguments[0].getBoundingClientRect(); return [b.x, b.y, b.width, b.height]", scene.stage
        )
        for kind, right in (("touchStart", 0.3), ("touchMove", 0.5), ("touchMove", 0.7), ("touchEnd", None)):
            at = [] if right is None else [{"x": bounds[0] + right * bounds[2], "y": bounds[1] + 0.5 * bounds[3]}]
            driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": at})
        assert differ(first, scene.picture())
        scrolled = driver.execute_script("return scrollY")
        for kind, down in (("touchStart", 0.8), *(("touchMove", 0.7 - 0.1 * k) for k in range(6)), ("touchEnd", None)):
            at = [] if down is None else [{"x": bounds[0] + 100, "y": bounds[1] + down * bounds[3]}]
            driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": at})
        WebDriverWait(driver, 10).until(lambda each: each.execute_script("return scrollY") > scrolled)


def test_without_webgl_there_are_figures_and_one_sentence(browser, page):
    with driven(browser, page, flags=["--disable-3d-apis"]) as driver:
        driver.execute_script("document.querySelector('[data-scene]').scrollIntoView()")
        holder = driver.find_element(By.CSS_SELECTOR, "[data-scene]")
        WebDriverWait(driver, 30).until(lambda _: "has no WebGL" in holder.text)
        assert len(holder.find_elements(By.CSS_SELECTOR, ".still-scene")) == 2
        assert all(each.is_displayed() for each in holder.find_elements(By.CSS_SELECTOR, ".still-scene"))
        assert not holder.find_elements(By.CSS_SELECTOR, "canvas")
        assert driver.find_elements(By.CSS_SELECTOR, ".live")


@pytest.mark.slow
def test_a_lost_context_is_said_and_comes_back(browser, page):
    with driven(browser, page) as driver:
        scene = SceneView(driver)
        lose = "window.gl = arguments[0].getContext('webgl2').getExtension('WEBGL_lose_context'); gl.loseContext()"
        driver.execute_script(lose, scene.stage.find_element(By.TAG_NAME, "canvas"))
        holder = driver.find_element(By.CSS_SELECTOR, "[data-scene]")
        WebDriverWait(driver, 30).until(lambda _: "has lost" in holder.text)
        driver.execute_script("gl.restoreContext()")
        WebDriverWait(driver, 30).until(lambda _: "has lost" not in holder.text)
        assert np.ptp(scene.picture()[..., :3]) > 0.3
        driver.get_log("browser")  # three.js reports the loss there


@pytest.mark.slow
def test_names_are_text_in_the_view(browser, tmp_path):
    require_bundle("scene")
    result, declared = descent(HOSTILE, rows=2)
    write_run_report(result, tmp_path / "page.html", HOSTILE, [declared])
    with driven(browser, tmp_path / "page.html") as driver:
        scene = SceneView(driver)
        scene.press("Free")
        scene.picture()
        names = [each.get_attribute("textContent") for each in driver.find_elements(By.CSS_SELECTOR, ".scene-mark bdi")]
        assert names == [HOSTILE, f"{HOSTILE}'s site", f"{HOSTILE}'s wind"]
        assert not driver.find_elements(By.CSS_SELECTOR, "[data-scene] b")
