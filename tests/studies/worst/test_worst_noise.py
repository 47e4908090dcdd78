"""Worst case under noise: the same realisations at every point, fresh realisations for the worst point.

Truth: order statistics of the simulations, which are repeated from the written draws to the last bit; messages on
options.
"""

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.studies.worst.realisations import Realisations, read_realisations
from perilune.common.errors import InputError

CAMPAIGN = ("lunar_terminal_guidance", "noisy")
ONE = {"guidance": "analytic_guidance"}
COUNT = 2


@pytest.fixture(scope="module")
def actual(fmus, tmp_path_factory):
    folder = tmp_path_factory.mktemp("found")
    result = perilune.worst(
        *CAMPAIGN, compare=ONE, metric="position_error", flights=240, realisations=COUNT, quantile=1.0, workers=1,
        output=folder,
    )  # fmt: skip
    return folder, result


def test_every_point_flies_the_same_realisations(actual):
    _, result = actual
    search = slice(0, result.flights - 10 * COUNT)
    for name in ("navigation", "allocation"):
        streams = result.flown.draws[f"streams_of.{name}"]
        assert streams[search].tolist() == [0.0, 1.0] * (streams[search].size // 2)
        assert streams[-10 * COUNT :].tolist() == list(range(COUNT, 11 * COUNT))
    assert result.flights <= 240


def test_the_worst_is_the_largest_objective_and_fresh_noise_says_what_it_is(actual):
    _, result = actual
    errors = result.flown.metrics["position_error"]
    pairs = errors[: -10 * COUNT].reshape(-1, COUNT).max(axis=1)
    inside = np.all((result.flown.points >= 0) & (result.flown.points <= 1), axis=1)[: -10 * COUNT : COUNT]
    assert result.value == pairs[inside].max()
    fresh = result.json_document()["fresh"]
    assert fresh["worst"] == errors[-10 * COUNT :].max() == fresh["at_quantile"]
    assert fresh["realisations"] == 10 * COUNT
    assert result.values()["fresh_worst"] == fresh["worst"]


def test_fresh_flights_are_those_of_the_worst_draws(actual, tmp_path):
    folder, result = actual
    worst = pyarrow.parquet.read_table(folder / "worst.parquet").slice(0, 1)
    fresh = worst.drop_columns(["streams_of.navigation", "streams_of.allocation"])
    pyarrow.parquet.write_table(fresh.append_column("streams_of", pyarrow.array([COUNT])), tmp_path / "fresh.parquet")
    pyarrow.parquet.write_table(worst, tmp_path / "worst.parquet")

    def error(path):
        repeated = perilune.batch(*CAMPAIGN, compare={"guidance": ["analytic_guidance"]}, draws=path, workers=1)
        return next(iter(repeated.trials.values())).metrics["position_error"].item()

    assert error(tmp_path / "worst.parquet") == result.value
    assert error(tmp_path / "fresh.parquet") == result.flown.metrics["position_error"][-10 * COUNT]


def test_what_is_printed(actual, capsys):
    _, result = actual
    text = "\n".join(result.lines())
    assert "position_error: worst " in text
    assert f" m (worst of {COUNT} noise realisations), of " in text
    assert f"under {10 * COUNT} fresh noise realisations: worst " in text
    assert "conditional" not in text
    assert "position_error, m" in text
    words = next(line for line in text.splitlines() if line.startswith("worst case: ")).split()[2:]
    assert main([*words[1:], "--json", "-"]) in (0, 1)
    assert f"{result.value:.4g}"[:4] in capsys.readouterr().out


def test_held_noise_is_a_condition(fmus):
    result = perilune.worst(*CAMPAIGN, compare=ONE, metric="position_error", flights=100, noise_trial=4, workers=1)
    assert result.flights == 100
    assert result.fresh is None
    lead, random = result.lines()[:2]
    assert random.startswith("worst of ")
    assert all(line.endswith("conditional on the noise realisation of trial 4") for line in (lead, random))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"realisations": 0}, "realisations: 0: not a positive number"),
        ({"quantile": 0.0}, "quantile: 0: not a quantile"),
        ({"quantile": 0.9}, "5 realisations are too few for this quantile; give realisations 10 or more"),
        ({"realisations": 3, "noise_trial": 0}, "realisations: 3: all simulations have the noise of trial 0"),
        ({"flights": 300, "realisations": 5}, "realisations: 5: 300 simulations are too few.*give flights 500 or more"),
    ],
)
@pytest.mark.usefixtures("fmus")
def test_refusals(options, words):
    with pytest.raises(InputError, match=words):
        perilune.worst(*CAMPAIGN, compare=ONE, metric="position_error", workers=1, **options)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.9, 1.0])
def test_objectives_are_order_statistics(share):
    """The least value of the realisations that the share does not exceed."""
    values = np.random.default_rng(1).standard_normal((50, 20))
    objective = Realisations(20, share).objective(values)
    at_most = np.mean(values <= objective[:, np.newaxis], axis=1)
    below = np.mean(values < objective[:, np.newaxis], axis=1)
    assert np.all(at_most >= share)
    assert np.all(below < share)


def test_defaults():
    assert read_realisations(None, None, 2000, None) == Realisations(5, 0.5)
    assert read_realisations(None, None, 300, None) == Realisations(3, 0.5)
    assert read_realisations(None, None, 2000, None, default=1) == Realisations(1, 0.5)
