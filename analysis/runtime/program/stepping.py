"""Event mode of FMI 3.0, and steps that end early."""

from __future__ import annotations

from fmpy.fmi3 import FMU3Slave

from .component import EndedError, FailedError
from .times import tolerance_of

MOST_ROUNDS = 1000  # of event iterations, and of steps in a row that return where they began


def enter_step_mode(name: str, slave: FMU3Slave, time: float) -> None:
    """Bring a component from event mode to step mode as soon as its discrete states at a time (s) have settled.

    Raises EndedError where it ends the simulation, FailedError where they never settle.
    """
    for _ in range(MOST_ROUNDS):
        needs_update, wants_end, *_ = slave.updateDiscreteStates()
        if wants_end:
            raise EndedError(name, time)
        if not needs_update:
            slave.enterStepMode()
            return
    raise FailedError(f"{name} does not settle in event mode")


def step_to(name: str, slave: FMU3Slave, begin: float, size: float, end: float, *, uses_events: bool) -> None:
    """Step to the end (s), again from where the FMU returns early; events are handled where they occur.

    Raises EndedError where it ends the simulation, FailedError where it does not advance or returns from outside.
    """
    time, rounds = begin, 0
    while rounds <= MOST_ROUNDS:
        has_event, wants_end, is_early, last = slave.doStep(time, size)
        allowed = tolerance_of(begin, end)
        if is_early and not time - allowed <= last <= end + allowed:
            raise FailedError(f"{name} returned early at {last} s, outside of its step")
        is_early = is_early and end - last > allowed
        if wants_end:
            raise EndedError(name, last if is_early else end)
        if has_event and uses_events:
            slave.enterEventMode()
            enter_step_mode(name, slave, last if is_early else end)
        if not is_early:
            return
        rounds = rounds + 1 if last <= time else 0
        time, size = last, end - last
    raise FailedError(f"{name} does not advance")
