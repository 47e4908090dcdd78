"""perilune.analysis.campaigns.tables: summaries on a terminal."""

import math

import numpy as np
import pytest

from perilune.analysis.campaigns.definition.campaign import TrialGroup
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.requirements import Requirement
from perilune.analysis.campaigns.statistics import STATISTICS
from perilune.analysis.campaigns.summary import summarise
from perilune.analysis.campaigns.summary_text import WIDTH, rate_lines, select_metrics, summary_text
from perilune.analysis.campaigns.trials import TrialTable
from perilune.common.errors import InputError
from tests.support.campaigns.trial_tables import trial_table

GOOD = trial_table(["finished"] * 4, np.array([True, True, True, False]), {"miss": np.array([1.0, 2.0, 6.0, 500.0])})
BAD = trial_table(["nonfinite", "finished"], np.array([False, False]), {"miss": np.array([math.nan, 900.0])})
LATE = trial_table(["finished"] * 3, np.array([True] * 3), {"miss": np.array([1.0, -2.0, math.inf])})


@pytest.fixture(scope="module")
def lines():
    return summary_text(summarise({"good": GOOD, "bad": BAD, "late": LATE})).splitlines()


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
    assert len(summary_text(summarise({"good": trial_table(GOOD.statuses, GOOD.success, {})})).splitlines()) == 2


def test_a_line_per_group_beside_the_whole():
    groups = [TrialGroup("1", 1.0), TrialGroup("2.5", 2.5)]
    good = trial_table(GOOD.statuses, GOOD.success, GOOD.metrics, {"case": np.array([1.0, 2.5, 2.5, 1.0])})
    lines = summary_text(summarise({"good": good}, groups, "case"), "case").splitlines()
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


def columns(**metrics: list[float]) -> TrialTable:
    count = len(next(iter(metrics.values())))
    arrays = {name: np.array(values) for name, values in metrics.items()}
    return trial_table(["finished"] * count, np.ones(count, dtype=bool), arrays)


def test_lines_fit_and_say_which_columns_are_left_out():
    long = "a_variant_with_quite_a_long_name"
    summary = summarise({long: columns(miss=[1.0001e-5, 2.0002e5, -3.0003e-7])})
    lines = summary_text(summary).splitlines()
    assert max(map(len, lines)) <= WIDTH
    head, row, note = lines[3:]
    left_out = note.removeprefix("columns left out: ").removesuffix("; `json` has all").split(", ")
    assert left_out
    assert [name for name in STATISTICS if name in head.split() or name in left_out] == list(STATISTICS)
    values = dict(zip(head.split()[4:-1], row.split()[2:-1], strict=True))
    assert not values.keys() & set(left_out)
    assert float(values["max"]) == 2.0e5


def test_a_metric_that_is_the_same_everywhere_is_a_line():
    variants = {"a": columns(miss=[1.0, 2.0], flag=[1.0, 1.0]), "b": columns(miss=[3.0, 4.0], flag=[1.0, 1.0])}
    lines = summary_text(summarise(variants)).splitlines()
    assert lines[-1] == "the same in all successful trials: flag 1"
    assert not any(line.startswith("flag") for line in lines)
    variants["b"] = columns(miss=[3.0, 4.0], flag=[1.0, math.inf])
    assert sum(line.startswith("flag") for line in summary_text(summarise(variants)).splitlines()) == 2


def test_metrics_that_are_printed():
    known = ["a", "b", "c"]
    assert select_metrics((), known, {"c", "success"}) == ["c"]
    assert select_metrics((), known, {"success"}) == known
    assert select_metrics(["b", "a", "b"], known, {"c"}) == ["b", "a"]
    assert select_metrics(["all"], known, {"c"}) == known
    with pytest.raises(InputError, match=r"metrics: d: no such metric; .* or give all"):
        select_metrics(["d"], known, ())


def test_rates_that_are_the_same_in_all_rows_become_a_line_where_it_is_long():
    head = ["variant", "trials", "success", "x" * 60, "y" * 40]
    rows = [["one", "40", "100", "1", "2"], ["two", "40", "100", "1", "3"]]
    notes = [f"the same in all rows: {each}" for each in ("trials 40", f"{'x' * 60} 1")]
    assert sorted(rate_lines([head, *rows], 1)[3:]) == notes
    assert rate_lines([head[:3], *(row[:3] for row in rows)], 1)[1].split() == ["one", "40", "100"]


def test_a_stored_requirement_begins_with_its_expression():
    """By which a comparison knows the metrics that are judged."""
    requirement = Requirement("r", Expression("min(miss, 2) < 3 and success"), 0.95, 0.9)
    assert str(requirement).rpartition(", ")[0] == requirement.expression.text


def test_a_long_last_column_becomes_a_line_for_each_row():
    """The columns that are compared stay a table; the last one follows by row."""
    statuses = "3 finished (allocation.status 1), " * 3 + "1 crashed"
    lines = rate_lines([["variant", "trials", "success %", "statuses"], ["one", "10", "90", statuses]], 1)
    assert [line.split() for line in lines[:2]] == [["variant", "trials", "success", "%"], ["one", "10", "90"]]
    assert lines[2:] == [f"statuses of one: {statuses}"]
