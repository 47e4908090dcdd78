"""Margins of one loop from its frequency response, and what the limits say of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .curves import Response, dense, remembered
from .declaration import Limits
from .margins import classical, robust
from .results import Classical, Curve, Requirement, Robust

LOWEST = 1e-6  # of the Nyquist frequency: below, a linear model's integrators are not resolved
BELOW = 0.02  # of the lowest gain crossover, from which on a loop is looked at
COARSE = 600
LOWER = 0.2  # step down where encirclements cannot be counted from there


@dataclass(frozen=True)
class Assessment:
    """Margins with the curve that they were read from; ``notes`` say what could not be counted, and why."""

    curve: Curve
    classical: Classical
    robust: Robust
    notes: dict[str, str]


def lowest_frequency(response: Response, sample_period: float) -> float:
    """Where to begin (rad/s): well below the lowest gain crossover, as far as a model resolves it."""
    nyquist = np.pi / sample_period
    grid = np.geomspace(LOWEST * nyquist, nyquist, COARSE)
    gain = abs(response(grid))
    crossings = np.flatnonzero((gain[1:] < 1.0) != (gain[:-1] < 1.0))
    if not crossings.size:
        return 1e-3 * nyquist
    return float(max(LOWEST * nyquist, BELOW * grid[crossings[0]]))


def assess(
    response: Response,
    low: float,
    high: float,
    sample_period: float,
    unstable_open: int | None,
    undamped: Sequence[float] = (),
    include: Sequence[float] = (),
    slower: Callable[[float], int] = lambda _: 0,
) -> Assessment:
    """All margins between ``low`` and ``high`` (rad/s); ``undamped`` and ``include`` as in `classical`.

    ``slower`` says how many unstable open-loop poles lie below a frequency: encirclements counted from there on take
    them as integrators, so it is begun below them where that can be resolved.
    """
    response = remembered(response)
    notes: dict[str, str] = {}
    while True:
        lowest = low <= LOWEST * high
        try:
            found = classical(response, low, high, sample_period, unstable_open, undamped=undamped, include=include)
            if lowest or unstable_open is None or slower(low) == 0:
                break
        except ValueError as error:  # mostly slow poles that are not yet told from integrators
            if unstable_open is None:
                raise
            if lowest:
                notes["encirclements"] = str(error)
                found = classical(response, low, high, sample_period, None, undamped=undamped, include=include)
                break
        low = max(LOWEST * high, LOWER * low)
    if unstable_open is not None and (left := slower(low)) and "encirclements" not in notes:
        notes["encirclements"] = (
            f"{left} unstable open-loop poles are slower than {low:.2g} rad/s: taken as integrators"
        )
    curve = dense(response, low, high, include=include)
    return Assessment(curve, found, robust(response, low, high, include=include), notes)


def requirements(
    found: Classical,
    peaks: Robust,
    stable: bool | None,
    limits: Limits,
    largest_pole: float | None,
) -> tuple[Requirement, ...]:
    """The project's limits against one loop."""
    stability = Requirement("largest multiplier", largest_pole, 1.0, "1", stable, "the closed loop is unstable")
    if stable:
        stability = Requirement("largest multiplier", largest_pole, 1.0, "1", True)
    elif stable is None:
        stability = Requirement("largest multiplier", None, 1.0, "1", None, "poles are not known without route A")
    if stable is False:
        note = "the closed loop is unstable"
        return (
            stability,
            Requirement("gain margin", None, limits.gain_margin_db, "dB", None, note),
            Requirement("phase margin", None, limits.phase_margin_deg, "deg", None, note),
            Requirement("modulus margin", None, limits.modulus_margin, "1", None, note),
        )
    gain, phase = found.gain_margin, found.phase_margin
    return (
        stability,
        _at_least("gain margin", decibel(gain.value) if gain else None, limits.gain_margin_db, "dB"),
        _at_least("phase margin", degrees(phase.value) if phase else None, limits.phase_margin_deg, "deg"),
        _at_least("modulus margin", peaks.modulus_margin, limits.modulus_margin, "1"),
    )


def _at_least(quantity: str, value: float | None, limit: float, unit: str) -> Requirement:
    if value is None:
        return Requirement(quantity, None, limit, unit, True, "no crossing")
    return Requirement(quantity, value, limit, unit, bool(value >= limit))


def decibel(factor: float) -> float:
    """The size of a gain margin in dB, up or down."""
    return float(abs(20.0 * np.log10(factor)))


def degrees(angle: float) -> float:
    """The size of a phase margin in deg, lag or lead."""
    return float(np.degrees(abs(angle)))
