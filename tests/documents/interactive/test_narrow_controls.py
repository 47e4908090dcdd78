"""On a phone every control of a page is within the screen and large enough for a finger.

Truth: the layout of the browser; at least 40 px.
"""

import pytest

from tests.support.lengths import either
from tests.support.pages.driven import driven

pytestmark = pytest.mark.usefixtures("fmus")

WIDTH = 390  # px
# Controls that are laid out, with everything unfolded: name, height, ends.
CONTROLS = """
for (const folded of document.querySelectorAll("details")) folded.open = true;
return [...document.querySelectorAll("button, select, input, summary, [role=button]")]
  .filter((each) => each.getClientRects().length)
  .map((each) => {
    const { height, left, right } = each.getBoundingClientRect();
    return [`${each.tagName} ${each.textContent.slice(0, 30)}`, height, left, right];
  });
"""


@pytest.mark.parametrize("made", either(["flight", "batch", "recorded"], ["recorded"]))
def test_controls_fit_a_finger_and_the_screen(browser, made, request):
    with driven(browser, request.getfixturevalue(made) / "page.html", phone=True) as driver:
        controls = driver.execute_script(CONTROLS)
        assert len(controls) > 10
        for name, height, left, right in controls:
            assert height >= 40.0 - 0.01, name
            assert left >= 0.0, name
            assert right <= WIDTH + 0.01, name
        assert driver.execute_script("return document.documentElement.scrollWidth") == WIDTH
