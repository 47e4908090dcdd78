"""Rare failure of a simulated system with a failure probability in closed form: output of the command.

Truth: Phi(-beta) of the linear system; repeated simulations of the reported trials; one worker.
"""

import json
from dataclasses import replace

import numpy as np
import pyarrow.parquet
import pytest
from scipy import stats

import perilune
from perilune.analysis.cli import main
from perilune.common.errors import InputError
from tests.support.foreign.linear_system import linear_system
from tests.support.lengths import either

# The deviation of total: half of sqrt(1.44 + 1 + 1 + 2 * 0.28).
LIMIT = 3.719016485  # sigmas: Phi(-LIMIT) = 1e-4
SAMPLES = either(4500, 500)


@pytest.fixture(scope="module")
def linear(tmp_path_factory):
    return linear_system(tmp_path_factory.mktemp("linear"))


@pytest.fixture(scope="module")
def actual(linear, tmp_path_factory):
    folder = tmp_path_factory.mktemp("found")
    return folder, perilune.rare(*linear, failure=f"total > {LIMIT}", samples=SAMPLES, workers=1, output=folder)


def test_the_interval_has_the_closed_form(actual):
    _, result = actual
    assert stats.norm.sf(LIMIT) == pytest.approx(1e-4, rel=1e-6)
    low, high = result.interval
    assert low < 1e-4 < high < either(3e-4, 1e-3)
    assert result.probability == pytest.approx(1e-4, rel=either(0.5, 2.0))
    assert result.flights < 5 * SAMPLES
    assert result.brute_force > 20 * result.flights


def test_the_likeliest_failure_is_the_nearest_point_of_the_plane(actual):
    """The distance of the plane from the origin is LIMIT; the flights come near that."""
    _, result = actual
    first = result.failures[0]
    assert LIMIT <= first["distance"] < LIMIT + either(0.15, 0.6)
    assert first["margin"] == first["metrics"]["total"] - LIMIT
    distances = [entry["distance"] for entry in result.failures]
    assert distances == sorted(distances)


def test_failures_fly_again_to_the_last_bit(actual, linear):
    folder, result = actual
    repeated = perilune.batch(*linear, draws=folder / "failures.parquet", workers=1)
    assert repeated.plan.campaign.trials == len(result.failures)
    for entry in result.failures:
        for name, value in entry["metrics"].items():
            assert repeated.trials["default"].metrics[name][entry["trial"]] == value
        assert not repeated.trials["default"].success[entry["trial"]]


def test_workers_do_not_matter(actual, linear):
    _, result = actual
    other = perilune.rare(*linear, failure=f"total > {LIMIT}", samples=SAMPLES, workers=2)
    assert other.json_document() == result.json_document()
    assert other.flown.points.tobytes() == result.flown.points.tobytes()
    assert other.flown.values.tobytes() == result.flown.values.tobytes()


def test_what_is_written(actual):
    folder, result = actual
    document = json.loads((folder / "rare.json").read_text())
    assert document["probability"] == result.probability
    assert document["flights"] == sum(1 for _ in result.flown.values) == result.flights
    assert document["levels"][0]["samples"] == SAMPLES
    table = pyarrow.parquet.read_table(folder / "flights.parquet")
    assert table.num_rows == result.flights
    total = 0.5 * (table["draw.a.gain"].to_numpy() + table["draw.b.gain"].to_numpy() + table["draw.c.gain"].to_numpy())
    np.testing.assert_allclose(table["metric.total"].to_numpy(), total, atol=1e-13)
    np.testing.assert_allclose(table["margin"].to_numpy(), total - LIMIT, atol=1e-13)


def test_the_command(linear, tmp_path, capsys, refusal):
    line = ["rare", linear[0], "--campaign", linear[1], "--samples", "300", "--workers", "1"]
    assert main([*line, "--output", str(tmp_path / "out"), "--require", "interval[2] < 0.1"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("failure probability 0.00")
    assert "failure: not (total < 3.0902323)\n" in text
    assert "\nDesign points\n" in text
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "failures.parquet", "flights.parquet", "rare.json",
    ]  # fmt: skip
    assert "holds results already (rare.json" in refusal([*line, "--output", str(tmp_path / "out")])
    assert main([*line, "--json", "-", "--require", "probability < 1e-6"]) == 1
    captured = capsys.readouterr()
    document = json.loads(captured.out)
    low, high = document["interval"]
    assert low < stats.norm.sf(3.0902323) < high
    assert "--require: probability < 1e-6: not met" in captured.err


CHOICE = '[draw."a.count"]\ndistribution = "choice"\nvalues = [0, 1]\n'


def test_what_is_held_is_said(tmp_path, capsys, refusal):
    linear = linear_system(tmp_path, CHOICE)
    line = ["rare", linear[0], "--campaign", linear[1], "--samples", "300", "--workers", "1"]
    assert "a choice has discrete values, but this study needs a continuous draw; hold this draw" in refusal(line)
    assert main([*line, "--hold", "a.count=1", "--failure", "total > 2.5"]) == 0  # total is defined for count 1
    text = capsys.readouterr().out
    for part in ("failure probability", "all numbers", "Levels"):
        line = next(line for line in text.splitlines() if part in line)
        assert line.endswith(" conditional on a.count = 1")


def test_no_batch_is_printed_for_held_values(tmp_path):
    """A batch holds nothing: its trials would not be those of a result with held values."""
    linear = linear_system(tmp_path, CHOICE)
    result = perilune.rare(*linear, failure="total > 2.5", samples=100, hold={"a.count": 1}, workers=1)
    assert "conditional on a.count = 1" in repr(result)
    ended = replace(result, simulation=replace(result.simulation, noise_ends=True))
    assert ended.monte_carlo == ""
    ended.space.held.clear()
    assert ended.monte_carlo.startswith("perilune batch ")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"failure": "total > "}, "failure: total >"),
        ({"failure": "where(total > 5, 1, 0)"}, "100 % of a level's simulations have the same margin"),
        ({"samples": 50}, "samples: 50: below 100"),
        ({"least": 2.0}, "least: 2: not a probability"),
        ({"hold": {"b.gain": 1.0}}, "is drawn together with c.gain"),
        ({"noise_trial": -1}, "noise_trial"),
    ],
)
def test_refusals(linear, options, words):
    with pytest.raises(InputError, match=words):
        perilune.rare(*linear, workers=1, **({"samples": 300} | options))


@pytest.mark.usefixtures("fmus")
def test_variants_are_to_be_chosen_and_noise_can_be_held():
    with pytest.raises(InputError, match=r"3 variants.*give configuration analytic_guidance"):
        perilune.rare("lunar_terminal_guidance", "noisy")
    result = perilune.rare(
        "lunar_terminal_guidance", "noisy", compare={"guidance": "analytic_guidance"}, noise_trial=3, samples=100,
        failure="position_error > 0", workers=1,
    )  # fmt: skip
    assert result.probability == 1.0
    assert result.noise.components == ("navigation", "allocation")
    assert (
        "probability 1, 95 % interval 0.964 to 1, conditional on the noise realisation of trial 3" in result.lines()[0]
    )
    assert result.json_document()["noise_trial"] == 3
