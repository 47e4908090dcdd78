"""FMPy's own importer of .ssp files."""

from __future__ import annotations

from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import Parameter, ParameterSet

from .contestant import Fly, Values
from .course import Course


def prepare(course: Course) -> Fly:
    """simulate_ssp; it unpacks and instantiates the FMUs anew for every flight.

    The parameters are handed to it, since it does not read the bindings of the SSD. It gives all
    inputs 0 in the first step, exchanges after all have stepped, and records every connector.
    """
    parameters = ParameterSet(
        name="benchmark",
        parameters=[
            Parameter(name=f"{component}.{variable}", value=value)
            for (component, variable), value in course.settings().items()
        ],
    )
    start, step = course.prepared.start, course.prepared.step

    def fly(steps: int) -> Values:
        # it adds up the time as it goes and stops once that is not below the stop time
        stop = start + (steps - 0.5) * step
        rows = simulate_ssp(str(course.ssp), start, stop, step, parameters)
        if len(rows) != steps:
            raise RuntimeError(f"simulate_ssp made {len(rows)} steps instead of {steps}")
        return {name: float(rows[-1][name]) for name in course.names}

    return fly
