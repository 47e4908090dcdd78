"""Plans held at an operating point: a parameter frozen_NAME above 0 fixes the output NAME of its component."""

from __future__ import annotations

from ....common.errors import InputError
from ....fmus_src.roles import FROZEN
from ...runtime.system.prepared import PreparedSystem
from ..request.declaration import PointDeclaration
from .bench import Bench

SAME = 1e-6  # relative tolerance of a value that is held


def frozen_outputs(prepared: PreparedSystem) -> dict[str, tuple[str, float]]:
    """Return the outputs that parameters of a system fix, each with its parameter and value."""
    frozen: dict[str, tuple[str, float]] = {}
    for component, fmu in prepared.network.fmus.items():
        for name, variable in fmu.variables.items():
            output = fmu.variables.get(name.removeprefix(FROZEN))
            if not name.startswith(FROZEN) or output is None or output.causality != "output":
                continue
            setting = float(prepared.settings.variables.get((component, name), variable.start_text) or 0.0)
            if setting > 0.0:
                frozen[f"{component}.{output.name}"] = (f"{component}.{name}", setting)
    return frozen


def check_frozen_plan(prepared: PreparedSystem, point: PointDeclaration) -> None:
    """Simulate to the operating point, and reject a component that does not hold its plan on the way.

    Raises InputError, and StudyError if the point is not reached.
    """
    frozen = frozen_outputs(prepared)
    if not frozen:
        return
    bench = Bench(prepared, point, [], recorded=tuple(frozen))
    try:
        flight = bench.simulation.advance(-1, bench.origin)  # also one that ends early
        last = {output: float(flight.signals[output][-1]) for output in frozen} if flight.time.size else {}
    finally:
        bench.close()
    for output, actual in last.items():
        parameter, setting = frozen[output]
        if not abs(actual - setting) <= SAME * setting:
            component = output.partition(".")[0]
            where = f"point {point.name}, {component} ({prepared.network.fmus[component].name})"
            problem = f"{parameter} is {setting:g}, and {output} is {actual:.4g} at t = {flight.time[-1]:g} s"
            remedy = "choose an FMU that holds its plan (a law in Python: by planned_time), or leave the parameter at 0"
            raise InputError(prepared.network.file, where, problem, remedy)
