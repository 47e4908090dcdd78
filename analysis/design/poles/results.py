"""Results of placements: the gain and its quality, or the error of a method that does not apply."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np

from ....common.errors import InputError
from .spectrum import distance, match

_SEMISIMPLE = 1e-9  # relative; smaller singular values count as 0


class Reason(StrEnum):
    """Reason why poles cannot be placed as requested."""

    NOT_CONTROLLABLE = "not controllable"
    NOT_OBSERVABLE = "not observable"
    CLASS = "wrong class"  # of dimensions or indices
    SPREAD = "no real spread"  # of conjugate pairs over levels
    RANK = "rank"
    RESIDUAL = "residual"
    SINGULAR = "singular"  # A, whose inverse a method needs


class PlacementError(InputError):
    """Error of a placement ``routine`` that does not apply to its arguments.

    ``number`` is the value that failed the criterion: the largest omitted singular value, n/m, a condition number, or a
    residual. ``problem`` describes the failure, and ``remedy`` suggests what to do.
    """

    def __init__(self, routine: str, reason: Reason, problem: str, number: float, remedy: str) -> None:
        super().__init__(routine, reason, problem, remedy)
        self.args = (routine, reason, problem, number, remedy)
        self.reason = reason
        self.number = number


@dataclass(frozen=True)
class Placement:
    """Gain and its closed loop.

    ``method`` is the method that found the gain, ``wanted`` are the requested poles (n,), and ``closed_loop`` is the
    real closed-loop matrix (n, n). ``condition_u`` is the condition number of the controllability matrix (of Q for
    "indices"), None for methods that do not invert it. ``levels`` contains the retained singular values on each level
    of a decomposition, level 0 first.
    """

    method: str
    gain: np.ndarray
    wanted: np.ndarray
    closed_loop: np.ndarray
    condition_u: float | None = None
    levels: Sequence[np.ndarray] = ()

    @cached_property
    def _eigen(self) -> tuple[np.ndarray, np.ndarray]:
        return np.linalg.eig(self.closed_loop)

    @property
    def poles(self) -> np.ndarray:
        """Eigenvalues of the closed loop (n,), as computed."""
        return self._eigen[0]

    @cached_property
    def kappa(self) -> float:
        """Condition number of the closed loop's unit eigenvectors, a measure of the sensitivity of its poles.

        Eigenvectors of a repeated pole are chosen orthogonal if it has as many as its multiplicity; otherwise the
        number is infinite, or of the order of 1/eps.
        """
        vectors = self._eigen[1].astype(complex)
        places = match(self.wanted, self.poles)
        for pole in np.unique(self.wanted):
            alike = np.flatnonzero(places == pole)
            if len(alike) > 1:
                _, sizes, right = np.linalg.svd(self.closed_loop - pole * np.eye(len(places)))
                if sizes[-len(alike)] <= _SEMISIMPLE * np.linalg.norm(self.closed_loop, 2):
                    vectors[:, alike] = right[-len(alike) :].conj().T
        return float(np.linalg.cond(vectors))

    @cached_property
    def error(self) -> float:
        """Largest distance between a pole and the required pole matched with it."""
        return distance(self.wanted, self.poles)

    @cached_property
    def norm(self) -> float:
        """Norm |K|: the largest singular value of the gain."""
        return float(np.linalg.norm(self.gain, 2))

    def text(self) -> str:
        """Return one line: method, |K|, kappa, error, and the condition of the inverted matrix."""
        parts = [f"{self.method}: |K| {self.norm:.4g}", f"kappa {self.kappa:.4g}", f"error {self.error:.1e}"]
        if self.condition_u is not None:
            parts.append(f"cond(U) {self.condition_u:.4g}")
        if self.levels:
            parts.append("levels " + " | ".join(" ".join(f"{value:.4g}" for value in values) for values in self.levels))
        return ", ".join(parts)


@dataclass(frozen=True)
class StateFeedback(Placement):
    """Feedback u = -K x with K = ``gain`` (m, n): the closed loop is A - B K."""


@dataclass(frozen=True, kw_only=True)
class OutputFeedback(Placement):
    """Feedback u = F y with F = ``gain`` (m, p): the closed loop is A + B F C.

    ``upper`` are the poles of the upper level, and ``condition_x`` is the condition number of X, whose inverse
    determines Phi_0; both are None if there is no upper level.
    """

    upper: np.ndarray | None = None
    condition_x: float | None = None


@dataclass(frozen=True)
class Observer(Placement):
    """Observer x_h' = A x_h + B u + L (y - C x_h) with L = ``gain`` (n, p): the error's matrix is A - L C."""


@dataclass(frozen=True, kw_only=True)
class ReducedObserver(Placement):
    """Observer zeta' = M zeta + from_y y + from_u u, x_h = of_zeta zeta + of_y y, with M = ``closed_loop``.

    ``gain`` is Lr (n - p, p); M = W'A W - Lr C A W (n - p, n - p) is the error's matrix, W = of_zeta (n, n - p), of_y
    (n, p), from_y (n - p, p), from_u (n - p, m).
    """

    from_y: np.ndarray
    from_u: np.ndarray
    of_zeta: np.ndarray
    of_y: np.ndarray
