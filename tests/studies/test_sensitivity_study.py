"""Sensitivity of a system's metrics, by simulation.

Truth: the shares of the variances of a sum; one worker; the table of the simulations.
"""

import json

import numpy as np
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.common.errors import InputError
from tests.support.foreign.linear_system import linear_system

CAMPAIGN = """
system = "linear.ssp"
trials = 64
seed = 3
[draw."a.gain"]
distribution = "normal"
mean = 5
sigma = 1
[draw."b.gain"]
distribution = "normal"
mean = 0
sigma = 2
[draw."c.gain"]
distribution = "uniform"
low = 0
high = 6
[metric.total]
expression = "a.y + b.y + c.y"
reduction = "final"
[metric.same]
expression = "a.tolerance"
reduction = "final"
[success]
expression = "total > 0"
"""
SHARES = np.array([1.0, 4.0, 3.0]) / 8.0


@pytest.fixture(scope="module")
def linear(tmp_path_factory):
    folder = tmp_path_factory.mktemp("linear")
    system, _ = linear_system(folder)
    (folder / "c.toml").write_text(CAMPAIGN)
    return system, str(folder / "c.toml")


def test_the_shares_of_a_sum(linear, tmp_path):
    result = perilune.sensitivity(*linear, 256, workers=1, output=tmp_path / "out")
    total = result.of("total")
    for order in ("first", "total"):
        np.testing.assert_allclose([total[f"{name}.gain"][order] for name in "abc"], SHARES, atol=0.06)
        for name, fraction in zip("abc", SHARES, strict=True):
            low, high = total[f"{name}.gain"][f"{order}_interval"]
            assert low < fraction < high
    assert result.without_indices == {"same": "-1 in all simulations", "success": "1 in all simulations"}
    assert result.flights == 256 * 5
    assert json.loads((tmp_path / "out" / "sensitivity.json").read_text()) == result.json_document(tmp_path / "out")
    assert pyarrow.parquet.read_table(tmp_path / "out" / "flights.parquet").num_rows == 1280
    other = perilune.sensitivity(*linear, 256, workers=2)
    assert other.json_document() == result.json_document()


def test_the_command_says_its_price_first(linear, capsys):
    line = ["sensitivity", linear[0], "--campaign", linear[1], "--base", "32", "--workers", "1"]
    assert main([*line, "--hold", "b.gain=1"]) == 0
    captured = capsys.readouterr()
    assert captured.err == "perilune: sensitivity: 32 x (2 draws + 2) = 128 flights\n"
    assert captured.out.startswith(
        "Sobol' indices of 1 of 3 numbers (metrics and success), by 128 simulations, conditional on b.gain = 1\n"
    )
    assert "same: no indices, -1 in all simulations" in captured.out
    lines = captured.out.splitlines()
    table = next(row for row, line in enumerate(lines) if line.startswith("parameter"))
    first, second = (text.split()[0] for text in lines[table + 1 : table + 3])
    assert (first, second) == ("c.gain", "a.gain")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--base", "100"], "--base: 100: not 32, 64, 128 or a higher power of two"),
        (["--base", "16"], "--base: 16"),
    ],
)
def test_wrong_input(linear, capsys, options, words):
    assert main(["sensitivity", linear[0], "--campaign", linear[1], *options]) == 2
    error = capsys.readouterr().err
    assert words in error
    assert error.count("\n") == 1


def test_correlated_draws_are_refused(tmp_path):
    linear = linear_system(tmp_path)
    with pytest.raises(
        InputError, match=r"draw\.pair: jointly normal values have no separate indices; hold these values"
    ):
        perilune.sensitivity(*linear, 64)
    result = perilune.sensitivity(*linear, 64, hold={"b.gain": 1.0, "c.gain": 0.0}, workers=1)
    assert result.of("total")["a.gain"]["total"] == pytest.approx(1.0, rel=0.1)


def test_rank_correlations_of_a_batch_and_its_page(linear, tmp_path):
    batch = perilune.batch(*linear, workers=1)
    actual = batch.rank_correlations()
    assert actual["total"]["b.gain"] > actual["total"]["a.gain"]
    assert actual["same"]["b.gain"] is None
    assert batch.rank_correlations("default") == actual
    batch.report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    assert "Correlation with dispersed inputs" in page
    assert "total" in page
