"""docs.figures.stopping_comparison: the tables of docs/theory/stopping.md.

Truth: simulated random outcomes of many campaigns of each kind; the page.
"""

import numpy as np
import pytest

from docs.figures.stopping_comparison import RATE, compute_statistics, main, rules
from perilune.common.paths import ROOT
from tests.support.lengths import either


@pytest.fixture(scope="module")
def compared():
    return rules()


@pytest.mark.parametrize("place", range(6))
@pytest.mark.parametrize("rate", [0.0005, RATE, 0.002])
def test_courses_are_those_of_campaigns_flown(compared, place, rate):
    rule, many = compared[place], either(100_000, 20_000)
    steps = np.diff([0, *rule.looks])
    failures = np.random.default_rng(place).binomial(steps, rate, (many, len(steps))).cumsum(axis=1)
    met, refused = failures <= np.array(rule.permitted), failures >= np.array(rule.refused)
    decided = met | refused
    end = np.where(decided.any(axis=1), decided.argmax(axis=1), len(steps) - 1)
    every = np.arange(many)
    actual = compute_statistics(rule, rate)
    assert met[every, end].mean() == pytest.approx(actual.met, abs=2.0 / np.sqrt(many))  # four deviations of a half
    assert refused[every, end].mean() == pytest.approx(actual.refused, abs=2.0 / np.sqrt(many))
    assert np.array(rule.looks)[end].mean() == pytest.approx(actual.flights, rel=6.0 / np.sqrt(many))


def test_the_page_has_what_is_printed(capsys):
    main()
    printed = capsys.readouterr().out
    page = (ROOT / "docs" / "theory" / "stopping.md").read_text(encoding="utf-8").replace("20 000", "20000")
    for line in printed.splitlines():
        assert line in page
