"""How far a child has come, by what it writes into its recorder, and in words where it has ended."""

from __future__ import annotations

from ..flight.recorder import FlightRecorder, Phase
from ..system.prepared import PreparedSystem


def measure(recorder: FlightRecorder) -> bytes:
    """What changes as long as FMUs return."""
    return recorder.outcome.tobytes() + recorder.phase.tobytes()


def count_rows(recorder: FlightRecorder, first: int, every: int) -> int:
    """Return the number of rows that an unfinished flight from a communication point has left; every n-th is kept."""
    return min(max(-(-(recorder.point - max(first, -1) - 1) // every), 0), recorder.times.size)


def component_in_phase(prepared: PreparedSystem, recorder: FlightRecorder) -> str:
    """The component that the child was instantiating, resetting or freeing."""
    return _component(prepared, int(recorder.phase[1]))


def describe(prepared: PreparedSystem, recorder: FlightRecorder) -> str:
    """The component whose function was called last, and when."""
    if recorder.phase[0] == Phase.INSTANTIATION:
        return f"{component_in_phase(prepared, recorder)}: while it was instantiated"
    component = _component(prepared, recorder.subject)
    if not recorder.point:
        return f"{component}: in the initialisation"
    return f"{component}: on the way to t = {prepared.start + recorder.point * prepared.step:g} s"


def _component(prepared: PreparedSystem, number: int) -> str:
    """A component's name; the number is what a child wrote, which may be anything."""
    names = list(prepared.network.fmus)
    return names[number] if 0 <= number < len(names) else "a component"
