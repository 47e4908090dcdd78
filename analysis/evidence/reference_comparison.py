"""Comparison of a simulation with its reference trajectory: worst sample and permitted difference of each signal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...fmus_src.evidence.check import Tolerances

SMALLEST = 1e-6  # least magnitude for relative differences; smaller signals may be rounding errors
CLOSE = 1e-9  # relative tolerance of times, for rounding errors of communication points


@dataclass(frozen=True)
class SignalCheck:
    """The worst sample of a signal: ``reference`` and ``actual`` value, and their ``difference``, at ``time`` (s).

    ``excess`` is ``difference`` divided by ``permitted``, or infinite if no difference is permitted. ``tolerance`` is
    the largest permitted difference of any sample, relative to the greatest magnitude of the reference.
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
    """Return, for each of these times (s), the difference (s) up to which another time counts as equal."""
    return CLOSE * np.maximum(np.abs(time), 1.0)


def match_rows(flown: np.ndarray, reference: np.ndarray) -> np.ndarray | None:
    """Return the rows of a simulation at the times (s) of the reference; of several rows at one time, the last.

    None is returned if the simulation has no row at a time of the reference.
    """
    margin = time_margin(reference)
    rows = np.clip(np.searchsorted(flown, reference + margin, side="right") - 1, 0, None)
    return rows if np.all(np.abs(flown[rows] - reference) <= margin) else None


def compare_signal(
    name: str, time: np.ndarray, reference: np.ndarray, actual: np.ndarray, permitted: np.ndarray | None
) -> SignalCheck:
    """Return the worst sample of a signal; all arrays have the shape [n].

    If ``permitted`` is None, all bits must be equal; NaN equals NaN.
    """
    same = (reference.view(np.int64) == actual.view(np.int64)) | (np.isnan(reference) & np.isnan(actual))
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        difference = np.where(same, 0.0, np.abs(actual - reference))
        difference = np.where(np.isnan(difference), np.inf, difference)
        limits = np.zeros_like(difference) if permitted is None else permitted
        excess = np.where(difference > 0.0, difference / limits, 0.0)
    if permitted is None:
        excess = np.where(same, 0.0, np.inf)  # 0.0 and -0.0 have different bits
    row = int(np.argmax(excess if excess.any() else difference))
    worst = [float(array[row]) for array in (time, reference, actual, difference, limits, excess)]
    worst.append(float(np.max(limits[np.isfinite(reference)], initial=0.0)) / _magnitude(reference))
    return SignalCheck(name, *worst)


def _magnitude(reference: np.ndarray) -> float:
    """Return the greatest magnitude of a signal's finite samples, at least SMALLEST."""
    return float(np.max(np.abs(reference[np.isfinite(reference)]), initial=SMALLEST))


def permitted_differences(
    name: str, reference: np.ndarray, tolerances: Tolerances | None, relative: float
) -> np.ndarray | None:
    """Return the permitted difference of each sample of a signal, [n]; None if all bits must be equal.

    A tolerance that is declared for the signal has precedence over ``relative``, a fraction of the signal's greatest
    magnitude (at least SMALLEST).
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
    """Compare all signals; return the checks, the worst first, and True if the simulation was interpolated."""
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
