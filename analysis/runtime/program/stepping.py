"""Event mode of FMI 3.0, and steps that return early."""

from __future__ import annotations

from fmpy.fmi3 import FMU3Slave

from .component import FailedError, TerminationError
from .times import tolerance_of

MOST_ROUNDS = 1000  # event iterations, and successive steps that do not advance


def enter_step_mode(name: str, slave: FMU3Slave, time: float) -> None:
    """Bring a component from event mode to step mode once its discrete states at a time (s) have settled.

    Raises TerminationError if the component ends the simulation, FailedError if its states do not settle.
    """
    for _ in range(MOST_ROUNDS):
        needs_update, wants_end, *_ = slave.updateDiscreteStates()
        if wants_end:
            raise TerminationError(name, time)
        if not needs_update:
            slave.enterStepMode()
            return
    raise FailedError(f"{name} does not settle in event mode")


def step_to(name: str, slave: FMU3Slave, begin: float, size: float, end: float, *, uses_events: bool) -> None:
    """Step to the end (s); continue from each time at which the FMU returns early, and handle events when they occur.

    Raises TerminationError if the FMU ends the simulation, FailedError if it does not advance or returns a time outside
    the step.
    """
    time, rounds = begin, 0
    while rounds <= MOST_ROUNDS:
        has_event, wants_end, is_early, last = slave.doStep(time, size)
        allowed = tolerance_of(begin, end)
        if is_early and not time - allowed <= last <= end + allowed:
            raise FailedError(f"{name} returned early at {last} s, outside of its step")
        is_early = is_early and end - last > allowed
        if wants_end:
            raise TerminationError(name, last if is_early else end)
        if has_event and uses_events:
            slave.enterEventMode()
            enter_step_mode(name, slave, last if is_early else end)
        if not is_early:
            return
        rounds = rounds + 1 if last <= time else 0
        time, size = last, end - last
    raise FailedError(f"{name} does not advance")
