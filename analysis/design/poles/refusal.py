"""The error of a routine that does not apply: why, and the number that says so."""

from __future__ import annotations

from enum import StrEnum

from ...common.errors import InputError


class Reason(StrEnum):
    """Why poles cannot be placed as asked."""

    NOT_CONTROLLABLE = "not controllable"
    NOT_OBSERVABLE = "not observable"
    CLASS = "wrong class"  # of dimensions or indices
    SPREAD = "no real spread"  # of conjugate pairs over levels
    RANK = "rank"
    RESIDUAL = "residual"


class PlacementError(InputError):
    """A ``routine`` that does not apply to what it was given.

    ``number`` is what decided: the largest singular value left out, n/m, a condition number, a residual. It stands in
    ``problem``, too; ``remedy`` says what to do.
    """

    def __init__(self, routine: str, reason: Reason, problem: str, number: float, remedy: str) -> None:
        super().__init__(routine, reason, problem, remedy)
        self.args = (routine, reason, problem, number, remedy)
        self.reason = reason
        self.number = number
