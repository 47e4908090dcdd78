"""Simulated failure due to noise: noise is random unless held, and failed trials can be replayed.

Truth: the share of failed trials in a batch, with its exact binomial interval; replays from the written draws, to the
last bit; a batch with the streams of one trial.
"""

import json

import pyarrow
import pyarrow.parquet
import pytest
from scipy.stats import binomtest

import perilune
from perilune.analysis.cli import main
from perilune.common.errors import InputError
from tests.support.lengths import either

CAMPAIGN = ("lunar_terminal_guidance", "noisy")
ONE = {"guidance": "analytic_guidance"}
LIMIT = 3.0  # m: what about one trial in ten exceeds
SAMPLES = either(1000, 150)
pytestmark = pytest.mark.usefixtures("fmus")


@pytest.fixture(scope="module")
def trials():
    return perilune.batch(*CAMPAIGN, compare={"guidance": ["analytic_guidance"]}, trials=300, workers=1)


@pytest.fixture(scope="module")
def limit(trials):
    """Return the value that 4 % of the trials exceed."""
    column = sorted(trials.trials["analytic_guidance"].metrics["position_error"].tolist())
    return column[-13]


@pytest.fixture(scope="module")
def actual(limit, tmp_path_factory):
    folder = tmp_path_factory.mktemp("found")
    failure = f"position_error > {limit!r}"
    return folder, perilune.rare(*CAMPAIGN, compare=ONE, failure=failure, samples=SAMPLES, workers=1, output=folder)


def test_the_interval_is_that_of_trials_with_noise_of_their_own(actual):
    _, result = actual
    exact = binomtest(12, 300).proportion_ci(method="exact")
    low, high = result.interval
    assert low < exact.high
    assert high > exact.low
    assert high / low < either(3.0, 12.0)
    assert result.conditions == ""
    assert "conditional" not in "".join(result.lines())
    assert result.json_document()["noise"] == {"components": ["navigation", "allocation"], "random": True}
    assert result.json_document()["noise_trial"] is None


def test_noise_moves_are_in_the_table_of_levels(actual):
    _, result = actual
    second = result.json_document()["levels"][1]
    assert 0.0 < second["noise_acceptance"] <= 1.0
    assert second["source"] in (None, "navigation", "allocation")
    heading = next(line for line in result.lines() if line.startswith("level "))
    assert "accepted: draws" in heading
    assert "noise" in heading
    assert "threshold, m" in heading


def test_failures_fly_again_with_the_stream_of_each_component(actual):
    folder, result = actual
    table = pyarrow.parquet.read_table(folder / "failures.parquet")
    assert {"streams_of.navigation", "streams_of.allocation"} <= set(table.column_names)
    assert "streams_of" not in table.column_names
    repeated = perilune.batch(
        *CAMPAIGN, compare={"guidance": ["analytic_guidance"]}, draws=folder / "failures.parquet", workers=1
    )
    (flown,) = repeated.trials.values()
    for entry in result.failures:
        assert entry["streams"] == {
            name: int(table[f"streams_of.{name}"][entry["trial"]].as_py()) for name in ("navigation", "allocation")
        }
        for name, value in entry["metrics"].items():
            assert flown.metrics[name][entry["trial"]] == value


def test_the_printed_command_flies_a_failure_again(actual, capsys):
    folder, result = actual
    command = result.replay(folder, 0)
    assert command in "\n".join(result.lines())
    assert json.loads((folder / "rare.json").read_text())["failures"][0]["replay"] == command
    words = command.split()
    assert words[0] == "perilune"
    assert main([*words[1:], "--json", "-"]) in (0, 1)
    assert f"{result.failures[0]['metrics']['position_error']:.4g}"[:4] in capsys.readouterr().out


def test_held_noise_is_a_condition_on_every_line(limit, capsys):
    line = ["rare", CAMPAIGN[0], "--campaign", CAMPAIGN[1], "--compare", "guidance=analytic_guidance", "--workers", "1"]
    assert main([*line, "--failure", f"position_error > {limit / 2}", "--samples", "100", "--noise-trial", "3"]) == 0
    text = capsys.readouterr().out
    for start in ("failure probability", "Levels", "Design points"):
        of = next(line for line in text.splitlines() if line.startswith(start))
        assert of.endswith("conditional on the noise realisation of trial 3")


def test_streams_of_all_components_and_of_one(actual, trials, tmp_path):
    """A file with one column for all, as files had before, flies as that trial; a component's own column wins."""
    folder, _ = actual
    table = pyarrow.parquet.read_table(folder / "failures.parquet").slice(0, 1)
    draws = table.drop_columns(["streams_of.navigation", "streams_of.allocation"])

    def error(**streams):
        path = tmp_path / "draws.parquet"
        columns = {name.replace("__", "."): pyarrow.array([number]) for name, number in streams.items()}
        with_streams = draws
        for name, column in columns.items():
            with_streams = with_streams.append_column(name, column)
        pyarrow.parquet.write_table(with_streams, path)
        result = perilune.batch(*CAMPAIGN, compare={"guidance": ["analytic_guidance"]}, draws=path, workers=1)
        return next(iter(result.trials.values())).metrics["position_error"].item()

    all_of_7 = error(streams_of=7)
    assert all_of_7 == error(streams_of__navigation=7, streams_of__allocation=7)
    assert error(streams_of=7, streams_of__navigation=8) == error(streams_of__navigation=8, streams_of__allocation=7)
    assert all_of_7 != error(streams_of__navigation=8, streams_of__allocation=7)
    with pytest.raises(InputError, match=r"streams_of\.plant: no component that draws random numbers has this name"):
        error(streams_of__plant=7)
