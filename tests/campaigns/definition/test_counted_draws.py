"""Draws by a counter, and draws of a table in blocks: permitted dependence of each trial.

Truth: scipy's distributions, numpy's Philox called directly, and the same draws in different blocks.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from perilune.analysis.campaigns.definition.checks import check_plan
from perilune.analysis.campaigns.definition.plan import BatchPlan
from perilune.analysis.campaigns.draws.table import BLOCK, CountedDraws, draw_parts, draw_table
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.bounds import TABLE_TRIALS
from perilune.common.errors import InputError
from tests.support.lengths import either

from .test_draws import ALPHA, DESIGN, PARTS, RANDOM

GRID = '[draw.case]\ndistribution = "grid"\nvalues = [1, 2, 3]\n'


@pytest.fixture(scope="module")
def drawn(campaign):
    return CountedDraws(campaign(GRID + RANDOM, trials=30000, seed=20170700))


def test_values_follow_their_distributions(drawn):
    columns = drawn.of_part(range(20000)).columns
    assert stats.kstest(columns["a"], stats.uniform(-2, 5).cdf).pvalue > ALPHA
    assert stats.kstest(columns["p.b"], stats.norm(5, 2).cdf).pvalue > ALPHA
    counts = [np.sum(columns["c"] == value) for value in (1, 2, 4)]
    assert stats.chisquare(counts, np.array([1, 2, 5]) / 8 * 20000).pvalue > ALPHA
    pair = np.column_stack([columns["u"], columns["v"]]) - [1, -1]
    distance = np.einsum("ki,ij,kj->k", pair, np.linalg.inv([[4, 1.5], [1.5, 1]]), pair)
    assert stats.kstest(distance, stats.chi2(2).cdf).pvalue > ALPHA
    ranks = np.column_stack([stats.rankdata(columns[name]) for name in ("a", "p.b", "u", "c")])
    assert np.abs(np.corrcoef(ranks.T) - np.eye(4)).max() * np.sqrt(20000) < stats.norm.isf(ALPHA / 12)
    following = np.corrcoef(columns["a"][:-BLOCK], columns["a"][BLOCK:])[0, 1]  # the same place of the next block
    assert abs(following) * np.sqrt(20000 - BLOCK) < stats.norm.isf(ALPHA / 2)


@settings(deadline=None, max_examples=either(30, 10))
@given(st.integers(0, 29000), st.integers(1, 3000))
def test_a_trial_is_the_same_in_any_part(drawn, first, count):
    part = range(first, min(first + count, 30000))
    actual, one = drawn.of_part(part), drawn.of_part(range(part[-1], part[-1] + 1))
    assert list(actual.columns) == ["case", "a", "p.b", "u", "v", "c", "s", "p.t", "k"]
    assert {name: column[-1] for name, column in actual.columns.items()} == {
        name: column[0] for name, column in one.columns.items()
    }
    assert actual.columns["case"].tolist() == [trial % 3 + 1 for trial in part]


def test_a_value_is_the_one_of_its_key_and_counter(drawn):
    """Philox with the key of the name, its counter at the block in the highest word, the ninth double of the block."""
    key = np.random.SeedSequence(20170700, spawn_key=tuple(b"a")).generate_state(2, np.uint64)
    source = np.random.Philox(key=key, counter=[2, 0, 0, 7])  # four numbers a count
    words = source.random_raw(1)
    assert drawn.of_part(range(7 * BLOCK + 8, 7 * BLOCK + 9)).columns["a"][0] == -2 + 5 * (int(words[0]) >> 11) * 2**-53


@settings(deadline=None, max_examples=either(20, 6))
@given(st.integers(1, 70))
def test_a_table_in_parts_is_the_table(campaign, size):
    whole = draw_table(campaign("".join(PARTS), trials=64))
    parts = list(draw_parts(campaign("".join(PARTS), trials=64), size))
    for name, column in whole.columns.items():
        assert np.concatenate([part.columns[name] for part in parts]).tolist() == column.tolist(), name


def test_a_table_has_an_end(campaign):
    with pytest.raises(InputError) as caught:
        draw_table(campaign(RANDOM, trials=int(TABLE_TRIALS.default) + 1))
    says = "1000001 trials are requested, but one table of draws has at most 1000000"
    remedy = 'give fewer trials, or write draw_scheme = "counter", which yields different samples'
    assert str(caught.value) == f"test.toml: trials: {says}; {remedy}"


@pytest.mark.parametrize("kind", ["latin_hypercube", "sobol"])
def test_designs_of_all_trials_are_refused(parse, kind):
    head = 'system = "s"\ntrials = 8\nseed = 1\ndraw_scheme = "counter"\n[success]\nexpression = "1"\n'
    plan = BatchPlan("s", parse(head + DESIGN.format("x", kind)), SystemOptions())
    with pytest.raises(InputError) as caught:
        check_plan(plan)
    problem = f'a {kind} needs all trials at once, which draw_scheme = "counter" does not draw'
    assert str(caught.value) == f'test.toml: draw.x: {problem}; use "uniform", or draw_scheme = "table"'


def test_an_unknown_scheme_is_refused(parse):
    with pytest.raises(InputError, match="draw_scheme: 'count' is not known; use one of table, counter"):
        parse('system = "s"\ntrials = 8\nseed = 1\ndraw_scheme = "count"\n[success]\nexpression = "1"\n')
