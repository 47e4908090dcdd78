"""`perilune.fmus_src.mathlib.rng`: random numbers of the published generator.

Truth: the recurrences of MRG32k3a (L'Ecuyer 1999) in exact Python integers; its streams and substreams (L'Ecuyer,
Simard, Chen and Kelton 2002) as powers 2^127 and 2^76 of the transition matrices, computed here in integers from the
recurrences; numbers printed by the RngStreams package for its default seed. Tolerance: equality to the last bit;
published decimals to half a unit of their last digit. Distributions and independence are tested at fixed seeds, at a
level at which a correct generator fails for one seed in a thousand.
"""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy import stats

from perilune.fmus_src.mathlib.rng import M1, M2, combine, normal, normals, reduce_modulo, seed_streams, uniform
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.checks.mrg32k3a import P1, P2, advanced, exact_numerator
from tests.support.lengths import either

RISK = 1e-3


def seeded(seed, stream):
    state = [0.0] * 6
    seed_streams(state, seed, stream)
    return state


def draws(seed, stream, count, draw=uniform):
    state = seeded(seed, stream)
    return np.array([draw(state) for _ in range(count)])


def test_moduli_are_the_published_ones():
    assert (M1, M2) == (P1, P2)


@pytest.mark.parametrize(("seed", "stream"), [(0, 0), (3, 0), (0, 5), (123456, 789)])
def test_every_number_is_the_exact_recurrences(seed, stream):
    state = seeded(seed, stream)
    exact = [int(value) for value in state]
    for _ in range(2000):
        number = uniform(state)
        assert number == exact_numerator(exact) * 2.328306549295727688e-10
        assert state == exact


@pytest.mark.parametrize(
    "exact",
    [
        [P1 - 1, P1 - 1, P1 - 1, P2 - 1, P2 - 1, P2 - 1],
        [P1 - 1, 0, 1, P2 - 1, 0, 1],
        [0, P1 - 1, 1, 0, 1, P2 - 1],
        [0, 0, 1, 0, 0, 1],
        [1, 0, 0, 1, 0, 0],
    ],
)
def test_extreme_states_lose_no_bit(exact):
    state = [float(value) for value in exact]
    for _ in range(50):
        assert uniform(state) == exact_numerator(exact) * 2.328306549295727688e-10
        assert state == exact


def test_first_numbers_from_the_default_seed_are_the_published_ones():
    published = [0.12701112204657714, 0.3185275653967945, 0.3091860155832701, 0.8258468629271136, 0.2216299157820229]
    numbers = draws(0, 0, 1000)
    assert numbers[:5] == pytest.approx(published, abs=5e-17)
    assert numbers[999] == pytest.approx(0.98607848680213228, abs=5e-17)


@pytest.mark.parametrize(
    ("seed", "stream", "published"),
    [
        (0, 0, [12345] * 6),
        (1, 0, [3692455944, 1366884236, 2968912127, 335948734, 4161675175, 475798818]),
        (2, 0, [1015873554, 1310354410, 2249465273, 994084013, 2912484720, 3876682925]),
        (3, 0, [2338701263, 1119171942, 2570676563, 317077452, 3194180850, 618832124]),
        (0, 1, [870504860, 2641697727, 884013853, 339352413, 2374306706, 3651603887]),
    ],
)
def test_first_states_of_streams_are_the_published_ones(seed, stream, published):
    assert seeded(seed, stream) == published


@given(st.integers(0, 2**63 - 1), st.integers(0, 2**63 - 1))
@example(2**63 - 1, 2**63 - 1)
@settings(max_examples=either(40, 10), deadline=None)
def test_streams_are_jumps_of_the_recurrences(seed, stream):
    assert seeded(seed, stream) == advanced([12345] * 6, seed * 2**127 + stream * 2**76)


WORDS = st.lists(st.integers(-(2**31), 2**32), min_size=3, max_size=3)


@given(WORDS, WORDS, WORDS, WORDS, st.sampled_from([P1, P2]))
@example([2**32] * 3, [2**32] * 3, [2**32] * 3, [2**32] * 3, P1)
@example([-(2**31)] * 3, [2**32] * 3, [2**32] * 3, [2**32] * 3, P2)
@settings(max_examples=either(300, 25), deadline=None)
def test_sums_of_products_are_exact(s, a, b, c, modulus):
    actual = combine(*(vector(*map(float, words)) for words in (s, a, b, c)), float(modulus))
    exact = [s[0] * a[i] + s[1] * b[i] + s[2] * c[i] for i in range(3)]
    assert [int(number) % modulus for number in actual] == [number % modulus for number in exact]
    assert max(map(abs, actual)) <= (modulus + 1) // 2


