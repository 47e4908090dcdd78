"""Shibanov's variance score: how much of a disturbance is left in the tracking error.

Source: G. P. Shibanov 2017, a variance method of scoring how well an operator controls a
vehicle; the article prints no coefficients, the interval is ours.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import DegenerateDataWarning, bootstrap

from ..errors import InputError

FEWEST_PIECES = 10
WHERE = "variance score"


@dataclass(frozen=True)
class VarianceScore:
    """Score and its interval; units are those of error squared over disturbance squared.

    ``score`` = ``error_variance`` / ``disturbance_variance``; 0 is perfect control, 1 (in equal
    units) does nothing. ``low`` and ``high`` hold the score with probability ``confidence``.
    """

    score: float
    low: float
    high: float
    confidence: float
    pieces: int
    error_variance: float
    disturbance_variance: float


def split_blocks(values: np.ndarray, rows: int) -> list[np.ndarray]:
    """One long recording (rows,) as consecutive pieces of at least ``rows`` rows each, none left out.

    Choose ``rows`` of ten correlation times of the error or more, so that pieces hardly depend
    on each other. Raises InputError where the recording is shorter than one piece.
    """
    if not 1 <= rows <= len(values):
        problem = f"{rows} row(s) per piece of a recording of {len(values)}"
        raise InputError(WHERE, "rows", problem, f"use 1 to {len(values)}")
    return np.array_split(values, len(values) // rows)


def _check(errors: Sequence[np.ndarray], disturbances: Sequence[np.ndarray]) -> None:
    """Refuse pieces that cannot be scored."""
    if [np.shape(piece) for piece in errors] != [np.shape(piece) for piece in disturbances]:
        raise InputError(WHERE, "errors, disturbances", "pieces do not match", "give pairs of equal length")
    if len(errors) < FEWEST_PIECES:
        problem = f"{len(errors)} piece(s) are too few for an interval"
        raise InputError(WHERE, "errors", problem, f"give {FEWEST_PIECES} or more trials or blocks")
    for name, pieces in (("errors", errors), ("disturbances", disturbances)):
        if not all(len(piece) and np.isfinite(piece).all() for piece in pieces):
            raise InputError(WHERE, name, "a piece is empty or not finite", "leave out trials that ended so")
    if np.ptp(np.concatenate(disturbances)) == 0.0:
        raise InputError(WHERE, "disturbances", "the disturbance does not vary", "score runs that have one")


def variance_score(
    errors: Sequence[np.ndarray],
    disturbances: Sequence[np.ndarray],
    *,
    confidence: float = 0.95,
    resamples: int = 9999,
    seed: int = 0,
) -> VarianceScore:
    """Variance of the tracking error over variance of the disturbance, with its interval.

    ``errors`` and ``disturbances`` hold one array (rows,) per piece, of equal length in pairs: a
    piece is one trial, or a block of one long recording (`split_blocks`). Variances are about
    the means over all pieces, so a constant offset does not count. The interval is the BCa
    bootstrap over whole pieces (Efron 1987). It assumes that pieces are independent and alike;
    within a piece error and disturbance may be correlated in any way and need be neither normal
    nor stationary. Raises InputError for pieces that do not match, too few of them, values that
    are not finite, or a disturbance that does not vary.
    """
    _check(errors, disturbances)
    error_mean = np.mean(np.concatenate(errors))
    disturbance_mean = np.mean(np.concatenate(disturbances))

    # per piece: rows, and sum and sum of squares of both about the overall means, all that variances need
    sums = np.array(
        [
            (len(e), np.sum(e), np.sum(e * e), np.sum(d), np.sum(d * d))
            for e, d in ((e - error_mean, d - disturbance_mean) for e, d in zip(errors, disturbances, strict=True))
        ]
    ).T

    def variances(*columns: np.ndarray, axis: int = -1) -> tuple[np.ndarray, np.ndarray]:
        rows, e, ee, d, dd = (np.sum(column, axis=axis) for column in columns)
        return ee / rows - (e / rows) ** 2, dd / rows - (d / rows) ** 2

    error_variance, disturbance_variance = (float(variance) for variance in variances(*sums))

    def ratio(*columns: np.ndarray, axis: int = -1) -> np.ndarray:
        error, disturbance = variances(*columns, axis=axis)
        # nan where a resample holds pieces without disturbance only, up to rounding
        return error / np.where(disturbance > 1e-12 * disturbance_variance, disturbance, np.nan)

    with warnings.catch_warnings(), np.errstate(divide="ignore", invalid="ignore"):
        warnings.simplefilter("ignore", DegenerateDataWarning)  # both ways this can happen are dealt with below
        result = bootstrap(
            tuple(sums),
            ratio,
            paired=True,
            vectorized=True,
            n_resamples=resamples,
            batch=max(1, 1_000_000 // len(errors)),
            confidence_level=confidence,
            method="BCa",
            rng=np.random.default_rng(seed),
        )
    score = error_variance / disturbance_variance
    low, high = float(result.confidence_interval.low), float(result.confidence_interval.high)
    if np.ptp(result.bootstrap_distribution) == 0.0:
        low = high = score  # every resample gives the same score, where BCa has nothing to estimate from
    if not np.isfinite([low, high]).all():
        problem = "the disturbance varies in too few of the pieces"
        raise InputError(WHERE, "disturbances", problem, "give more pieces, or longer ones")
    return VarianceScore(score, low, high, confidence, len(errors), error_variance, disturbance_variance)
