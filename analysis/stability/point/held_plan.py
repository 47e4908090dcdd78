"""Plans that an operating point holds: a parameter frozen_NAME above 0 fixes the output NAME of its component."""

from __future__ import annotations

from ...common.errors import InputError
from ...runtime.system.prepared import PreparedSystem
from ..request.declaration import Point
from .bench import Bench

PREFIX = "frozen_"
SAME = 1e-6  # relative, of a number that is fixed


def fixed_outputs(prepared: PreparedSystem) -> dict[str, tuple[str, float]]:
    """Return the outputs that parameters of a system fix, each with its parameter and number."""
    fixed: dict[str, tuple[str, float]] = {}
    for component, fmu in prepared.network.fmus.items():
        for name, variable in fmu.variables.items():
            output = fmu.variables.get(name.removeprefix(PREFIX))
            if not name.startswith(PREFIX) or output is None or output.causality != "output":
                continue
            number = float(prepared.settings.variables.get((component, name), variable.start_text) or 0.0)
            if number > 0.0:
                fixed[f"{component}.{output.name}"] = (f"{component}.{name}", number)
    return fixed


def check_plan_is_fixed(prepared: PreparedSystem, point: Point) -> None:
    """Fly to the operating point and refuse a component that does not hold its plan on the way.

    Raises InputError, and StudyError where the point is not found.
    """
    fixed = fixed_outputs(prepared)
    if not fixed:
        return
    bench = Bench(prepared, point, [], recorded=tuple(fixed))
    try:
        flight = bench.simulation.advance(-1, bench.origin)  # also one that ends early
        last = {output: float(flight.signals[output][-1]) for output in fixed} if flight.time.size else {}
    finally:
        bench.close()
    for output, actual in last.items():
        parameter, number = fixed[output]
        if not abs(actual - number) <= SAME * number:
            component = output.partition(".")[0]
            where = f"point {point.name}, {component} ({prepared.network.fmus[component].name})"
            problem = f"{parameter} is {number:g}, and {output} is {actual:.4g} at t = {flight.time[-1]:g} s"
            remedy = "choose an FMU that holds its plan (a law in Python: by planned_time), or leave it at 0"
            raise InputError(prepared.network.file, where, problem, remedy)
