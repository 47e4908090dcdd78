"""Detection of a sustained oscillation in a recorded signal, with its amplitude and period.

The end of the record is cut into whole cycles at upward crossings of its mean. A crossing counts only if, since the
previous one, the signal was below the mean by a quarter of half its peak-to-peak value; otherwise it is ripple. A sine
with the length of the cycle is fitted to each cycle by least squares. The oscillation is sustained if

- there are at least ``cycles`` whole cycles (a settled or drifting signal has none);
- it exceeds the rounding of the record (1e-9 of its largest value);
- the mean amplitudes of the earlier and the later half of the cycles agree within ``agreement``, as do the mean
  periods (else it decays, grows or has not settled);
- the means of the two halves differ by less than a fifth of the amplitude (else it drifts);
- lengths and amplitudes of the cycles scatter by less than a fifth (standard deviation), and the sines explain
  more than half of the mean square about the mean (else it is noise, or has no single frequency).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

_RIPPLE = 0.25  # fraction of the half peak to peak
_ROUNDING = 1e-9
_DRIFT = 0.2
_UNEVEN = 0.2
_EXPLAINED = 0.5


@dataclass(frozen=True)
class Oscillation:
    """Oscillation: ``amplitude`` of the fundamental, ``half_peak_to_peak`` (mean over the cycles), ``period`` (s)."""

    amplitude: float
    half_peak_to_peak: float
    period: float
    mean: float
    cycles: int  # number of measured cycles


def _upward_crossings(values: np.ndarray, ripple: float) -> np.ndarray:
    """Return interpolated upward zero crossings, in samples, after which ``ripple`` is reached from -``ripple``."""
    state = np.where(values > ripple, 1, np.where(values < -ripple, -1, 0))
    decided = np.flatnonzero(state)
    turns = decided[1:][(state[decided[1:]] == 1) & (state[decided[:-1]] == -1)]
    upward = np.flatnonzero((values[:-1] < 0.0) & (values[1:] >= 0.0))
    last = upward[np.searchsorted(upward, turns, side="left") - 1]  # the one just before ripple is reached
    return last + values[last] / (values[last] - values[last + 1])


def _sine(values: np.ndarray, period: float) -> tuple[float, float, float]:
    """Return amplitude, constant and explained share of the variance of a sine and constant fitted by least squares."""
    angle = 2.0 * np.pi / period * np.arange(len(values))
    basis = np.column_stack([np.cos(angle), np.sin(angle), np.ones(len(values))])
    solution = np.linalg.lstsq(basis, values, rcond=None)[0]
    variance = float(np.var(values))
    explained = 1.0 - float(np.mean((values - basis @ solution) ** 2)) / variance if variance > 0.0 else 0.0
    return float(np.hypot(solution[0], solution[1])), float(solution[2]), explained


def find_oscillation(
    time: np.ndarray, values: np.ndarray, share: float = 0.5, cycles: int = 6, agreement: float = 0.03
) -> Oscillation | None:
    """Return the sustained oscillation in the last ``share`` of the record, or None.

    ``time`` (s) is uniform and ascending, ``values`` are in any unit, both of shape (n,). A cycle has at least four
    samples. Raises ValueError for a record that is not uniform, not finite or shorter than 16 samples.
    """
    time, values = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    if time.ndim != 1 or time.shape != values.shape or len(time) < 16:
        raise ValueError("a record needs at least 16 times and as many values")
    if not (np.all(np.isfinite(time)) and np.all(np.isfinite(values))):
        raise ValueError("the record has values that are not finite")
    steps = np.diff(time)
    step = float(time[-1] - time[0]) / (len(time) - 1)
    if not step > 0.0 or np.max(abs(steps - step)) > 1e-3 * step:
        raise ValueError("the record is not sampled uniformly")
    if not 0.0 < share <= 1.0 or cycles < 2:
        raise ValueError(f"share = {share!r} is not in (0, 1], or cycles = {cycles!r} is below 2")

    tail = values[len(values) - max(16, round(share * len(values))) :]
    # Mean and cycles depend on each other: three iterations, starting from mid-height.
    mean = 0.5 * float(tail.max() + tail.min())
    crossings = np.zeros(0)
    for _ in range(3):
        shifted = tail - mean
        half = 0.5 * float(np.ptp(shifted))
        if half <= _ROUNDING * float(np.max(abs(values))):
            return None
        crossings = _upward_crossings(shifted, _RIPPLE * half)
        if len(crossings) < cycles + 1:
            return None
        first, last = (int(np.ceil(crossing)) for crossing in (crossings[0], crossings[-1]))
        mean = float(np.mean(tail[first:last]))

    lengths = np.diff(crossings)
    period = float(np.mean(lengths))
    middle = len(lengths) // 2
    if period < 4.0 or np.std(lengths) > _UNEVEN * period:
        return None
    if abs(np.mean(lengths[:middle]) - np.mean(lengths[middle:])) > agreement * period:
        return None
    # Cycle by cycle, since the phase of a sampled loop drifts: cycles may be a sample longer or shorter.
    edges = np.ceil(crossings).astype(int)
    pieces = [tail[low:high] for low, high in pairwise(edges)]
    amplitudes, means, explained = np.transpose([_sine(p, n) for p, n in zip(pieces, lengths, strict=True)])
    amplitude = float(np.mean(amplitudes))
    if np.mean(explained) < _EXPLAINED or np.std(amplitudes) > _UNEVEN * amplitude:
        return None
    if abs(np.mean(amplitudes[:middle]) - np.mean(amplitudes[middle:])) > agreement * amplitude:
        return None
    if abs(np.mean(means[:middle]) - np.mean(means[middle:])) > _DRIFT * amplitude:
        return None
    half_peak_to_peak = float(np.mean([0.5 * np.ptp(piece) for piece in pieces]))
    return Oscillation(amplitude, half_peak_to_peak, period * step, float(np.mean(means)), len(lengths))
