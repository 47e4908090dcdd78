"""Exact placement by multilevel decomposition: any controllable pair, any multiplicity.

Level 0 is the pair (A, B). On every level B = Bt R with full-rank factors, and P with orthonormal rows and P Bt = 0;
the next level is (P A P', P A Bt), until B has full row rank. Going back, the last level has B^- = Bt^+, the others B^-
= Bt^+ - K P, where K is the gain of the level above, and

    K = R^+ (Phi B^- - B^- A),    u = K x,

gives B^- (A + B K) = Phi B^-: each level's Phi keeps its poles, and the closed loop has all of them. Zubov, Mikrin,
Misrikhanov and Ryabchenko, "Modification of the exact pole placement method and its application for the control of
spacecraft motion", Journal of Computer and Systems Sciences International 52 (2013); the formulas were derived here. In
this file u = K x as in the source; the result's gain has the opposite sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .controllability import TOLERANCE
from .results import PlacementError, Reason, StateFeedback
from .spectrum import Spectrum

_OUTSIDE = 1e-8  # relative; permitted distance of a user's basis from the driven space


@dataclass(frozen=True)
class PoleLevel:
    """Level: its pair ``a`` and ``b`` = ``left`` ``right``, P = ``down``, and the retained singular values."""

    a: np.ndarray
    b: np.ndarray
    left: np.ndarray
    right: np.ndarray
    down: np.ndarray
    values: np.ndarray

    @property
    def rank(self) -> int:
        return self.left.shape[1]


def decompose(
    a: np.ndarray, b: np.ndarray, tolerance: float = TOLERANCE, sizes: Sequence[int] | None = None
) -> list[PoleLevel]:
    """Return the levels of a pair, level 0 first.

    Bt = U S and R = V' are from the singular value decomposition. Singular values above ``tolerance`` times |B| are
    retained; on higher levels |B| is replaced by |A| |Bt| of the level below. With ``sizes`` the levels are consecutive
    groups of states instead, and Bt selects a group, so that the level's Phi is in these coordinates. Raises
    PlacementError for a pair that is not controllable, or states that do not form a level.
    """
    levels: list[PoleLevel] = []
    scale = float(np.linalg.norm(b, 2))
    while True:
        left, values, right = np.linalg.svd(b)
        rank = int(np.sum(values > tolerance * scale))
        if not rank:
            raise _unreachable(len(levels), len(a), values, scale, tolerance)
        if sizes is None:
            # make the signs independent of the coordinates of the state: the largest element of each row of R is
            # positive
            remainder = right[:rank]
            signs = np.sign(remainder[np.arange(rank), np.argmax(np.abs(remainder), axis=1)])
            factor, remainder, down = (
                left[:, :rank] * (values[:rank] * signs),
                signs[:, None] * remainder,
                left[:, rank:].T,
            )
        else:
            _check_size(sizes, len(levels), rank, b)
            factor, remainder, down = np.eye(len(a), rank), b[:rank], np.eye(len(a))[rank:]
        levels.append(PoleLevel(a, b, factor, remainder, down, values[:rank]))
        if rank == len(a):
            return levels
        scale = float(np.linalg.norm(a, 2) * np.linalg.norm(factor, 2))
        a, b = down @ a @ down.T, down @ a @ factor


def assemble(
    levels: Sequence[PoleLevel], desired: Sequence[np.ndarray], above: Sequence[np.ndarray] | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return K of u = K x and B^-, both of level 0, for Phi_i = ``desired``, real or complex, level 0 first.

    ``above`` contains, for each level, the required gain of the level above. Only its component in the null space of R
    is used, which Phi does not determine; by default this component is 0.
    """
    gain = inverse = np.zeros((0, 0))
    for i in reversed(range(len(levels))):
        level, phi = levels[i], desired[i]
        inverse = np.linalg.pinv(level.left)
        if len(level.down):
            inverse = inverse - gain @ level.down
        back = np.linalg.pinv(level.right)
        gain = back @ (phi @ inverse - inverse @ level.a)
        if above is not None and i and level.rank < level.b.shape[1]:
            gain = gain + above[i - 1] - back @ level.right @ above[i - 1]
    return gain, inverse


def place_on_levels(
    levels: Sequence[PoleLevel],
    desired: Sequence[np.ndarray],
    poles: np.ndarray,
    method: str = "multilevel",
    above: Sequence[np.ndarray] | None = None,
) -> StateFeedback:
    """Return the gain of u = -K x for Phi_i = ``desired``, level 0 first, which together have the ``poles``."""
    gain = -np.real(assemble(levels, desired, above)[0])
    closed_loop = levels[0].a - levels[0].b @ gain
    return StateFeedback(method, gain, poles, closed_loop, levels=[level.values for level in levels])


def multilevel(a: np.ndarray, b: np.ndarray, spectrum: Spectrum, tolerance: float = TOLERANCE) -> StateFeedback:
    """Place the spectrum with diagonal Phi_i, 2 x 2 blocks for pairs, the fastest poles on level 0.

    Each pair needs two dimensions of one level. Raises PlacementError.
    """
    levels = decompose(a, b, tolerance)
    parts = spectrum.split_by_speed([level.rank for level in levels])
    if parts is None:
        ranks = ", ".join(str(level.rank) for level in levels)
        problem = (
            f"{len(spectrum.pairs)} conjugate pairs cannot be distributed over levels of ranks {ranks} "
            "without splitting a pair"
        )
        remedy = "use method indices, or choice least_condition or least_norm"
        raise PlacementError("multilevel placement", Reason.SPREAD, problem, len(spectrum.pairs), remedy)
    return place_on_levels(levels, [part.matrix for part in parts], spectrum.poles)


def _check_size(sizes: Sequence[int], level: int, rank: int, b: np.ndarray) -> None:
    size = sizes[level] if level < len(sizes) else 0
    outside = float(np.linalg.norm(b[rank:], 2) / np.linalg.norm(b, 2)) if len(b) > rank else 0.0
    if size == rank and outside <= _OUTSIDE:
        return
    says = f"has {size} columns, but the level has rank {rank}"
    if size == rank:
        says = f"does not span the directions that the inputs drive: a fraction {outside:.2g} of B's 2-norm is outside"
    problem = f"the basis of level {level} {says}"
    remedy = "give a basis of the states that B drives, then of the states that these drive, and so on"
    raise PlacementError("multilevel placement", Reason.RANK, problem, float(size) if size != rank else outside, remedy)


def _unreachable(level: int, states: int, values: np.ndarray, scale: float, tolerance: float) -> PlacementError:
    largest = float(values[0]) if len(values) else 0.0
    problem = (
        f"{states} states are not controllable: on level {level} the largest singular value of the input matrix "
        f"is {largest:.2g}, "
        f"not above {tolerance:g} x {scale:.2g}"
    )
    remedy = "remove these states, or add an input"
    return PlacementError("multilevel placement", Reason.NOT_CONTROLLABLE, problem, largest, remedy)
