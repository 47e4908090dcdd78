"""Margins over one parameter, with the values at which they reach their limits, and over the communication step."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from functools import cache

import numpy as np
from scipy.optimize import brentq

from ...common.errors import InputError
from ..runtime.system.options import Layer
from ..runtime.system.prepared import PreparedSystem
from .loops.margin_values import LoopMargins, MarginQuantity
from .point.bench import StudyError
from .point.point_study import PointStudy
from .request.declaration import LoopDeclaration, MarginLimits, PointDeclaration, Sweep
from .request.request import Subject
from .results.varied import StepMargins, SweepCrossing, SweepReport

VALUES = 13
CROSSING = 1e-3  # relative, of the value at which a limit is reached
FAR = 1e3  # dB or deg, substitute for an infinite margin

At = Callable[[float], LoopMargins]
FACTORS = (0.5, 1.0, 2.0)  # factors on the communication step


def run_sweep(
    subject: Subject,
    point: PointDeclaration,
    loop: LoopDeclaration,
    sweep: Sweep,
    limits: MarginLimits,
    cells: Sequence[int],
    tell: Callable[[int, int], None],
) -> SweepReport:
    """Compute margins of a loop's first channel over a parameter, at geometrically spaced values if positive.

    ``cells`` are the relevant memory cells at the point. Raises StudyError if a simulation fails.
    """

    @cache
    def at(value: float) -> LoopMargins:
        with PointStudy(subject.with_options(study=Layer(set={sweep.parameter: value})), point, [loop]) as study:
            return study.margins(cells, [study.channels[0].name])[0]

    spread = np.geomspace if sweep.low > 0.0 else np.linspace
    values = [float(value) for value in spread(sweep.low, sweep.high, VALUES)]
    crossings: list[SweepCrossing] = []
    tell(len(values) - 1, 0)
    for low, high in itertools.pairwise(values):
        crossings += _crossings(at, low, high, limits.nominal)
        tell(0, 1)
    return SweepReport(
        name=sweep.name,
        loop=loop.name,
        parameter=sweep.parameter,
        unit=_unit(subject.at(point), sweep.parameter),
        values=np.array(values),
        margins=tuple(at(value) for value in values),
        crossings=tuple(sorted(crossings, key=lambda crossing: crossing.value)),
    )


def _unit(prepared: PreparedSystem, parameter: str) -> str | None:
    """Return the unit of ``component.variable``; None for unknown names, which the settings reject."""
    for component, fmu in prepared.network.fmus.items():
        variable = fmu.variables.get(parameter.removeprefix(f"{component}."))
        if parameter.startswith(f"{component}.") and variable is not None:
            return variable.unit
    return None


def _crossings(at: At, low: float, high: float, required: dict[MarginQuantity, float]) -> list[SweepCrossing]:
    """Return the limits crossed between two neighbouring values.

    If the loop becomes unstable in between, limits are searched on the stable side only: a margin still above its limit
    there ends without reaching it.
    """
    crossings: list[SweepCrossing] = []
    if at(low).unstable and at(high).unstable:
        return crossings
    if at(low).unstable != at(high).unstable:
        below = at(low).unstable
        left, right = _bisect(lambda value: at(value).unstable == below, low, high)
        crossings.append(SweepCrossing(MarginQuantity.STABILITY, 0.5 * (left + right), below))
        low, high = (right, high) if below else (low, left)
    for quantity, limit in required.items():

        def excess(value: float, quantity: MarginQuantity = quantity, limit: float = limit) -> float:
            return float(np.clip(at(value).size(quantity) - limit, -FAR, FAR))

        below = excess(low) < 0.0
        if below != (excess(high) < 0.0):
            value = float(brentq(excess, low, high, rtol=CROSSING, xtol=CROSSING * max(abs(low), abs(high))))
            crossings.append(SweepCrossing(quantity, value, below))
    return crossings


def _bisect(is_low: Callable[[float], bool], low: float, high: float) -> tuple[float, float]:
    """Return neighbouring values between which a condition changes that is true at ``low`` but not at ``high``."""
    while high - low > CROSSING * max(abs(low), abs(high)):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_low(middle) else (low, middle)
    return low, high


def vary_step(
    subject: Subject,
    point: PointDeclaration,
    loops: Sequence[LoopDeclaration],
    step: float,
    cells: Sequence[int],
    names: Sequence[str],
    tell: Callable[[int, int], None],
) -> dict[str, tuple[StepMargins, ...]]:
    """Compute margins of the channels ``names`` with half, the same and twice the communication step ``step`` (s).

    ``cells`` are the relevant memory cells at this point. If margins do not exist the note explains why.
    """
    tell(len(FACTORS), 0)
    by_factor = []
    for factor in FACTORS:
        try:
            with PointStudy(subject.with_options(step=factor * step), point, loops) as study:
                rows = [StepMargins(factor * step, margins) for margins in study.margins(cells, names)]
        except (InputError, StudyError) as error:
            rows = [StepMargins(factor * step, None, str(error))] * len(names)
        by_factor.append(rows)
        tell(0, 1)
    return dict(zip(names, zip(*by_factor, strict=True), strict=True))
