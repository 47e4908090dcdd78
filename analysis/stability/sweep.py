"""Margins over one parameter, and the values at which they reach their limits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np
from scipy.optimize import brentq

from analysis.cosim.system import PreparedSystem

from .bench import StudyError
from .declaration import Limits, Loop, Point, Sweep
from .followed import ONE_STEP, Margins, margins_of
from .point_study import PointStudy
from .results import SweepReport
from .subject import Subject

VALUES = 13
CROSSING = 1e-3  # relative, of the value at which a limit is reached
FAR = 1e3  # dB, deg: what an infinite margin counts as


def swept(
    subject: Subject,
    point: Point,
    loop: Loop,
    sweep: Sweep,
    limits: Limits,
    cells: Sequence[int],
) -> SweepReport:
    """Margins of a loop's first channel, at values in geometric order where they are positive.

    ``cells`` is the memory that matters at the point. Raises StudyError where a flight breaks off.
    """

    @cache
    def margins(value: float) -> Margins:
        with PointStudy(subject.changed(set={sweep.parameter: value}), point, [loop]) as study:
            study.linearise(cells, ONE_STEP)
            if study.linear is None:
                raise StudyError(study.why_not)
            return margins_of(study.linear, study.channels[0].name)

    spread = np.geomspace if sweep.low > 0.0 else np.linspace
    values = [float(value) for value in spread(sweep.low, sweep.high, VALUES)]
    found = [margins(value) for value in values]
    wanted: dict[str, Callable[[Margins], float]] = {
        "gain margin": lambda item: item.gain_db - limits.gain_margin_db,
        "phase margin": lambda item: item.phase_deg - limits.phase_margin_deg,
        "modulus margin": lambda item: item.modulus - limits.modulus_margin,
    }
    crossings = {}
    for name, excess in wanted.items():
        place = _last_change([item.stable and excess(item) >= 0.0 for item in found])
        if place is not None:
            crossings[name] = _crossing(margins, excess, values[place], values[place + 1])
    return SweepReport(
        name=sweep.name,
        loop=loop.name,
        parameter=sweep.parameter,
        unit=_unit(subject.at(point), sweep.parameter),
        values=np.array(values),
        gain_margin=np.array([item.gain if item.stable else np.nan for item in found]),
        phase_margin=np.array([item.phase if item.stable else np.nan for item in found]),
        crossings=crossings,
    )


def _unit(prepared: PreparedSystem, parameter: str) -> str | None:
    """The unit of ``component.variable``; None where there is no such parameter, which the settings refuse."""
    for component, fmu in prepared.network.fmus.items():
        variable = fmu.variables.get(parameter.removeprefix(f"{component}."))
        if parameter.startswith(f"{component}.") and variable is not None:
            return fmu.unit_of(variable)
    return None


def _last_change(passes: list[bool]) -> int | None:
    """The last place at which two neighbours differ."""
    places = [place for place in range(len(passes) - 1) if passes[place] != passes[place + 1]]
    return places[-1] if places else None


def _crossing(
    margins: Callable[[float], Margins], excess: Callable[[Margins], float], low: float, high: float
) -> float:
    """The value between ``low`` and ``high`` at which a limit is reached; an unstable loop is far below it."""

    def over(value: float) -> float:
        item = margins(value)
        return float(np.clip(excess(item), -FAR, FAR)) if item.stable else -FAR

    return float(brentq(over, low, high, rtol=CROSSING, xtol=CROSSING * max(abs(low), abs(high))))
