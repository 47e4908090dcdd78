"""perilune.analysis.batch.variance_score against closed forms and by counting its interval's coverage."""

import numpy as np
import pytest
from scipy import signal

from perilune.analysis.batch.variance_score import split_blocks, variance_score
from perilune.analysis.errors import InputError


def test_a_pure_gain_scores_its_square_without_doubt():
    disturbances = list(np.random.default_rng(1).standard_normal((20, 50)))
    found = variance_score([0.5 * d for d in disturbances], disturbances)
    assert (found.score, found.low, found.high) == pytest.approx((0.25, 0.25, 0.25))
    assert found.pieces == 20


def test_score_is_the_ratio_of_pooled_variances_and_ignores_offsets():
    rng = np.random.default_rng(2)
    errors = [rng.standard_normal(rows) for rows in range(20, 40)]
    disturbances = [3 * rng.standard_normal(rows) for rows in range(20, 40)]
    found = variance_score([e + 7 for e in errors], [d - 2 for d in disturbances])
    assert found.error_variance == pytest.approx(np.var(np.concatenate(errors)))
    assert found.disturbance_variance == pytest.approx(np.var(np.concatenate(disturbances)))
    assert found.score == pytest.approx(found.error_variance / found.disturbance_variance)
    assert found.low < found.score < found.high


def test_interval_agrees_with_the_f_interval_where_that_holds():
    # independent normal samples: score / truth is F-distributed; its logarithm has deviation sqrt(2/n + 2/n)
    rng = np.random.default_rng(3)
    pieces, rows = 500, 40
    found = variance_score(list(rng.standard_normal((pieces, rows))), list(rng.standard_normal((pieces, rows))))
    width = 2 * 1.96 * np.sqrt(4 / (pieces * rows))
    assert np.log(found.high / found.low) == pytest.approx(width, rel=0.1)


def test_interval_covers_the_truth_of_a_closed_loop():
    # error e[k+1] = 0.9 e[k] + d[k] under white d: var e / var d = 1 / (1 - 0.81), samples far from independent
    truth = 1 / (1 - 0.9**2)
    rng = np.random.default_rng(4)
    covered = 0
    for _ in range(200):
        d = rng.standard_normal((25, 400))
        e = signal.lfilter([0, 1], [1, -0.9], d, axis=1)[:, 100:]
        found = variance_score(list(e), list(d[:, 100:]), resamples=999)
        covered += found.low <= truth <= found.high
    assert 0.88 <= covered / 200 <= 0.99


def test_blocks_of_one_recording_score_like_trials():
    rng = np.random.default_rng(5)
    d = rng.standard_normal(60000)
    e = signal.lfilter([0, 1], [1, -0.9], d)
    blocks = variance_score(split_blocks(e, 200), split_blocks(d, 200))
    trials = variance_score(list(e.reshape(100, 600)), list(d.reshape(100, 600)))
    assert blocks.score == pytest.approx(trials.score, rel=1e-12)
    assert blocks.high - blocks.low == pytest.approx(trials.high - trials.low, rel=0.25)


def test_blocks_leave_no_row_out():
    blocks = split_blocks(np.arange(103.0), 10)
    assert np.concatenate(blocks).tolist() == list(range(103))
    assert min(map(len, blocks)) >= 10
    with pytest.raises(InputError, match="use 1 to 103"):
        split_blocks(np.arange(103.0), 104)


def test_is_reproducible():
    rng = np.random.default_rng(6)
    errors, disturbances = list(rng.random((12, 9))), list(rng.random((12, 9)))
    assert variance_score(errors, disturbances, seed=3) == variance_score(errors, disturbances, seed=3)
    assert variance_score(errors, disturbances, seed=3) != variance_score(errors, disturbances, seed=4)


GOOD = [np.arange(5.0)] * 10


@pytest.mark.parametrize(
    ("errors", "disturbances", "says"),
    [
        (GOOD, GOOD[:9], "pieces do not match"),
        (GOOD, [np.arange(4.0)] * 10, "pieces do not match"),
        (GOOD[:9], GOOD[:9], "too few"),
        ([np.full(5, np.nan)] * 10, GOOD, "errors: a piece is empty or not finite"),
        ([np.array([])] * 10, [np.array([])] * 10, "empty"),
        (GOOD, [np.full(5, 0.1)] * 10, "does not vary"),
        (GOOD, [np.ones(5)] * 9 + [np.arange(5.0)], "varies in too few"),
    ],
)
def test_what_cannot_be_scored_is_refused(errors, disturbances, says):
    with pytest.raises(InputError, match=says):
        variance_score(errors, disturbances)
