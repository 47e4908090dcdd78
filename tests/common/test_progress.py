"""perilune.common.progress: lines of a log where standard error is no terminal.

Truth: the steps taken by the test.
"""

from __future__ import annotations

import math

import pytest

from perilune.common import progress
from perilune.common.progress import progress_bar


def work(steps: int, **options: object) -> None:
    with progress_bar(unit="flight", **options) as bar:
        for _ in range(steps):
            bar.set_postfix_str("0 failed", refresh=False)
            bar.update(2)


def test_every_period_has_a_line(monkeypatch, capsys):
    monkeypatch.setattr(progress, "PERIOD", 0.0)
    work(3, total=6)
    written = capsys.readouterr()
    lines = [line.partition(" in ") for line in written.err.splitlines()]
    assert [before for before, _, _ in lines][-3:] == [f"perilune: {done} of 6 flights" for done in (2, 4, 6)]
    assert all(after.endswith(", 0 failed") for _, _, after in lines[-3:])
    assert written.out == ""
    assert "\r" not in written.err


def test_work_of_unknown_length_has_no_total(monkeypatch, capsys):
    monkeypatch.setattr(progress, "PERIOD", 0.0)
    work(1)
    assert capsys.readouterr().err.splitlines()[-1].startswith("perilune: 2 flights in ")


@pytest.mark.parametrize("period", [10.0, math.inf])
def test_quick_work_has_none(monkeypatch, capsys, period):
    monkeypatch.setattr(progress, "PERIOD", period)
    work(2, total=4)
    assert capsys.readouterr().err == ""
