"""Counts of a page under a filter equal the counts in the files.

Truth: pyarrow's filters and sums over all columns of the folder.
"""

from __future__ import annotations

import base64

import numpy as np
import pyarrow.compute
import pyarrow.dataset
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pyarrow.compute import field

from perilune.analysis.cli import main
from perilune.analysis.show.binned_columns import BinnedColumns
from perilune.analysis.show.scale import BARS, BINS, make_scale
from tests.support.campaigns.show_client import ShowClient

TRIALS, VARIANTS = 2100, ("alpha", "beta", "gamma")

RANGE = st.tuples(st.integers(0, BINS - 1), st.integers(0, BINS - 1)).map(sorted)


@pytest.fixture(scope="session")
def table(campaign_folder):
    return pyarrow.dataset.dataset(campaign_folder / "trials").to_table()


@pytest.fixture(scope="session")
def edges(table):
    return {name: make_scale(table[name].to_numpy()).edges for name in table.column_names if name.startswith("metric.")}


def within(edges, name, first, last):
    low, high = edges[name][first], edges[name][last + 1]
    return (field(name) >= low) & (field(name) < high)


def outcomes(table):
    rows = []
    for variant in VARIANTS:
        success = table.filter(field("variant") == variant)["success"]
        count = pyarrow.compute.sum(success).as_py() or 0
        rows.append([len(success) - count, count])
    return rows


