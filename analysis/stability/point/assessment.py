"""Margins of one loop from its frequency response, compared with the limits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..loops.curves import Response, cache_response, dense
from ..loops.margin_values import LoopMargins, MarginQuantity
from ..loops.margins import classical, robust
from ..loops.readings import Classical, FrequencyResponse, Robust
from ..request.declaration import MarginLimits
from ..results.requirement import MarginRequirement, Scope, describe_instability

LOWEST = 1e-6  # fraction of the Nyquist frequency, below which a linear model's integrators are not resolved
BELOW = 0.02  # fraction of the lowest gain crossover at which the studied range of a loop begins
COARSE = 600
LOWER = 0.2  # factor on the lowest frequency if encirclements cannot be counted from there


@dataclass(frozen=True)
class Assessment:
    """Margins, and the curve from which they were read; ``notes`` explain why encirclements were not counted."""

    curve: FrequencyResponse
    classical: Classical
    robust: Robust
    notes: dict[str, str]


def lowest_frequency(response: Response, sample_period: float) -> float:
    """Return the lowest frequency (rad/s) to study: well below the lowest gain crossover, if the model resolves it."""
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
    """Return all margins between ``low`` and ``high`` (rad/s); ``undamped`` and ``include`` as in `classical`.

    ``slower`` returns the number of unstable open-loop poles slower than a frequency. A count of encirclements that
    begins at this frequency would mistake these poles for integrators, so the count begins below them if that can be
    resolved.
    """
    response = cache_response(response)
    notes: dict[str, str] = {}
    while True:
        lowest = low <= LOWEST * high
        try:
            crossings = classical(response, low, high, sample_period, unstable_open, undamped=undamped, include=include)
            if lowest or unstable_open is None or slower(low) == 0:
                break
        except ValueError as error:  # mostly slow poles that are not distinguishable from integrators at this frequency
            if unstable_open is None:
                raise
            if lowest:
                notes["encirclements"] = str(error)
                crossings = classical(response, low, high, sample_period, None, undamped=undamped, include=include)
                break
        low = max(LOWEST * high, LOWER * low)
    if unstable_open is not None and (left := slower(low)) and "encirclements" not in notes:
        notes["encirclements"] = (
            f"{left} unstable open-loop poles are slower than {low:.2g} rad/s and treated as integrators"
        )
    curve = dense(response, low, high, include=include)
    return Assessment(curve, crossings, robust(response, low, high, include=include), notes)


def requirements(
    margins: LoopMargins, limits: MarginLimits, outside: Sequence[str] = ()
) -> tuple[MarginRequirement, ...]:
    """Return the project's limits applied to one loop; ``outside`` names memory that grows outside the loop."""
    if margins.stable is None:
        note = "poles are not known without a linearisation"
        stability = MarginRequirement(Scope.NOMINAL, MarginQuantity.STABILITY, None, 1.0, None, note)
    else:
        note = "" if margins.stable else describe_instability(outside) or "the closed loop is unstable"
        stability = MarginRequirement(
            Scope.NOMINAL, MarginQuantity.STABILITY, margins.largest, 1.0, margins.stable, note
        )
    return stability, *(
        MarginRequirement.at_least(Scope.NOMINAL, quantity, margins.size(quantity), limit)
        for quantity, limit in limits.nominal.items()
    )
