"""This project's compiled loop."""

from __future__ import annotations

from ..runtime.flight.simulation import Simulation
from .contestant import Fly, Values
from .course import Course


def prepare(course: Course, algorithm: str = "sequential") -> Fly:
    """`Simulation`, its instances reset and reused; flies on after ``finished``, as the others do."""
    simulation = Simulation(course.flight(1, algorithm), wanted=course.names)
    simulation.program = simulation.program._replace(finished_slot=-1)

    def fly(steps: int) -> Values:
        simulation.prepared = course.flight(steps, algorithm)
        result = simulation.fly(every=max(1, steps))
        if not result.complete:
            raise RuntimeError(f"{result.status}: {result.message}")
        return {name: float(values[-1]) for name, values in result.signals.items()}

    return fly
