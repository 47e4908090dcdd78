"""One metric over trials: mean, deviation, root of the mean square, extremes and quantiles."""

from __future__ import annotations

from typing import Any

import numpy as np

QUANTILES = {"p5": 5, "p50": 50, "p95": 95, "p99": 99}  # %
STATISTICS = ("mean", "std", "rms", "min", *QUANTILES, "max")  # as tables show them
INFINITE = ("inf", "-inf")  # strict JSON has no such numbers


def statistics(values: np.ndarray, unit: str) -> dict[str, Any]:
    """Statistics of ``values`` (trials,).

    ``count`` is of the finite ones, and so are ``mean``, sample deviation ``std``, ``rms``, ``max`` and ``min``.
    Quantiles are over all but nan, infinite ones included, which are then "inf" or "-inf": the least of the
    values that the share of them does not exceed, so each is that of a trial (the inverse of the empirical
    distribution function; Hyndman and Fan 1996, definition 1). What cannot be had from so few values (the
    deviation from one, everything from none) is None.
    """
    finite = values[np.isfinite(values)]
    known = values[~np.isnan(values)]
    some = finite.size > 0
    return {
        "count": int(finite.size),
        "mean": float(np.mean(finite)) if some else None,
        "std": float(np.std(finite, ddof=1)) if finite.size > 1 else None,
        "max": float(np.max(finite)) if some else None,
        "min": float(np.min(finite)) if some else None,
        "rms": float(np.sqrt(np.mean(np.square(finite)))) if some else None,
        **_quantiles(known),
        "unit": unit,
    }


def _quantiles(values: np.ndarray) -> dict[str, float | str | None]:
    if not values.size:
        return dict.fromkeys(QUANTILES)
    shares = [percent / 100.0 for percent in QUANTILES.values()]
    found = np.quantile(values, shares, method="inverted_cdf").tolist()
    return {key: value if np.isfinite(value) else str(value) for key, value in zip(QUANTILES, found, strict=True)}