def test_columns_and_units(client):
    assert client.names[:2] == ["metric.m0", "metric.m1"]
    assert client.names[-2:] == ["draw.offset", "end_time"]
    assert len(client.names) == 42
    assert client.campaign.quantities["metric.m1"].unit == "rad"


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.dictionaries(st.sampled_from(["metric.m0", "metric.m1", "metric.m2", "metric.m4"]), RANGE, max_size=3),
    st.sampled_from(["all", "success", "failure"]),
    st.lists(st.integers(0, 2), unique=True) | st.none(),
)
def test_filters(client, table, edges, ranges, outcome, variants):
    ranged = [
        {"column": number, "first": first, "last": last}
        for number, (first, last) in zip(client.numbers(*ranges), ranges.values(), strict=True)
    ]
    histograms = client.numbers("metric.m0", "metric.m3", "metric.m4")
    query = {"ranges": ranged, "outcome": outcome, "variants": variants, "histograms": histograms}
    answer = client.query("counts", **query).json()
    common = pyarrow.compute.scalar(True)
    if outcome != "all":
        common = field("success") == (outcome == "success")
    if variants is not None:
        common = common & field("variant").isin(pyarrow.array([VARIANTS[each] for each in variants], pyarrow.string()))
    conditions = {name: within(edges, name, *ends) for name, ends in ranges.items()}

    def select(without=None):
        where = common
        for name, condition in conditions.items():
            where = where if name == without else where & condition
        return table.filter(where)

    assert answer["outcomes"] == outcomes(select())
    ends = [(each["low"], each["high"]) for each in answer["ranges"]]
    assert ends == [(edges[n][first], edges[n][last + 1]) for n, (first, last) in ranges.items()]
    assert all(0 <= each["step"] <= each["high"] - each["low"] for each in answer["ranges"])
    for name, histogram in zip(("metric.m0", "metric.m3", "metric.m4"), answer["histograms"], strict=True):
        rows = select(without=name)
        for variant, counts in zip(VARIANTS, histogram["counts"], strict=True):
            numbers = rows.filter(field("variant") == variant)[name].to_numpy()
            bars = np.histogram(numbers[np.isfinite(numbers)], edges[name][:: BINS // BARS])[0]
            assert counts[:BARS] == bars.tolist()
            assert counts[BARS:] == [np.isnan(numbers).sum(), np.isposinf(numbers).sum(), np.isneginf(numbers).sum()]


def test_grids_of_many_trials(client, table, edges, monkeypatch):
    monkeypatch.setattr("perilune.analysis.show.counts.DOT_LIMIT", 100)
    x, y = client.numbers("metric.m0", "metric.m3")
    (grid,) = client.query("counts", grids=[[x, y]]).json()["grids"]
    steps = [edges[name][:: BINS // BARS] for name in ("metric.m3", "metric.m0")]
    for rows, counts in ((table, grid["counts"]), (table.filter(~field("success")), grid["failures"])):
        expected = np.histogram2d(rows["metric.m3"].to_numpy(), rows["metric.m0"].to_numpy(), steps)[0]
        assert np.array_equal(np.reshape(counts, (BARS, BARS)), expected)


def test_dots_of_few_trials(client, table, edges):
    x, y = client.numbers("metric.m0", "metric.m4")
    query = {"grids": [[x, y]], "outcome": "failure"}
    (grid,) = client.query("counts", **query).json()["grids"]
    kinds = {"rows": "<u4", "x": "<u2", "y": "<u2", "success": "u1", "variants": "<u2"}
    dots = {name: np.frombuffer(base64.b64decode(grid["dots"][name]), kinds[name]) for name in kinds}
    rows = table.filter(~field("success") & pyarrow.compute.is_finite(field("metric.m4")))
    assert dots["rows"].size == rows.num_rows > 100
    assert not dots["success"].any()
    for name, column in (("x", "metric.m0"), ("y", "metric.m4")):
        numbers = rows[column].to_numpy()
        assert np.all(edges[column][dots[name]] <= numbers)
        assert np.all(numbers <= edges[column][dots[name] + 1])
    assert [VARIANTS[number] for number in dots["variants"]] == rows["variant"].to_pylist()
    chosen = dots["rows"][-1]
    entry = client.get(f"/campaigns/0/trials/{chosen}").json()
    assert (entry["variant"], entry["trial"]) == (rows["variant"][-1].as_py(), rows["trial"][-1].as_py())


def test_trials_have_exact_numbers_and_their_commands(client, table, campaign_folder):
    numbers = client.numbers("metric.m1", "metric.m4", "draw.offset")
    chosen = {"column": numbers[0], "first": 3000, "last": BINS - 1}
    entries = client.query("trials", histograms=numbers, ranges=[chosen]).json()
    low = client.query("counts", ranges=[chosen]).json()["ranges"][0]["low"]
    rows = table.filter(field("metric.m1") >= low).to_pylist()
    assert len(entries) == min(50, len(rows)) > 3
    for entry, row in zip(entries, rows, strict=False):
        assert (entry["trial"], entry["variant"], entry["status"]) == (row["trial"], row["variant"], row["status"])
        assert entry["numbers"][0] == row["metric.m1"]
        assert entry["numbers"][2] == row["draw.offset"]
        command = f"perilune replay {campaign_folder} {row['trial']} --configuration {row['variant']}"
        assert entry["command"] == command
    assert all(each["numbers"][1] is None or each["numbers"][1] == "inf" or each["numbers"][1] < 9 for each in entries)


def test_one_trial_has_all_numbers(client, table):
    entry = client.get(f"/campaigns/0/trials/{3 * TRIALS - 1}").json()
    (row,) = table.slice(3 * TRIALS - 1, 1).to_pylist()
    assert (entry["variant"], entry["trial"]) == ("gamma", TRIALS - 1)
    for name, number in zip(client.names, entry["numbers"], strict=True):
        assert number == row[name] or not np.isfinite(row[name])


def test_columns_are_forgotten_and_read_again(campaign_folder, client):
    columns = BinnedColumns(client.campaign, memory=2.5 * 2 * client.campaign.rows)  # two columns
    first = columns.get(["metric.m0"])["metric.m0"].codes
    columns.get(["metric.m1", "metric.m2", "metric.m3"])
    assert list(columns._columns) == ["metric.m2", "metric.m3"]
    reread = columns.get(["metric.m0"])["metric.m0"].codes
    assert reread is not first
    assert np.array_equal(reread, first)


def test_a_campaign_that_is_not_complete(tmp_path, fmus):
    command = ["lunar_terminal_guidance", "--campaign", "paper", "--trials", "50", "--stop-time", "5"]
    assert main(["prepare", *command, "--output", str(tmp_path / "out")]) == 0
    assert main(["shard", str(tmp_path / "out"), "1"]) in (0, 1)
    client = ShowClient(tmp_path / "out")
    answer = client.query("counts").json()
    assert [sum(each) for each in answer["outcomes"]] == [25] * len(client.campaign.variants)
    assert client.get("/campaigns/0/trials/0").json()["trial"] == 25
