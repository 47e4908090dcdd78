"""Progress of a study is shown on a terminal only, whichever process does the work.

Truth: the steps of a study: a linear model and the channels of each point, three communication steps, the trials of a
campaign, the intervals of a sweep.
"""

from dataclasses import replace

import pytest

import perilune
from perilune.analysis.cli import main
from perilune.common import progress as bar
from tests.support.bars import watched
from tests.support.loops.studies import LATE, SWEEP, campaign, named

TRIALS, INTERVALS, STEPS = 3, 12, 3
EARLIER = '<Point name="earlier" time="10.0"/>'


@pytest.fixture
def late(exact_fmus, tmp_path):
    return str(named(LATE, "late", SWEEP).packed(tmp_path, exact_fmus))


def test_every_step_is_counted(late, tmp_path, monkeypatch):
    bars = watched(monkeypatch, bar)
    report = perilune.stability(late, campaign=campaign(tmp_path, 0.5, 1.0), trials=TRIALS)
    expected = 1 + len(report.loops) + STEPS + TRIALS + INTERVALS
    assert bars.ends == [(expected, expected)]
    assert bars.moves == [expected]


@pytest.mark.slow
def test_other_processes_tell_their_steps(exact_fmus, tmp_path, monkeypatch):
    bars = watched(monkeypatch, bar)
    ssd = LATE.ssd.replace('<Point name="there" time="20.0"/>', f'<Point name="there" time="20.0"/>{EARLIER}')
    two = replace(LATE, ssd=ssd.replace('points="there"', 'points="there earlier"'))
    report = perilune.stability(str(two.packed(tmp_path, exact_fmus)), workers=2)
    assert [loop.point for loop in report.loops] == ["there", "earlier"]
    expected = 2 * (1 + 1 + STEPS)
    assert bars.ends == [(expected, expected)]
    assert bars.moves == [expected]


def test_nothing_is_written_where_nobody_watches(exact_fmus, tmp_path, capsys):
    assert main(["stability", str(LATE.packed(tmp_path, exact_fmus))]) in (0, 1)
    assert "step" not in capsys.readouterr().err
