"""Output feedback u = F y by direct or dual placement, with a choice of the distribution of poles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from enum import StrEnum
from itertools import islice

import numpy as np
from numpy.typing import ArrayLike

from ....common.errors import InputError, suggestion
from .plant import input_matrix, output_matrix, state_matrix
from .results import OutputFeedback, PlacementError, Reason
from .smallest import minimise_gain
from .spectrum import Spectrum
from .zeroth_level import ZerothLevel, place_direct, place_square


class DecomposedPlant(StrEnum):
    """Plant that is decomposed into levels: direct or dual."""

    DIRECT = "direct"  # (A, B, C): the upper level takes n - m poles
    DUAL = "dual"  # (A', C', B'), F transposed: n - p poles


class Spread(StrEnum):
    """Criterion for the distribution of poles over the levels."""

    FIRST = "first"  # the first that applies
    LEAST_NORM = "least_norm"  # the smallest |F| of all
    SMALLEST = "smallest"  # the smallest found from there among all F with the poles


def output_feedback(
    a: ArrayLike,
    b: ArrayLike,
    c: ArrayLike,
    poles: ArrayLike,
    *,
    method: str | None = None,
    choice: str = Spread.FIRST,
    upper: ArrayLike | None = None,
    starts: int = 20,
    seed: int = 0,
) -> OutputFeedback:
    """Return the gain F (m, p) of **u = F y** that gives A + B F C the poles, for m + p >= n.

    ``a`` is A (n, n), ``b`` B (n, m), ``c`` C (p, n), of full ranks; ``poles`` as in `place`. ``method`` is direct or
    dual, by default both are tried. ``upper`` are the poles of the upper level: n - m for the direct plant, n - p for
    the dual. Without it ``choice`` selects the distribution of poles: ``first`` takes the first that applies,
    ``least_norm`` the one with the smallest |F| among all real distributions, and ``smallest`` continues from there
    with a search in the set of all F with these poles, which has m p - n dimensions. For m + p > n generic plants have
    a solution; for m + p = n a solution is searched from ``starts`` starts. Raises InputError; PlacementError, with the
    reason for the last distribution, if none applies.
    """
    state = state_matrix(a)
    plant = state, input_matrix(b, len(state)), output_matrix(c, len(state))
    spectrum = Spectrum.of(poles, len(state))
    if method not in (None, *DecomposedPlant):
        raise InputError("modal", f"method {method!r}", "unknown", suggestion(str(method), DecomposedPlant))
    if choice not in [*Spread]:
        raise InputError("modal", f"choice {choice!r}", "unknown", suggestion(choice, Spread))
    if upper is not None and method is None:
        raise InputError(
            "modal", "upper", "the number of upper poles depends on the method", "give method direct or dual"
        )
    if starts < 1:
        raise InputError("modal", "starts", f"{starts} starts", "give 1 or more")
    _check_class(len(state), plant[1].shape[1], len(plant[2]))
    refusals: list[PlacementError] = []
    placements = _placements(*plant, spectrum, method, upper, starts, seed, refusals)
    tried = [*islice(placements, 1)] if choice == Spread.FIRST else [*placements]
    if not tried and refusals:
        raise refusals[-1]
    if not tried:
        problem = (
            f"{len(spectrum.pairs)} conjugate pairs and {len(spectrum.real)} real poles cannot be distributed "
            "over the levels without splitting a pair"
        )
        remedy = "use the other method, or replace a pair by two real poles"
        raise PlacementError("output feedback", Reason.SPREAD, problem, len(spectrum.pairs), remedy)
    return minimise_gain(tried, *plant) if choice == Spread.SMALLEST else min(tried, key=lambda one: one.norm)


def _placements(
    a: np.ndarray,
    b: np.ndarray,
    c: np.ndarray,
    spectrum: Spectrum,
    method: str | None,
    upper: ArrayLike | None,
    starts: int,
    seed: int,
    refusals: list[PlacementError],
) -> Iterator[OutputFeedback]:
    """Yield placements, direct before dual; append to ``refusals`` the reasons for distributions that do not apply."""
    for route, plant in ((DecomposedPlant.DIRECT, (a, b, c)), (DecomposedPlant.DUAL, (a.T, c.T, b.T))):
        if method not in (None, route):
            continue
        level = ZerothLevel(*plant)
        size = len(level.down)
        named = None if upper is None else Spectrum.of(upper, size, "upper")
        for high, low in spectrum.splits(size) if named is None else [(named, spectrum.without(named))]:
            try:
                placed = (
                    place_square(level, high, low, starts, seed) if level.is_exact else place_direct(level, high, low)
                )
            except PlacementError as error:
                refusals.append(error)
                continue
            if route is DecomposedPlant.DUAL:
                placed = replace(placed, method=route, gain=placed.gain.T, closed_loop=placed.closed_loop.T)
            yield placed


def _check_class(states: int, inputs: int, outputs: int) -> None:
    sizes = f"n = {states} states, m = {inputs} inputs, p = {outputs} outputs"
    for number, problem in (
        (inputs + outputs, f"m + p = {inputs + outputs} must not be less than n"),
        (inputs * outputs, f"F has m p = {inputs * outputs} elements, too few to place n poles"),
    ):
        if number < states:
            remedy = "measure more outputs, or use an observer"
            raise PlacementError("output feedback", Reason.CLASS, f"{sizes}: {problem}", number, remedy)
