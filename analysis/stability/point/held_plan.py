"""Plans that an operating point holds: a parameter frozen_NAME above 0 fixes the output NAME of its component."""

from __future__ import annotations

from ...common.errors import InputError
from ...runtime.system.prepared import PreparedSystem
from ..request.declaration import Point
from .bench import Bench

PREFIX = "frozen_"
SAME = 1e-6  # relative, of a value that is held


def held_outputs(prepared: PreparedSystem) -> dict[str, tuple[str, float]]:
    """Return the outputs that parameters of a system fix, each with its parameter and value."""
    held: dict[str, tuple[str, float]] = {}
    for component, fmu in prepared.network.fmus.items():
        for name, variable in fmu.variables.items():
            output = fmu.variables.get(name.removeprefix(PREFIX))
            if not name.startswith(PREFIX) or output is None or output.causality != "output":
                continue
            value = float(prepared.settings.variables.get((component, name), variable.start_text) or 0.0)
            if value > 0.0:
                held[f"{component}.{output.name}"] = (f"{component}.{name}", value)
    return held


def check_held(prepared: PreparedSystem, point: Point) -> None:
    """Fly to the operating point and refuse a component that does not hold its plan on the way.

    Raises InputError, and StudyError where the point is not found.
    """
    held = held_outputs(prepared)
    if not held:
        return
    bench = Bench(prepared, point, [], recorded=tuple(held))
    try:
        flight = bench.simulation.advance(-1, bench.origin)  # also one that ends early
        last = {output: float(flight.signals[output][-1]) for output in held} if flight.time.size else {}
    finally:
        bench.close()
    for output, actual in last.items():
        parameter, value = held[output]
        if not abs(actual - value) <= SAME * value:
            component = output.partition(".")[0]
            where = f"point {point.name}, {component} ({prepared.network.fmus[component].name})"
            problem = f"{parameter} is {value:g}, and {output} is {actual:.4g} at t = {flight.time[-1]:g} s"
            remedy = "choose an FMU that holds its plan (a law in Python: by planned_time), or leave it at 0"
            raise InputError(prepared.network.file, where, problem, remedy)
