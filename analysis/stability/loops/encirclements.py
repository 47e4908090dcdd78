"""Encirclements of the critical point, from the frequency response alone (Nyquist's criterion for sampled loops)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from .curves import Response, cache_response, dense

_LARGEST_STEP = 0.5 * np.pi  # largest phase between neighbours: beyond it the direction of the turn is ambiguous
_NOT_A_COUNT = 0.1  # largest distance of the number of turns from an integer
_NOT_A_SLOPE = 0.2
_BESIDE = 1e-5  # relative distance from an undamped pole at which the path leaves the unit circle


def encirclements(
    response: Response,
    low: float,
    high: float,
    *,
    poles_at_one: int | None = None,
    undamped: Iterable[float] = (),
    include: Iterable[float] = (),
) -> int:
    """Count counter-clockwise encirclements of -1 by L, or of 0 by det(I + L), over the whole unit circle of z.

    P open-loop poles outside the unit circle and N encirclements leave P - N closed-loop poles outside. The contour
    passes outside all open-loop poles on the circle, so P does not include them: integrators at z = 1, and poles at the
    frequencies ``undamped`` (rad/s, each repeated by its multiplicity). ``poles_at_one`` is the number of poles of
    det(I + L) at z = 1; by default it follows from the slope of the gain at ``low`` (rad/s), where the loop gain of
    every integrator must be well above 1. ``high`` should be the Nyquist frequency. ``include`` are the frequencies of
    lightly damped poles.

    Raises ValueError if the phase between ``low`` and ``high`` is not settled: the closed loop is marginal, ``low`` is
    not low enough, or there are other poles on the unit circle.
    """
    undamped = np.sort(np.asarray([*undamped], dtype=float))
    response = cache_response(response)

    def difference(frequency: np.ndarray) -> np.ndarray:
        value = np.asarray(response(frequency), dtype=complex)
        return 1.0 + value if value.ndim == 1 else np.linalg.det(np.eye(value.shape[-1]) + value)

    integrators = _poles_at_one(response, difference, low, poles_at_one)
    corners = np.unique(undamped[(undamped > low) & (undamped < high)])
    if len(corners) != len(np.unique(undamped)):
        raise ValueError(f"undamped poles must lie between {low:g} and {high:g} rad/s")
    starts = np.concatenate([[low], corners * (1.0 + _BESIDE)])
    ends = np.concatenate([corners * (1.0 - _BESIDE), [high]])
    include = [*include]
    turned = sum(_turn(difference, start, end, include) for start, end in zip(starts, ends, strict=True))
    # Along half a circle outside of a pole, z - pole turns by +pi and 1/(z - pole) by -pi; the lower half of the
    # unit circle is the mirror image of the upper.
    count = (2.0 * turned - np.pi * (integrators + 2 * len(undamped))) / (2.0 * np.pi)
    if abs(count - round(count)) > _NOT_A_COUNT:
        raise ValueError(
            f"between {low:g} and {high:g} rad/s 1 + L turns {count:.3f} times about 0, not a whole number of "
            f"times, since an open-loop pole is slower than {low:g} rad/s or close to the unit "
            "circle; start at a lower frequency, end at the Nyquist frequency and name the poles on the unit circle"
        )
    return round(count)


def _turn(difference: Response, low: float, high: float, include: list[float]) -> float:
    """Return the angle (rad) by which 1 + L turns from ``low`` to ``high``."""
    curve = dense(difference, low, high, include=include, refine=False)
    steps = np.angle(curve.value[1:] / curve.value[:-1])
    worst = int(np.argmax(np.abs(steps)))
    if abs(steps[worst]) > _LARGEST_STEP:
        raise ValueError(
            f"the phase of 1 + L jumps by {abs(steps[worst]):.2f} rad at {curve.frequency[worst]:g} rad/s: "
            "a pole of the open loop is on the unit circle and must be named, or a pole of the closed loop, "
            "which is then marginally stable"
        )
    return float(np.sum(steps))


def _poles_at_one(response: Response, difference: Response, low: float, declared: int | None) -> int:
    """Return the number of poles of 1 + L at z = 1, checked by the slope of its gain over the octave above ``low``."""
    pair = np.array([low, 2.0 * low])
    slope = _slope(difference(pair))
    number = round(-slope) if declared is None else declared
    if abs(slope + number) > _NOT_A_SLOPE or number < 0:
        raise ValueError(
            f"at {low:g} rad/s the log-log slope of |1 + L| is {slope:.2f}, but "
            f"{'it must be 0 or a negative integer' if declared is None else f'poles at z = 1 require {-declared}'}; "
            "start at a lower frequency"
        )
    if declared is None and number == 0:
        size = np.asarray(response(pair))
        # the gain of L still rises towards low frequency but is negligible in 1 + L
        if _slope(size if size.ndim == 1 else np.linalg.norm(size, axis=(1, 2))) < -1.0 + _NOT_A_SLOPE:
            raise ValueError(
                f"the gain of L at {low:g} rad/s is below 1 but still rises towards lower frequencies; "
                "start at a lower frequency"
            )
    return number


def _slope(value: np.ndarray) -> float:
    """Return the slope of log gain over log frequency, from values one octave apart."""
    size = np.abs(value)
    if size[0] == 0.0 or size[1] == 0.0:
        return 0.0
    return float(np.log2(size[1] / size[0]))
