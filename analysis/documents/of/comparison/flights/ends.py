"""Final errors: final values minus their targets, with statistics and a table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .....campaigns.compare.campaign_comparison import Contender
from .....campaigns.verdicts.order_statistics import quantiles
from ....cell import Cell, Head, Quantity
from ....common.colours import Look
from ....model import Table
from ...campaign.recorded_names import LETTERS, AxisNames, axes_of, find_vector, variable_of, vectors
from ...campaign.variants import variant_cell

UNITS = {"position": "m", "velocity": "m/s"}


@dataclass(frozen=True)
class Target:
    """A target per trial, the value of the parameter ``name``; zero without one."""

    name: str
    values: np.ndarray


@dataclass(frozen=True)
class Ends:
    """Final errors of a variant's simulations: final minus target value, [trials, elements along ``axes``], in SI."""

    signal: str
    variable: str
    target: str
    errors: np.ndarray
    success: np.ndarray
    axes: AxisNames = LETTERS


def target_of(contender: Contender, variable: str) -> Target:
    """Return the parameter target_VARIABLE of a component, with its samples if dispersed; zeros without one."""
    count = len(contender.trials.trial)
    known = {
        name: value
        for name, value in contender.stored.document.get("targets", {}).get(contender.name, {}).items()
        if variable_of(contender.stored.document, name) == f"target_{variable}"
    }
    for base, elements in vectors(known).items():
        plotted = contender.stored.draws
        columns = [plotted.get(name, np.full(count, known[name])) for name in elements]
        return Target(base, np.stack(columns, axis=1).astype(float))
    return Target("", np.zeros((count, 3)))


def ends_of(contender: Contender, variable: str) -> Ends | None:
    """Return final position or velocity minus its target; None if the batch does not store final values."""
    vector = find_vector(contender.stored.document, contender.trials.final, variable, UNITS[variable])
    if vector is None:
        return None
    target = target_of(contender, variable)
    finals = np.stack([contender.trials.final[name] for name in vector], axis=1)
    signal, axes = vector[0].removesuffix("[1]"), axes_of(contender.stored.document, vector)
    return Ends(signal, variable, target.name, finals - target.values, contender.trials.success, axes)


RADII = (0.5, 0.99)  # fractions of the trials that end within the distances shown


@dataclass(frozen=True)
class EndDispersion:
    """Statistics of the final errors of one variant's successful trials, in SI.

    ``mean`` and ``std`` have three elements. ``axes`` are the semi-axes of the horizontal 1-sigma ellipse (longer
    first). ``radii`` are the horizontal distances from the target within which half, 99 % and all of the trials end.
    Each of these is None if there are too few trials.
    """

    count: int
    mean: list[float] | None
    std: list[float] | None
    axes: list[float] | None
    radii: list[float] | None


def dispersion(ends: Ends) -> EndDispersion:
    """Return the statistics of a variant's final errors."""
    good = ends.errors[ends.success & np.all(np.isfinite(ends.errors), axis=1)]
    if not good.size:
        return EndDispersion(0, None, None, None, None)
    miss = np.hypot(good[:, 0], good[:, 1])
    radii = [*quantiles(miss, RADII).tolist(), float(miss.max())]
    mean = good.mean(axis=0).tolist()
    if len(good) < 2:
        return EndDispersion(len(good), mean, None, None, radii)
    axes = np.sqrt(np.maximum(np.linalg.eigvalsh(covariance(good)), 0.0))[::-1].tolist()
    return EndDispersion(len(good), mean, good.std(axis=0, ddof=1).tolist(), axes, radii)


def covariance(good: np.ndarray) -> np.ndarray:
    """Return the sample covariance, (2, 2), of the two horizontal elements."""
    return np.cov(good[:, :2], rowvar=False)


def ellipse(good: np.ndarray, sigma: float) -> np.ndarray:
    """Return points, [2, n], of the ``sigma`` ellipse of the horizontal elements."""
    variances, directions = np.linalg.eigh(covariance(good))
    angle = np.linspace(0.0, 2.0 * np.pi, 73)
    circle = np.sqrt(np.maximum(variances, 0.0))[:, np.newaxis] * np.stack([np.cos(angle), np.sin(angle)])
    return good[:, :2].mean(axis=0)[:, np.newaxis] + sigma * directions @ circle


def select_ends(ends: Ends) -> tuple[np.ndarray, np.ndarray]:
    """Return the finite errors of successful and of failed trials."""
    finite = np.all(np.isfinite(ends.errors), axis=1)
    return ends.errors[finite & ends.success], ends.errors[finite & ~ends.success]


DIGITS = 3


def dispersion_table(ends: Mapping[str, Ends], styles: Mapping[str, Look]) -> Table:
    """Return a row for each variant, over its successful trials."""
    first = next(iter(ends.values()))
    unit = UNITS[first.variable]
    heads = (
        "variant",
        "trials",
        Head(f"mean, {unit}", below=first.axes),
        Head(f"std, {unit}", below=first.axes),
        Head(f"1\N{GREEK SMALL LETTER SIGMA} ellipse, {unit}", below=("long", "short")),
        Head(f"horizontal miss, {unit}", below=("50 %", "99 %", "max")),
    )
    return Table(heads, [_row(label, each, styles) for label, each in ends.items()], style="tight")


def _row(label: str, ends: Ends, styles: Mapping[str, Look]) -> list[Cell]:
    of_all = dispersion(ends)
    numbers: list[float | None] = []
    for values, size in ((of_all.mean, 3), (of_all.std, 3), (of_all.axes, 2), (of_all.radii, 3)):
        numbers += [None] * size if values is None else values
    return [variant_cell(label, styles), of_all.count, *(Quantity(each, digits=DIGITS) for each in numbers)]
