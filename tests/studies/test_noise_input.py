"""Noise as an additional input of Sobol' indices.

Truth: a sum of draws and noise, whose shares of the variance are known; a product, whose noise acts only together with
a draw; for simulations, held noise and repeated simulations.
"""

import re

import numpy as np
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.studies.sobol import indices, saltelli_points, with_noise
from tests.support.hashed_noise import hashed_normals

BASE = 1024
CAMPAIGN = ("lunar_terminal_guidance", "noisy")
ONE = {"guidance": "analytic_guidance"}


def test_shares_of_a_sum_and_of_a_product():
    random = np.random.Generator(np.random.Philox(3))
    points, streams = with_noise(saltelli_points(BASE, 2, random), BASE)
    assert points.shape == (BASE * 5, 2)
    noise = hashed_normals(streams[:, np.newaxis], 1)[:, 0]
    centred = (points - 0.5) * np.sqrt(12.0)  # of variance 1
    total = centred[:, 0] + 2.0 * centred[:, 1] + np.sqrt(3.0) * noise  # shares 1, 4 and 3 of 8
    product = centred[:, 0] * noise  # no share of either alone, all of it of both together
    actual = indices(np.array([total, product]), BASE, random)
    np.testing.assert_allclose(actual.first[0], [1 / 8, 4 / 8, 3 / 8], atol=0.06)
    np.testing.assert_allclose(actual.total[0], [1 / 8, 4 / 8, 3 / 8], atol=0.06)
    np.testing.assert_allclose(actual.first[1], [0, 0, 0], atol=0.12)
    np.testing.assert_allclose(actual.total[1], [1, 0, 1], atol=0.12)
    for order, truth in (
        (actual.first_interval, [1 / 8, 4 / 8, 3 / 8]),
        (actual.total_interval, [1 / 8, 4 / 8, 3 / 8]),
    ):
        assert np.all((order[0, 0] < truth) & (truth < order[1, 0]))


def test_one_number_of_one_input():
    """All of the variance is its own."""
    random = np.random.Generator(np.random.Philox(5))
    actual = indices(saltelli_points(64, 1, random).T, 64, random)
    assert actual.first.shape == actual.total.shape == (1, 1)
    np.testing.assert_allclose([actual.first[0, 0], actual.total[0, 0]], 1.0, atol=0.2)


def test_rows_differ_in_one_input_only():
    points, streams = with_noise(saltelli_points(64, 3, np.random.Generator(np.random.Philox(1))), 64)
    first, second, *mixes = np.split(np.column_stack([points, streams]), 6)
    assert not np.any(first == second)
    for index, mix in enumerate(mixes):
        assert np.array_equal(np.flatnonzero(np.all(mix == second, axis=0)), [index])
        assert np.array_equal(np.flatnonzero(~np.all(mix == first, axis=0)), [index])


@pytest.mark.slow
@pytest.mark.usefixtures("fmus")
def test_the_noise_of_a_landing(tmp_path, capsys):
    line = ["sensitivity", CAMPAIGN[0], "--campaign", CAMPAIGN[1], "--compare", "guidance=analytic_guidance"]
    out = tmp_path / "out"
    assert main([*line, "--base", "32", "--workers", "1", "--output", str(out)]) == 0
    captured = capsys.readouterr()
    assert "sensitivity: 32 x (6 draws + 3) = 288 flights" in captured.err
    assert "conditional" not in captured.out
    assert "all of these components are one input" in captured.out
    assert "position_error, m" in captured.out
    assert not re.search(r"-0\.00(?!\d)", captured.out)
    result = perilune.sensitivity(*CAMPAIGN, 32, compare=ONE, workers=1)
    assert result.flights == 288
    entry = result.of("position_error")["noise realisation"]
    assert entry["rank"] is None
    assert entry["total"] > 0.5  # what is left of the error of a guidance that lands exactly without noise
    table = pyarrow.parquet.read_table(out / "draws.parquet")
    assert table["streams_of.navigation"].to_pylist()[:2] == [0.0, 1.0]
    assert table["streams_of.navigation"].to_pylist()[-1] == 63.0
    words = next(line for line in captured.out.splitlines() if line.startswith("the first simulation: ")).split()[3:]
    assert main([*words[1:3], "5", *words[4:], "--json", "-"]) in (0, 1)
    assert f"{result.flown.metrics['position_error'][5]:.4g}"[:4] in capsys.readouterr().out


@pytest.mark.usefixtures("fmus")
def test_held_noise_is_a_condition():
    result = perilune.sensitivity(*CAMPAIGN, 32, compare=ONE, noise_trial=2, workers=1)
    assert result.flights == 256
    assert result.lines()[0].endswith("conditional on the noise realisation of trial 2")
    assert "noise realisation" not in result.inputs
