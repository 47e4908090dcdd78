"""docs/studies/results.md: the output of its code for two campaigns.

Truth: numpy on the files, shard by shard; the lines on the page.
"""

import doctest
import re
import shlex

import numpy as np
import pyarrow.parquet
import pytest

from perilune.analysis.cli import main
from perilune.common.paths import ROOT
from tests.support.documented import commands_in

TEXT = (ROOT / "docs" / "studies" / "results.md").read_text(encoding="utf-8")
LINES = "\n".join(re.findall(r"^```pycon\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL))
FLAGS = doctest.NORMALIZE_WHITESPACE


@pytest.fixture(scope="module")
def place(fmus, tmp_path_factory):
    """Return a folder in which the page's campaigns have been simulated."""
    folder = tmp_path_factory.mktemp("page")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for command in commands_in(TEXT):
            assert main(shlex.split(command)[1:]) == 0
    return folder


@pytest.fixture(scope="module")
def shown(place):
    """Return the variables of the page once all of its lines have run, each with its output."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(place)
        page = doctest.DocTestParser().get_doctest(LINES, {}, "results.md", "results.md", 0)
        failures = []
        runner = doctest.DocTestRunner(optionflags=FLAGS)
        runner.run(page, out=failures.append, clear_globs=False)
        assert not failures, "".join(failures)
    return page.globs


@pytest.fixture(scope="module")
def columns(place):
    """Return every column of the first campaign, of both variants in order of trial."""
    tables = [pyarrow.parquet.read_table(path) for path in sorted((place / "results" / "trials").glob("*.parquet"))]
    actual = {name: np.concatenate([table[name].to_numpy() for table in tables]) for name in tables[0].column_names}
    order = np.lexsort((actual["trial"], actual["variant"]))
    return {name: values[order].reshape(2, -1) for name, values in actual.items()}  # analytic, then astar


def test_shares_of_success(shown, columns):
    thrust = columns["draw.allocation.maximum_thrust"]
    limits = np.arange(4500.0, 8001.0, 500.0)
    expected = [[np.mean(columns["success"][k][thrust[k] == limit]) for k in (0, 1)] for limit in limits]
    np.testing.assert_allclose(shown["shares"].to_numpy(), expected, rtol=1e-12)
    assert shown["shares"].index.tolist() == limits.tolist()


def test_rows_by_an_expression(shown, columns):
    assert shown["missed"].num_rows == np.sum(columns["metric.position_error"] > 1000.0)
    assert shown["longest"] == columns["end_time"].max()


def test_quantiles_of_both_ways(shown, columns):
    expected = np.quantile(columns["metric.position_error"], 0.999, axis=1, method="inverted_cdf")
    assert shown["tails"]["p999"].tolist() == expected.tolist()
    for variant, value in zip(shown["results"].variants, expected, strict=True):
        assert shown["results"].quantile("position_error", 0.999, variant) == value
    good = columns["metric.position_error"][0][columns["success"][0].astype(bool)]
    actual = shown["results"].quantile("position_error", 0.95, "analytic_guidance", where=shown["field"]("success"))
    assert actual == np.quantile(good, 0.95, method="inverted_cdf")


def test_pairs_on_the_same_trials(shown, columns):
    analytic, astar = columns["success"].astype(bool)
    longer = columns["metric.flight_time"][1] - columns["metric.flight_time"][0]
    for row in shown["pairs"].itertuples():
        both = (analytic == row.analytic) & (astar == row.astar)
        assert row.trials == both.sum()
        assert row.longer == pytest.approx(np.median(longer[both]), rel=1e-12)
    assert shown["pairs"]["trials"].sum() == analytic.size


def test_the_worst_ten(shown, columns):
    miss = columns["metric.position_error"][0]
    order = np.lexsort((np.arange(miss.size), -miss))[:10]
    worst = shown["worst"]
    assert worst["trial"].tolist() == order.tolist()
    for name in worst.columns[2:]:
        np.testing.assert_array_equal(worst[name], columns[f"draw.{name}"][0][order])


def test_traces(shown, place):
    altitude = shown["altitude"]
    for trial in (0, 23):
        path = place / "landings" / "traces" / "analytic_guidance" / f"{trial:06d}.parquet"
        trace = pyarrow.parquet.read_table(path)
        own = altitude.sel(trial=trial).dropna("time")
        np.testing.assert_array_equal(own["time"], trace["time"].to_numpy())
        np.testing.assert_array_equal(own, trace["plant.position[3]"].to_numpy())


def test_the_figure(shown, place, columns):
    panel = shown["figure"].axes[0]
    values = np.sort(columns["metric.velocity_error"][0])
    sampled = panel.lines[0].get_xdata()[1:-1]
    np.testing.assert_array_equal(sampled, np.clip(values, sampled[0], None))
    assert (place / "both.svg").is_file()