@given(st.integers(-(2**20), 2**20), st.sampled_from([P1, P2]), st.integers(-2, 2))
@settings(max_examples=either(300, 25), deadline=None)
def test_residues_are_exact_beside_multiples_of_the_modulus(multiple, modulus, offset):
    high, low = divmod(multiple * modulus + offset, 2**16)
    assert reduce_modulo(float(high), float(low), float(modulus)) == offset


def test_uniform_numbers_stay_inside_zero_and_one():
    assert 0.0 < 1.0 * 2.328306549295727688e-10
    assert P1 * 2.328306549295727688e-10 < 1.0  # the largest numerator
    numbers = draws(5, 0, 20000)
    assert numbers.min() > 0.0
    assert numbers.max() < 1.0


def test_uniform_numbers_are_uniform():
    numbers = draws(11, 0, 50000)
    assert stats.kstest(numbers, "uniform").pvalue > RISK
    cells = np.histogram(numbers, bins=256, range=(0.0, 1.0))[0]
    assert stats.chisquare(cells).pvalue > RISK


def test_successive_pairs_and_triples_fill_their_cubes():
    numbers = draws(12, 0, 60000)
    for dimension, cells in ((2, 16), (3, 8)):
        points = numbers[: len(numbers) // dimension * dimension].reshape(-1, dimension)
        counts = np.histogramdd(points, bins=cells, range=[(0.0, 1.0)] * dimension)[0]
        assert stats.chisquare(counts.ravel()).pvalue > RISK


def test_normal_number_is_box_and_mullers_of_two_exact_uniforms():
    state = seeded(7, 3)
    exact = [int(value) for value in state]
    for _ in range(200):
        radius = exact_numerator(exact) / (P1 + 1)
        angle = exact_numerator(exact) / (P1 + 1)
        assert normal(state) == pytest.approx(
            math.sqrt(-2.0 * math.log(radius)) * math.cos(2.0 * math.pi * angle), rel=1e-12, abs=1e-14
        )
        assert state == exact


def test_three_normal_numbers_are_the_next_three():
    one, other = seeded(7, 3), seeded(7, 3)
    assert list(normals(one)) == [normal(other) for _ in range(3)]
    assert one == other


def test_normal_numbers_are_standard_normal():
    count = 50000
    numbers = draws(13, 0, count, normal)
    assert stats.kstest(numbers, "norm").pvalue > RISK
    assert stats.normaltest(numbers).pvalue > RISK
    z = stats.norm.ppf(1.0 - RISK / 2.0)
    assert abs(numbers.mean()) < z / math.sqrt(count)
    assert stats.chi2.ppf(RISK / 2, count) < (numbers**2).sum() < stats.chi2.ppf(1 - RISK / 2, count)


def test_successive_numbers_are_uncorrelated():
    count = 20000
    numbers = draws(14, 0, count, normal)
    lagged = [float(numbers[:-lag] @ numbers[lag:]) / math.sqrt(count - lag) for lag in range(1, 21)]
    assert stats.chi2.sf(np.square(lagged).sum(), 20) > RISK


def test_streams_and_substreams_are_independent_of_each_other():
    length = 2000
    names = [(seed, stream) for seed in range(5) for stream in range(4)]
    table = np.array([draws(seed, stream, length, normal) for seed, stream in names])
    correlation = np.corrcoef(table)[np.triu_indices(len(names), 1)]
    assert stats.chi2.sf(length * np.square(correlation).sum(), len(correlation)) > RISK
    cells = np.histogram2d(
        stats.norm.cdf(table[0::2].ravel()), stats.norm.cdf(table[1::2].ravel()), bins=10, range=[(0, 1), (0, 1)]
    )[0]
    assert stats.chisquare(cells.ravel()).pvalue > RISK


def test_first_numbers_of_neighbouring_streams_are_uniform():
    for first_numbers in (
        [uniform(seeded(seed, 0)) for seed in range(1500)],
        [uniform(seeded(1, stream)) for stream in range(1500)],
    ):
        assert stats.kstest(first_numbers, "uniform").pvalue > RISK
        ranks = np.argsort(np.argsort(first_numbers))
        assert stats.pearsonr(ranks[:-1], ranks[1:]).pvalue > RISK
