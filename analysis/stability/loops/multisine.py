"""Odd random-phase multisines: periodic signals that measure a frequency response and its nonlinearity at once.

Only some odd harmonics are excited. Even-order nonlinearity responds at even lines, odd-order nonlinearity at all odd
lines, so a response at lines that are not excited is due to nonlinearity or noise. Pintelon and Schoukens, "System
Identification: A Frequency Domain Approach" (2nd ed. 2012). Line k of a period of N samples has the angular frequency 2
pi k/(N T).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_GROUP = 4  # successive candidates of which one, chosen at random, is not excited
_DRAWS = 50  # number of random sets of phases; the set with the lowest crest factor is used
_SWAPS = 100  # iterations: peaks are clipped in time, then amplitudes are restored in frequency
_CLIPPED = 0.8


@dataclass(frozen=True)
class Multisine:
    """One period of the signal: sum over ``lines`` k of amplitude * cos(2 pi k n/N + phase_k).

    ``unexcited`` are the other lines, even and odd, from 1 to the highest one requested. ``phases`` are in rad.
    """

    signal: np.ndarray
    amplitude: float
    lines: np.ndarray
    unexcited: np.ndarray
    phases: np.ndarray

    @property
    def crest_factor(self) -> float:
        """Largest absolute value over root mean square."""
        return float(np.max(np.abs(self.signal)) / np.sqrt(np.mean(self.signal**2)))


def multisine(
    samples: int, amplitude: float, highest_line: int, seed: int, *, per_decade: float | None = None
) -> Multisine:
    """Return a multisine with ``samples`` per period and lines of ``amplitude``, excited up to ``highest_line``.

    ``per_decade`` spaces the lines quasi-logarithmically: about this number per decade, or all odd lines where there
    are fewer. The lowest line is always excited. Raises ValueError for a line at or above half the ``samples``.
    """
    if not 1 <= highest_line < samples / 2:
        raise ValueError(f"the highest line, {highest_line}, must lie between 1 and half of {samples} samples")
    if not amplitude > 0.0 or (per_decade is not None and not per_decade > 0.0):
        raise ValueError("amplitude and lines per decade must be positive")
    candidates = np.arange(1, highest_line + 1, 2)
    if per_decade is not None:
        highest_odd = float(candidates[-1])
        desired = np.geomspace(1.0, highest_odd, max(2, 1 + round(per_decade * np.log10(highest_odd))))
        candidates = np.unique(2 * np.round((desired - 1.0) / 2.0).astype(int) + 1)
    random = np.random.default_rng(seed)
    groups = np.arange(1, len(candidates) - _GROUP + 1, _GROUP)  # complete groups, beginning with the second candidate
    lines = np.delete(candidates, groups + random.integers(_GROUP, size=len(groups)))
    phases = _low_crest(samples, lines, random)
    signal = amplitude * _unit_signal(samples, lines, phases)
    unexcited = np.setdiff1d(np.arange(1, highest_line + 1), lines)
    return Multisine(signal, amplitude, lines, unexcited, phases)


def single_line(samples: int, line: int) -> Multisine:
    """Return one period of a cosine of amplitude 1 at one line, without unexcited lines."""
    phase, unexcited = np.zeros(1), np.zeros(0, dtype=int)
    return Multisine(_unit_signal(samples, np.array([line]), phase), 1.0, np.array([line]), unexcited, phase)


def _unit_signal(samples: int, lines: np.ndarray, phases: np.ndarray) -> np.ndarray:
    spectrum = np.zeros(samples // 2 + 1, dtype=complex)
    spectrum[lines] = 0.5 * samples * np.exp(1j * phases)
    return np.fft.irfft(spectrum, samples)


def _low_crest(samples: int, lines: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """Return phases (rad) with a low peak: the best of several random sets, improved by time-frequency swapping.

    Van der Ouderaa, Schoukens and Renneboog, "Peak factor minimization using a time-frequency domain swapping
    algorithm", IEEE Trans. Instrumentation and Measurement 37 (1988).
    """

    def peak(phases: np.ndarray) -> float:
        return float(np.max(np.abs(_unit_signal(samples, lines, phases))))

    best = min((random.uniform(-np.pi, np.pi, len(lines)) for _ in range(_DRAWS)), key=peak)
    phases, lowest = best, peak(best)
    for _ in range(_SWAPS):
        signal = _unit_signal(samples, lines, phases)
        bound = _CLIPPED * np.max(np.abs(signal))
        phases = np.angle(np.fft.rfft(np.clip(signal, -bound, bound))[lines])
        if peak(phases) < lowest:
            best, lowest = phases, peak(phases)
    return best


def line_spectrum(record: np.ndarray, samples: int, lines: np.ndarray) -> np.ndarray:
    """Return complex amplitudes (len(lines), ...) of a record (n, ...), averaged over periods of ``samples`` rows.

    A line amplitude * cos(2 pi k n/N + phase) gives amplitude * exp(1j * phase). Raises ValueError if the record is not
    a whole number of periods.
    """
    record = np.asarray(record, dtype=float)
    periods, remainder = divmod(len(record), samples)
    if remainder or not periods:
        raise ValueError(f"a record of {len(record)} samples is not a whole number of periods of {samples} samples")
    mean = record.reshape(periods, samples, *record.shape[1:]).mean(axis=0)
    return 2.0 / samples * np.fft.rfft(mean, axis=0)[np.asarray(lines)]


def fraction_unexcited(record: np.ndarray, signal: Multisine) -> float:
    """Return the largest response on an unexcited line, relative to the larger one on neighbouring excited lines.

    ``record`` (n,) is a response over whole periods in the steady state. The result is 0 for a linear response without
    noise.
    """
    samples = len(signal.signal)
    size = np.abs(line_spectrum(record, samples, signal.lines))
    stray = np.abs(line_spectrum(record, samples, signal.unexcited))
    above = np.searchsorted(signal.lines, signal.unexcited)
    below, above = np.maximum(above - 1, 0), np.minimum(above, len(size) - 1)
    if not np.all(size > 0.0):
        raise ValueError("an excited line has no response to compare with")
    return float(np.max(stray / np.maximum(size[below], size[above]), initial=0.0))
