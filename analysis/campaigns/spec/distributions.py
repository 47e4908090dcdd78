"""What a campaign may draw from: the distributions and the arguments each takes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..draws.declared import Draw
from .toml.table import Table, choice_of, integer, names, number, sequence

NUMBERS = sequence(number)
MATRIX = sequence(NUMBERS)


def _interval(table: Table) -> dict[str, Any]:
    low, high = table.get("low", number), table.get("high", number)
    if not low < high:
        raise table.error("high", f"{high!r} is not above low = {low!r}", "give low < high, or fix the value in [set]")
    return {"low": low, "high": high}


def _normal(table: Table) -> dict[str, Any]:
    mean, sigma = table.get("mean", number), table.get("sigma", number)
    if not sigma > 0.0:
        raise table.error("sigma", f"{sigma!r} is not positive", "give sigma > 0, or fix the value in [set]")
    return {"mean": mean, "sigma": sigma}


def _correlated_normal(table: Table) -> dict[str, Any]:
    filled = table.get("names", names)
    mean, covariance = table.get("mean", NUMBERS), table.get("covariance", MATRIX)
    size = len(filled)
    if len(mean) != size:
        raise table.error("mean", f"{len(mean)} value(s) for {size} name(s)", "give one mean per name")
    if len(covariance) != size or any(len(row) != size for row in covariance):
        raise table.error("covariance", f"not {size} by {size}", "give one row and one column per name")
    matrix = np.array(covariance)
    if not np.allclose(matrix, matrix.T, rtol=1e-12, atol=0.0):
        raise table.error("covariance", "not symmetric", "give the same value at [i][j] and [j][i]")
    values = np.linalg.eigvalsh(matrix)
    if values[0] < -1e-12 * abs(values[-1]) or not values[-1] > 0.0:
        problem = f"not a covariance: its eigenvalues go from {values[0]:.3g} to {values[-1]:.3g}"
        raise table.error("covariance", problem, "give a matrix without negative eigenvalues that is not zero")
    return {"mean": mean, "covariance": covariance}


def _choice(table: Table) -> dict[str, Any]:
    values = table.get("values", NUMBERS)
    weights = table.get("weights", NUMBERS, (1.0,) * len(values))
    if len(weights) != len(values):
        raise table.error("weights", f"{len(weights)} weight(s) for {len(values)} value(s)", "give one per value")
    if min(weights) < 0.0 or not sum(weights) > 0.0:
        raise table.error("weights", "negative, or all zero", "give weights >= 0 with a positive sum")
    return {"values": values, "weights": weights}


def _grid(table: Table) -> dict[str, Any]:
    if "values" in table.content:
        table.only(["distribution", "values"])
        return {"values": table.get("values", NUMBERS)}
    count = table.get("count", integer)
    if count < 2:
        raise table.error("count", f"{count} point(s)", "give 2 or more, both ends included")
    ends = _interval(table)
    return {"values": tuple(np.linspace(ends["low"], ends["high"], count).tolist())}


# distribution: (keys it takes, reader of them)
DISTRIBUTIONS: dict[str, tuple[tuple[str, ...], Callable[[Table], dict[str, Any]]]] = {
    "uniform": (("low", "high"), _interval),
    "normal": (("mean", "sigma"), _normal),
    "correlated_normal": (("names", "mean", "covariance"), _correlated_normal),
    "choice": (("values", "weights"), _choice),
    "grid": (("values", "low", "high", "count"), _grid),
    "latin_hypercube": (("low", "high"), _interval),
    "sobol": (("low", "high"), _interval),
}


def read_draw(name: str, table: Table) -> Draw:
    """The draw declared in the table [draw.NAME]. Raises InputError."""
    distribution = table.get("distribution", choice_of(*DISTRIBUTIONS))
    keys, read = DISTRIBUTIONS[distribution]
    table.only(["distribution", *keys])
    arguments = read(table)
    filled = table.get("names", names) if distribution == "correlated_normal" else (name,)
    return Draw(name, distribution, filled, arguments)
