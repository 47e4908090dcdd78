"""A flight compared with its reference trajectory: which signal differs most, where, and by how much it may."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...fmus_src.evidence.check import Tolerances

SMALLEST = 1e-6  # magnitude of a signal that differences are taken of; what is smaller may be rounding alone
CLOSE = 1e-9  # of a time: communication points carry rounding


@dataclass(frozen=True)
class SignalCheck:
    """A signal where it is worst: at ``time`` (s) its ``reference``, what was simulated (``actual``), the difference
    and what is ``permitted`` of it. ``excess`` is the greatest difference over what is permitted, infinite where
    nothing is. ``tolerance`` is the most that a sample may differ by, over the reference's greatest magnitude.
    """

    name: str
    time: float
    reference: float
    actual: float
    difference: float
    permitted: float
    excess: float
    tolerance: float

    @property
    def met(self) -> bool:
        """True if no sample differs by more than permitted."""
        return self.excess <= 1.0


def time_margin(time: np.ndarray) -> np.ndarray:
    """Return the difference (s) below which times are equal, for each."""
    return CLOSE * np.maximum(np.abs(time), 1.0)


def match_rows(flown: np.ndarray, reference: np.ndarray) -> np.ndarray | None:
    """Return the rows of a flight at a reference's times (s), the last of equal ones; None where one is between
    rows."""
    margin = time_margin(reference)
    rows = np.clip(np.searchsorted(flown, reference + margin, side="right") - 1, 0, None)
    return rows if np.all(np.abs(flown[rows] - reference) <= margin) else None


def compare_signal(
    name: str, time: np.ndarray, reference: np.ndarray, actual: np.ndarray, permitted: np.ndarray | None
) -> SignalCheck:
    """Return a signal's worst sample, [n] each. ``permitted`` None requires the same bits; NaN equals NaN."""
    same = (reference.view(np.int64) == actual.view(np.int64)) | (np.isnan(reference) & np.isnan(actual))
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        difference = np.where(same, 0.0, np.abs(actual - reference))
        difference = np.where(np.isnan(difference), np.inf, difference)
        limits = np.zeros_like(difference) if permitted is None else permitted
        excess = np.where(difference > 0.0, difference / limits, 0.0)
    if permitted is None:
        excess = np.where(same, 0.0, np.inf)  # 0.0 and -0.0 are not the same bits
    row = int(np.argmax(excess if excess.any() else difference))
    worst = [float(array[row]) for array in (time, reference, actual, difference, limits, excess)]
    worst.append(float(np.max(limits[np.isfinite(reference)], initial=0.0)) / _magnitude(reference))
    return SignalCheck(name, *worst)


def _magnitude(reference: np.ndarray) -> float:
    """Return the greatest magnitude of a signal's finite samples, SMALLEST at least."""
    return float(np.max(np.abs(reference[np.isfinite(reference)]), initial=SMALLEST))


def permitted_differences(
    name: str, reference: np.ndarray, tolerances: Tolerances | None, relative: float
) -> np.ndarray | None:
    """Return the permitted difference of each sample of a signal, [n]; None where the same bits are required.

    It is the signal's tolerance where one is declared; else ``relative`` of its greatest magnitude, or of SMALLEST.
    """
    declared = None if tolerances is None else tolerances.get(name)
    if declared is not None:
        return declared[0] + declared[1] * np.abs(reference)
    if relative == 0.0:
        return None
    return np.full(reference.size, relative * _magnitude(reference))


def compare(
    reference_time: np.ndarray,
    references: Mapping[str, np.ndarray],
    flown_time: np.ndarray,
    flown: Mapping[str, np.ndarray],
    tolerances: Tolerances | None,
    relative: float,
) -> tuple[list[SignalCheck], bool]:
    """Compare all signals, the worst first; return, too, if the flight was interpolated between its samples."""
    is_last = np.append(np.diff(reference_time) > 0.0, True)  # of samples at one time, the last one counts
    reference_time = reference_time[is_last]
    rows = match_rows(flown_time, reference_time)
    checks = []
    for name, samples in references.items():
        reference = samples[is_last]
        actual = np.interp(reference_time, flown_time, flown[name]) if rows is None else flown[name][rows]
        permitted = permitted_differences(name, reference, tolerances, relative)
        checks.append(compare_signal(name, reference_time, reference, np.ascontiguousarray(actual), permitted))
    return sorted(checks, key=lambda each: -each.excess), rows is None
