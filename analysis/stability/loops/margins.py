"""Margins of one loop from its frequency response: classical ones, and distances from the critical point.

Åström and Murray, "Feedback Systems" (2008), chapter 9; disk margins: Seiler, Packard and Gahinet, "An introduction to
disk margins", IEEE Control Systems Magazine 40 (2020), with skew 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from .curves import Response, cache_response, dense
from .encirclements import encirclements
from .readings import Classical, Crossing, Robust

# Crossings beyond these are ignored: 180 dB of gain, or a phase within rounding of the negative real axis, such as
# the phase of a double integrator at low frequency.
_ROUNDING = 1e-9
_FINEST = 4.0 * np.finfo(float).eps


def classical(
    response: Response,
    low: float,
    high: float,
    sample_period: float,
    unstable_open: int | None,
    *,
    poles_at_one: int | None = None,
    undamped: Iterable[float] = (),
    include: Iterable[float] = (),
) -> Classical:
    """Return all gain, phase and delay margins between ``low`` and ``high`` (rad/s) of a sampled loop.

    ``sample_period`` is in s. L has a gain margin also at an end where it is real without crossing the axis: at the
    Nyquist frequency, if ``high`` is this frequency, and at frequency 0 (returned as such), if L has no integrator and
    is level below ``low``. Encirclements are counted if the number of open-loop poles outside the unit circle is known.
    ``poles_at_one`` and ``undamped`` (rad/s) are as in `encirclements`, ``include`` as in `dense`.

    Crossings are bracketed on the grid and solved for on the response itself (Brent). Between the ends python-control's
    `stability_margins` of an FRD on the same grid agrees within 1e-6 dB and deg, as the tests verify. Version 0.10.2
    returns no margins at either end, however, and its polynomial method is wrong for resonant loops (1.14 instead of
    1.05).
    """
    include = [*include]
    undamped = [*undamped]
    response = cache_response(response)
    curve = dense(response, low, high, include=include)
    frequency = curve.frequency

    def gain(angular: float) -> float:
        return float(np.log(np.abs(_at(response, angular))))

    def phase(angular: float) -> float:
        return float(np.angle(-_at(response, angular)))

    with np.errstate(divide="ignore"):
        gains = np.maximum(np.log(np.abs(curve.value)), -100.0)
    phases = np.angle(-curve.value)
    # the phase also changes its sign, by 2 pi, on the positive real axis: there is no margin
    by_phase = _roots(phase, frequency, phases, lambda a, b: abs(a) + abs(b) < np.pi)
    by_gain = _roots(gain, frequency, gains, lambda a, b: True)

    gain_crossings = [Crossing(float(1.0 / np.abs(_at(response, w))), w) for w in by_phase]
    ends = [_at_zero(response, low, high), _at_nyquist(response, high, sample_period)]
    gain_crossings += [crossing for crossing in ends if crossing is not None]
    gain_crossings = [item for item in gain_crossings if _ROUNDING < item.value < 1.0 / _ROUNDING]
    phase_crossings = [Crossing(phase(w), w) for w in by_gain]
    delays = [(crossing.value % (2.0 * np.pi) / crossing.frequency, crossing.frequency) for crossing in phase_crossings]
    delay, at = min(delays, default=(np.inf, np.nan))
    count = None
    if unstable_open is not None:
        count = encirclements(response, low, high, poles_at_one=poles_at_one, undamped=undamped, include=include)
    return Classical(
        gain=tuple(sorted(gain_crossings, key=lambda crossing: crossing.frequency)),
        phase=tuple(phase_crossings),
        delay_margin=delay,
        delay_frequency=at,
        encirclements=count,
    )


def robust(response: Response, low: float, high: float, *, include: Iterable[float] = ()) -> Robust:
    """Return peaks of S = 1/(1+L) and T = L/(1+L) and the disk margin, between ``low`` and ``high`` (rad/s).

    They bound the permitted perturbations only if the closed loop is stable.
    """
    response = cache_response(response)
    frequency = dense(response, low, high, include=include).frequency

    with np.errstate(divide="ignore"):
        s_peak, s_at = highest(lambda w: np.abs(1.0 / (1.0 + response(w))), frequency)
        t_peak, t_at = highest(lambda w: np.abs((value := response(w)) / (1.0 + value)), frequency)
        # S - 1/2
        b_peak, b_at = highest(lambda w: np.abs(0.5 * (1.0 - (value := response(w))) / (1.0 + value)), frequency)
    alpha = 1.0 / b_peak
    return Robust(
        modulus_margin=1.0 / s_peak,
        sensitivity_peak=s_peak,
        sensitivity_frequency=s_at,
        complementary_peak=t_peak,
        complementary_frequency=t_at,
        disk_margin=alpha,
        disk_gain=disk_gain(alpha),
        disk_phase=disk_phase(alpha),
        disk_frequency=b_at,
    )


def disk_gain(alpha: float) -> float:
    """Return the factor by which the gain may rise or fall within a disk margin with skew 0 (inf from 2)."""
    return (1.0 + 0.5 * alpha) / (1.0 - 0.5 * alpha) if alpha < 2.0 else np.inf


def disk_phase(alpha: float) -> float:
    """Return the change of phase (rad, either way) that a disk margin with skew 0 permits."""
    return 2.0 * float(np.arctan(0.5 * alpha))


def disk_of_gain(factor: float) -> float:
    """Return the disk margin with skew 0 that permits the gain to rise or fall by a factor."""
    return 2.0 * (factor - 1.0) / (factor + 1.0)


def disk_of_phase(angle: float) -> float:
    """Return the disk margin with skew 0 that permits a change of phase (rad, either way)."""
    return 2.0 * float(np.tan(0.5 * angle))


def highest(size: Callable[[np.ndarray], np.ndarray], frequency: np.ndarray) -> tuple[float, float]:
    """Return the highest value and its frequency (rad/s), refined between points of a grid that resolves all peaks.

    ``size`` returns the values for angular frequencies (rad/s).
    """
    values = size(frequency)
    best = int(np.argmax(values))
    candidates = [(float(values[best]), float(frequency[best]))]
    neighbours = np.concatenate([[-np.inf], values, [-np.inf]])
    before, after = neighbours[:-2], neighbours[2:]
    # only the ends of a level stretch: inside it, as in a loop without gain, there is nothing to refine
    peaks = (values >= before) & (values >= after) & ((values > before) | (values > after))
    peaks &= values > 0.98 * values[best]
    for index in np.flatnonzero(peaks).tolist():
        left, right = frequency[max(index - 1, 0)], frequency[min(index + 1, len(frequency) - 1)]
        result = minimize_scalar(
            lambda angular: -float(size(np.array([angular]))[0]),
            bounds=(left, right),
            method="bounded",
            options={"xatol": 1e-9 * left},
        )
        candidates.append((-float(result.fun), float(result.x)))
    return max(candidates)


def _at(response: Response, angular: float) -> complex:
    return complex(response(np.array([angular]))[0])


def _roots(
    function: Callable[[float], float],
    frequency: np.ndarray,
    values: np.ndarray,
    crossing: Callable[[float, float], bool],
) -> list[float]:
    """Return the zeros of ``function`` between points of different sign; points within rounding of zero are ignored."""
    retained = np.abs(values) > _ROUNDING
    frequency, values = frequency[retained], values[retained]
    roots = []
    for i in np.flatnonzero(values[1:] * values[:-1] < 0.0):
        if crossing(values[i], values[i + 1]):
            root = float(brentq(function, frequency[i], frequency[i + 1], xtol=_FINEST * frequency[i], rtol=_FINEST))
            if abs(function(root)) < 1e-3:  # else a jump, at a pole on the unit circle
                roots.append(root)
    return roots


def _at_nyquist(response: Response, high: float, sample_period: float) -> Crossing | None:
    if abs(high * sample_period - np.pi) > 1e-9:
        return None
    value = _at(response, high)
    return Crossing(1.0 / abs(value), high) if value.real < 0.0 and abs(value.imag) < 1e-6 * abs(value) else None


def _at_zero(response: Response, low: float, high: float) -> Crossing | None:
    """Return the gain margin at frequency 0, where L(0) = a < 0; close to it L = a + j b w - c w**2."""
    if 2.0 * low > high:
        return None
    one, two = _at(response, low), _at(response, 2.0 * low)
    levels = abs(two.real - one.real) < 0.01 * abs(one.real)
    odd = abs(two.imag - 2.0 * one.imag) < 0.01 * abs(two.imag) + _ROUNDING * abs(one)
    if one.real >= 0.0 or abs(one.imag) > 0.3 * abs(one.real) or not levels or not odd:
        return None
    return Crossing(3.0 / abs(4.0 * one.real - two.real), 0.0)
