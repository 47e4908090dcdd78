"""perilune.analysis.campaigns.definition.draws: distributions compared with scipy's, and dependence of each trial."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats
from scipy.stats import qmc

from perilune.analysis.campaigns.draws.generators import generator, stream_numbers
from perilune.analysis.campaigns.draws.table import draw_table
from perilune.common.errors import InputError
from tests.support.lengths import either

RANDOM = """
[draw.a]
distribution = "uniform"
low = -2
high = 3
[draw."p.b"]
distribution = "normal"
mean = 5
sigma = 2
[draw.pair]
distribution = "correlated_normal"
names = ["u", "v"]
mean = [1, -1]
covariance = [[4, 1.5], [1.5, 1]]
[draw.c]
distribution = "choice"
values = [1, 2, 4]
weights = [1, 2, 5]
[derive]
s = "a + sin(u) * p.b"
"p.t" = "s ** 2"
k = "7"
"""
DESIGN = '[draw.{}]\ndistribution = "{}"\nlow = -1\nhigh = 3\n'
ALPHA = 1e-3  # of the tests of fit; seeds are fixed, so that they pass or fail for good


@pytest.fixture(scope="module")
def table(campaign):
    return draw_table(campaign(RANDOM, trials=20000, seed=20170700))


def test_uniform_and_normal_fit(table):
    assert stats.kstest(table.columns["a"], stats.uniform(-2, 5).cdf).pvalue > ALPHA
    assert stats.kstest(table.columns["p.b"], stats.norm(5, 2).cdf).pvalue > ALPHA


def test_choice_has_its_weights(table):
    counts = [np.sum(table.columns["c"] == value) for value in (1, 2, 4)]
    assert sum(counts) == table.trials
    assert stats.chisquare(counts, np.array([1, 2, 5]) / 8 * table.trials).pvalue > ALPHA


def test_correlated_normal_has_its_covariance(table):
    pair = np.column_stack([table.columns["u"], table.columns["v"]]) - [1, -1]
    # squared Mahalanobis distances are chi-squared with two degrees of freedom
    distance = np.einsum("ki,ij,kj->k", pair, np.linalg.inv([[4, 1.5], [1.5, 1]]), pair)
    assert stats.kstest(distance, stats.chi2(2).cdf).pvalue > ALPHA
    # and correlation is tested in Fisher's z, of standard deviation 1/sqrt(n - 3)
    z = np.arctanh(np.corrcoef(pair.T)[0, 1]) - np.arctanh(0.75)
    assert abs(z) * np.sqrt(table.trials - 3) < stats.norm.isf(ALPHA / 2)


def test_fully_correlated_values_are_proportional(campaign):
    text = (
        '[draw.g]\ndistribution = "correlated_normal"\nnames = ["u", "v"]\nmean = [0, 0]\ncovariance = [[1, 2], [2, 4]]'
    )
    columns = draw_table(campaign(text, trials=100)).columns
    np.testing.assert_allclose(columns["v"], 2 * columns["u"], atol=1e-7)
    assert columns["u"].std() == pytest.approx(1.0, abs=0.25)


def test_streams_of_different_names_and_trials_are_independent(table):
    columns = np.column_stack([stats.rankdata(table.columns[name]) for name in ("a", "p.b", "u", "c")])
    correlations = np.corrcoef(columns.T) - np.eye(4)
    assert np.abs(correlations).max() * np.sqrt(table.trials) < stats.norm.isf(ALPHA / 12)
    following = np.corrcoef(table.columns["a"][:-1], table.columns["a"][1:])[0, 1]
    assert abs(following) * np.sqrt(table.trials) < stats.norm.isf(ALPHA / 2)


def test_derived_values_follow_their_expressions(table):
    row = {name: column[17] for name, column in table.columns.items()}
    assert row["s"] == pytest.approx(row["a"] + np.sin(row["u"]) * row["p.b"], rel=1e-15)
    assert row["p.t"] == row["s"] ** 2
    assert row["k"] == 7.0
    assert list(row) == ["a", "p.b", "u", "v", "c", "s", "p.t", "k"]
    parameters = table.parameters(slice(17, 18))
    assert {name: column.tolist() for name, column in parameters.items()} == {"p.b": [row["p.b"]], "p.t": [row["p.t"]]}


@settings(deadline=None)
@given(st.integers(1, 3000), st.integers(1, 3000), st.integers(0, 2**70))
def test_a_trial_is_the_same_whatever_the_number_of_trials(campaign, few, many, seed):
    few, many = sorted((few, many))
    short = draw_table(campaign(RANDOM, trials=few, seed=seed))
    long = draw_table(campaign(RANDOM, trials=many, seed=seed))
    for name, column in short.columns.items():
        assert column.tolist() == long.columns[name][:few].tolist(), name


PARTS = ["[draw" + part for part in RANDOM.split("[derive]")[0].split("[draw")[1:]]
PARTS += [
    DESIGN.format(name, kind) for name, kind in zip("dfghij", ["latin_hypercube", "sobol", "grid"] * 2, strict=True)
]
PARTS = [part.replace('"grid"\n', '"grid"\ncount = 4\n') for part in PARTS]


@settings(deadline=None, max_examples=either(30, 10))
@given(st.permutations(PARTS))
def test_the_order_of_declaration_does_not_matter(campaign, parts):
    shuffled = draw_table(campaign("".join(parts), trials=32)).columns
    plain = draw_table(campaign("".join(PARTS), trials=32)).columns
    assert {name: column.tolist() for name, column in shuffled.items()} == {
        name: column.tolist() for name, column in plain.items()
    }


@given(st.sampled_from(range(4)))
def test_a_random_draw_does_not_depend_on_the_others(campaign, index):
    alone = draw_table(campaign(PARTS[index])).columns
    together = draw_table(campaign("".join(PARTS[:4]))).columns
    for name, column in alone.items():
        assert column.tolist() == together[name].tolist()


def test_seeds_and_names_give_other_numbers():
    first = [generator(seed, name).random() for seed in (0, 1, 2**31, 2**64) for name in ("a", "b", "ab", "a.b")]
    assert len(set(first)) == len(first)


def test_grid_is_every_combination_last_name_fastest(campaign):
    text = '[draw.b]\ndistribution = "grid"\nvalues = [5, 7]\n'
    text += '[draw.a]\ndistribution = "grid"\nlow = 0\nhigh = 1\ncount = 3\n'
    columns = draw_table(campaign(text, trials=12)).columns
    assert columns["a"].tolist() == [0, 0, 0.5, 0.5, 1, 1] * 2
    assert columns["b"].tolist() == [5, 7] * 6
    with pytest.raises(
        InputError, match=r"^test\.toml: trials: 8 trials do not fill a grid of 6 points; use a multiple of 6$"
    ):
        draw_table(campaign(text, trials=8))


@given(st.integers(1, 200), st.integers(0, 1000))
def test_latin_hypercube_has_one_value_per_stratum(campaign, trials, seed):
    text = DESIGN.format("x", "latin_hypercube") + DESIGN.format("y", "latin_hypercube")
    columns = draw_table(campaign(text, trials=trials, seed=seed)).columns
    for column in columns.values():
        strata = np.floor((column + 1) / 4 * trials + 1e-9).astype(int)
        assert sorted(strata.tolist()) == list(range(trials))
    assert trials == 1 or columns["x"].tolist() != columns["y"].tolist()


def test_sobol_is_balanced_and_more_even_than_chance(campaign):
    text = "".join(DESIGN.format(name, "sobol") for name in "xyz")
    columns = draw_table(campaign(text, trials=256)).columns
    unit = (np.column_stack(list(columns.values())) + 1) / 4
    for column in unit.T:
        assert np.histogram(column, 256, (0, 1))[0].tolist() == [1] * 256
    chance = qmc.discrepancy(np.random.default_rng(1).random((256, 3)))
    assert qmc.discrepancy(unit) < chance / 5
    with pytest.raises(
        InputError, match="trials: 200 trials leave a Sobol sequence unbalanced; use a power of two: 128 or 256"
    ):
        draw_table(campaign(text, trials=200))


def test_derived_values_must_be_finite(campaign):
    text = '[draw.x]\ndistribution = "grid"\nvalues = [1, 0]\n[derive]\ny = "1 / x"\n'
    with pytest.raises(InputError, match=r"^test\.toml: derive\.y: '1 / x' is inf in trial 1; keep"):
        draw_table(campaign(text))


@given(st.integers(0, 2**40), st.integers(1, 30), st.integers(1, 20))
def test_stream_numbers_never_meet(seed, trials, size):
    names = [f"c{index}" for index in range(size)]
    actual = [stream_numbers(seed, np.arange(trials), name, names) for name in names]
    assert sorted(stream for _, streams in actual for stream in streams.tolist()) == list(range(trials * size))
    assert {number for number, _ in actual} == {seed % 2**31}


def streams(trial, component, names):
    seed, numbers = stream_numbers(1, np.array([trial]), component, names, "c.toml")
    return seed, *numbers.tolist()


def test_stream_numbers_do_not_depend_on_order():
    assert streams(5, "a", ["b", "a"]) == streams(5, "a", ["a", "b"]) == (1, 10)
    assert streams(5, "b", ["b", "a"]) == streams(5, "b", ["a", "b"]) == (1, 11)


def test_stream_numbers_stay_within_32_bits():
    last = 2**30 - 1
    assert streams(last, "b", "ab") == (1, 2**31 - 1)
    with pytest.raises(InputError, match=r"^c\.toml: trials: trial 1073741824 with 2 random components"):
        streams(last + 1, "b", "ab")
