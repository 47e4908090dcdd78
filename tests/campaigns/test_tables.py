"""perilune.analysis.campaigns.tables: summaries on a terminal."""

import math
from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.campaigns.spec.campaign import Group, Metric
from perilune.analysis.campaigns.spec.expressions import Expression
from perilune.analysis.campaigns.summary import summarise
from perilune.analysis.campaigns.tables import summary_text
from perilune.analysis.campaigns.trials import TrialColumns

METRICS = [Metric("miss", Expression("p.x"), "final", unit="m")]
GOOD = TrialColumns(["finished"] * 4, np.array([True, True, True, False]), {"miss": np.array([1.0, 2.0, 6.0, 500.0])})
BAD = TrialColumns(["nonfinite", "finished"], np.array([False, False]), {"miss": np.array([math.nan, 900.0])})
LATE = TrialColumns(["finished"] * 3, np.array([True] * 3), {"miss": np.array([1.0, -2.0, math.inf])})


@pytest.fixture(scope="module")
def lines():
    return summary_text(summarise({"good": GOOD, "bad": BAD, "late": LATE}, METRICS)).splitlines()


def test_rates(lines):
    rates = lines[:4]
    assert rates[0].split("  ")[0] == "variant"
    assert rates[1].split() == ["good", "4", "75.00", "19.41", "to", "99.37", "4", "finished"]
    assert len({len(line) for line in rates}) == 1


def test_metrics(lines):
    head, good, bad, late = (line.split() for line in lines[5:])
    assert head[3:] == ["variant", "mean", "std", "rms", "min", "p5", "p50", "p95", "p99", "max", "unit"]
    assert good == ["miss", "good", "3", "2.646", "3.697", "1", "1", "2", "6", "6", "6", "m"]
    assert bad == ["miss", "bad", *["-"] * 9, "m"]
    assert late == ["miss", "late", "-0.5", "2.121", "1.581", "-2", "-2", "1", "inf", "inf", "1", "m"]
    assert len({len(line) for line in lines[5:]}) == 1


def test_without_metrics():
    assert len(summary_text(summarise({"good": GOOD}, [])).splitlines()) == 2


def test_a_line_per_group_beside_the_whole():
    groups = [Group("1", 1.0), Group("2.5", 2.5)]
    good = replace(GOOD, draws={"case": np.array([1.0, 2.5, 2.5, 1.0])})
    lines = summary_text(summarise({"good": good}, METRICS, groups, "case"), "case").splitlines()
    assert lines[0].split()[:3] == ["variant", "case", "trials"]
    assert [line.split()[:4] for line in lines[1:4]] == [
        ["good", "all", "4", "75.00"],
        ["good", "1", "2", "50.00"],
        ["good", "2.5", "2", "100.00"],
    ]
    assert [line.split()[:4] for line in lines[6:]] == [
        ["miss", "good", "all", "3"],
        ["miss", "good", "1", "1"],
        ["miss", "good", "2.5", "4"],
    ]
