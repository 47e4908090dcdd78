"""Table of braking laws in docs/systems/landing_mission.md equals the result of the command above it.

Truth: the campaign, with means by numpy. `make test` simulates four trials of one law, `make long` the table.
"""

import re

import numpy as np
import pytest

import perilune
from perilune.common.paths import ROOT
from tests.support.lengths import LONG

PAGE = (ROOT / "docs" / "systems" / "landing_mission.md").read_text(encoding="utf-8")
COMMAND = "perilune batch landing_mission --campaign laws --trials 20"
ROW = re.compile(r"\| `(\w+)` \| (\d+) of 20 \| ([\d.]+), ([\d.]+) \| ([\d.]+), ([\d.]+) \| (\d+) \|")
ROWS = {law: numbers for law, *numbers in ROW.findall(PAGE)}


def fly(law, trials):
    (actual,) = perilune.batch("landing_mission", "laws", trials=trials, compare={"guidance": [law]}).trials.values()
    return actual, np.arange(trials) % 2 == 1


def numbers_of(law):
    actual, diverted = fly(law, 20)
    yield int(actual.success.sum())
    for metric in ("propellant", "distance"):
        for group in (~diverted, diverted):
            yield np.mean(actual.metrics[metric][group])
    yield int(np.sum(actual.metrics["redesignation_dropped"]))


def test_the_command_stands_above_six_laws():
    assert COMMAND in PAGE
    assert len(ROWS) == 6


@pytest.mark.skipif(not LONG, reason="120 landings")
@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("law", ROWS)
def test_a_row_is_what_the_command_gives(law):
    for stated, value in zip(ROWS[law], numbers_of(law), strict=True):
        assert float(stated) == pytest.approx(value, abs=0.501 * 10.0 ** -len(stated.partition(".")[2])), law


@pytest.mark.usefixtures("fmus")
def test_a_divert_of_the_braking_moves_the_site():
    """300 m at 150 s; the site of the landing is that of the divert and both re-designations."""
    actual, diverted = fly("zem_zev_guidance", 4)
    assert actual.success.all()
    assert np.max(actual.metrics["site_error"]) < 0.5  # re-designations move along the sphere
    assert actual.metrics["ground_left"][diverted] == pytest.approx(np.full(2, 300.0), abs=5.0)
    assert np.all(actual.metrics["ground_left"][~diverted] < 5.0)
