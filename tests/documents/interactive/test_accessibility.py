"""Pages of a run and a batch have no serious accessibility violation, in light and dark mode.

Truth: axe-core's rules.
"""

import pytest

from perilune.common.paths import BUILD
from tests.support.lengths import either
from tests.support.pages.driven import driven

AXE = BUILD / "web" / "node_modules" / "axe-core" / "axe.min.js"
RUN = "axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => arguments[0](violations))"

pytestmark = pytest.mark.usefixtures("fmus")


@pytest.mark.parametrize("made", either(["flight", "batch"], ["batch"]))
def test_axe_finds_no_serious_fault(browser, made, request):
    if not AXE.is_file():
        pytest.skip("no axe-core")
    with driven(browser, request.getfixturevalue(made) / "page.html", unfolded=True) as driver:
        driver.execute_script(AXE.read_text(encoding="utf-8"))
        driver.set_script_timeout(120)
        for scheme in ("light", "dark"):
            media = {"features": [{"name": "prefers-color-scheme", "value": scheme}]}
            driver.execute_cdp_cmd("Emulation.setEmulatedMedia", media)
            violations = driver.execute_async_script(RUN)
            serious = [each for each in violations if each["impact"] in ("serious", "critical")]
            assert not [(each["help"], each["nodes"][0]["html"]) for each in serious], scheme
