"""State feedback u = -K x: placement methods by name, automatic choice of a method, and parametrised sets of gains."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from enum import StrEnum
from typing import TypedDict

import numpy as np
from numpy.typing import ArrayLike

from ....common.errors import InputError, suggestion
from .ackermann import ackermann, ackermann_of, bass_gura, coefficients_of
from .controllability import TOLERANCE, indices
from .freedom import least_condition, least_norm
from .multilevel import decompose, multilevel, place_on_levels
from .plant import input_matrix, real_matrix, state_matrix
from .results import PlacementError, Reason, StateFeedback
from .spectrum import Spectrum

_ONE_CLASS: dict[str, Callable[[np.ndarray, np.ndarray, Spectrum], StateFeedback]] = {
    "ackermann": ackermann,
    "bass_gura": bass_gura,
}
_EVERY_PAIR: dict[str, Callable[[np.ndarray, np.ndarray, Spectrum, float], StateFeedback]] = {
    "indices": indices,
    "multilevel": multilevel,
}
METHODS = (*_ONE_CLASS, *_EVERY_PAIR)
STARTS = 8
_ORTHONORMAL = 1e-9


class FreedomUse(StrEnum):
    """Criterion that determines the freedom left by several inputs."""

    DIAGONAL = "diagonal"  # freedom unused: diagonal matrices, blocks for pairs
    LEAST_CONDITION = "least_condition"  # least condition number of the eigenvectors
    LEAST_NORM = "least_norm"  # least norm of the gain


class PlaceOptions(TypedDict, total=False):
    """Options of `place`."""

    method: str | None
    choice: str
    tolerance: float | None
    starts: int
    seed: int


def place(
    a: ArrayLike,
    b: ArrayLike,
    poles: ArrayLike,
    *,
    method: str | None = None,
    choice: str = FreedomUse.DIAGONAL,
    tolerance: float | None = None,
    starts: int = STARTS,
    seed: int = 0,
) -> StateFeedback:
    """Return the gain K (m, n) of **u = -K x** that gives A - B K the poles, as in scipy and python-control.

    ``a`` is A (n, n), ``b`` B (n, m) of x' = A x + B u, or of a sampled plant; ``poles`` are n real or complex numbers
    (1/s, or multipliers), closed under conjugation, with repeated ones repeated. ``method`` is ackermann, bass_gura,
    indices or multilevel; by default multilevel if every conjugate pair fits on a level, else indices; ``method`` of
    the result names the method used. ``choice`` is diagonal, least_condition (of the eigenvectors: least sensitive
    poles) or least_norm (of K), found by ``starts`` searches with ``seed`` and placed by multilevel. The methods
    indices and multilevel ignore a new direction that is smaller than ``tolerance`` (by default 1e-9) relative to the
    matrices from which it is computed, so the units of these matrices matter. Raises InputError; PlacementError if a
    method does not apply.
    """
    state = state_matrix(a)
    inputs = input_matrix(b, len(state))
    spectrum = Spectrum.of(poles, len(state))
    if method is not None and method not in METHODS:
        raise InputError("modal", f"method {method!r}", "unknown", suggestion(method, METHODS))
    if choice not in [*FreedomUse]:
        raise InputError("modal", f"choice {choice!r}", "unknown", suggestion(choice, FreedomUse))
    if choice != FreedomUse.DIAGONAL:
        if method not in (None, "multilevel"):
            raise InputError(
                "modal", f"choice {choice!r}", f"method {method} has no such option", "use method multilevel"
            )
        if starts < 1:
            raise InputError("modal", "starts", f"{starts} starts", "give 1 or more")
        search = least_condition if choice == FreedomUse.LEAST_CONDITION else least_norm
        return search(state, inputs, spectrum, starts, seed, _above(tolerance))
    if method in _ONE_CLASS:
        if tolerance is not None:
            raise InputError(
                "modal", "tolerance", f"method {method} has no such option", "use method indices or multilevel"
            )
        return _ONE_CLASS[method](state, inputs, spectrum)
    solver = _EVERY_PAIR[method] if method else make_placement
    return solver(state, inputs, spectrum, _above(tolerance))


def make_placement(a: np.ndarray, b: np.ndarray, spectrum: Spectrum, tolerance: float = TOLERANCE) -> StateFeedback:
    """Place poles by the method that applies. Raises PlacementError for a pair that is not controllable."""
    try:
        return multilevel(a, b, spectrum, tolerance)
    except PlacementError as error:
        if error.reason is not Reason.SPREAD:
            raise
        return indices(a, b, spectrum, tolerance)


def place_levels(
    a: ArrayLike,
    b: ArrayLike,
    matrices: Sequence[ArrayLike],
    *,
    bases: Sequence[ArrayLike] | None = None,
    tolerance: float | None = None,
) -> StateFeedback:
    """Return the gain K of u = -K x from the required matrix Phi_i of each level of the multilevel decomposition.

    ``matrices`` are real, (r_i, r_i), level 0 (driven by the inputs) first. ``bases`` (n, r_i) are orthonormal columns
    that span the levels. In these coordinates z of a level the closed loop is z' = Phi_i z, driven only from the level
    below; for x = (angles, rates), for example, the bases are [I[:, 3:], I[:, :3]]. By default the bases are from
    singular value decompositions, and K is then unique only if each Phi_i is a multiple of I. ``tolerance`` is as in
    `place`. Raises InputError and PlacementError.
    """
    state = state_matrix(a)
    inputs = input_matrix(b, len(state))
    if bases is None:
        levels = decompose(state, inputs, _above(tolerance))
    else:
        checked = [real_matrix(f"bases[{i}]", basis) for i, basis in enumerate(bases)]
        turn = _whole(checked, len(state))
        levels = decompose(
            turn.T @ state @ turn, turn.T @ inputs, _above(tolerance), [basis.shape[1] for basis in checked]
        )
    if len(matrices) != len(levels):
        ranks = ", ".join(str(level.rank) for level in levels)
        raise InputError(
            "modal",
            "matrices",
            f"{len(matrices)} matrices",
            f"give one square matrix for each level, of orders {ranks}",
        )
    sizes = [(level.rank, level.rank) for level in levels]
    desired = [
        real_matrix(f"matrices[{i}]", phi, size) for i, (phi, size) in enumerate(zip(matrices, sizes, strict=True))
    ]
    feedback = place_on_levels(levels, desired, np.concatenate([np.linalg.eigvals(phi) for phi in desired]))
    if bases is None:
        return feedback
    gain = feedback.gain @ turn.T
    return replace(feedback, gain=gain, closed_loop=state - inputs @ gain)


def place_polynomial(a: ArrayLike, b: ArrayLike, coefficients: Sequence[ArrayLike] | np.ndarray) -> StateFeedback:
    """Return the gain K of u = -K x with det(s I - A + B K) = det(I s^p + N_(p-1) s^(p-1) + .. + N_0), n = p m.

    ``coefficients`` are the N_i (p, m, m), N_0 first, of the generalised Ackermann formula. Raises InputError and
    PlacementError.
    """
    state = state_matrix(a)
    inputs = input_matrix(b, len(state))
    size = inputs.shape[1]
    shape = (len(state) // size, size, size)
    return ackermann_of(state, inputs, real_matrix("coefficients", coefficients, shape))


def polynomial_of_gain(a: ArrayLike, b: ArrayLike, gain: ArrayLike) -> np.ndarray:
    """Return the N (p, m, m) for which `place_polynomial` gives this K (m, n). Raises InputError and PlacementError."""
    state = state_matrix(a)
    inputs = input_matrix(b, len(state))
    return coefficients_of(state, inputs, real_matrix("K", gain, inputs.T.shape))


def _above(tolerance: float | None) -> float:
    if tolerance is None:
        return TOLERANCE
    if not 0.0 < tolerance < 1.0:
        raise InputError("modal", "tolerance", f"{tolerance:g} is not between 0 and 1", "give a number in between")
    return tolerance


def _whole(bases: Sequence[np.ndarray], states: int) -> np.ndarray:
    """Return the bases concatenated, as an orthonormal basis of the state space."""
    if all(len(basis) == states for basis in bases) and sum(basis.shape[1] for basis in bases) == states:
        whole = np.hstack(bases)
        if np.max(np.abs(whole.T @ whole - np.eye(states))) <= _ORTHONORMAL:
            return whole
    raise InputError(
        "modal", "bases", "together they are not an orthonormal basis of the state space", "orthonormalise them"
    )
