"""Steps and event mode of FMUs of FMI 3.0."""

from __future__ import annotations

from ....common.compiler import compile_cached
from . import codes
from .fmi3_calls import do_step_to_event, update_discrete_states
from .fmi_calls import change_mode
from .rounding import allowance

MOST_ROUNDS = 1000  # of event iterations, and of steps that return where they began


def _settle(functions, instance, stored, outcome):  # type: ignore[no-untyped-def]
    """From event mode to step mode, as soon as the discrete states have settled; returns the fmi3Status.

    An FMU that ends the simulation, or that never settles, becomes the outcome.
    """
    for _ in range(MOST_ROUNDS):
        outcome[2] = codes.UPDATE_DISCRETE_STATES
        status = update_discrete_states(functions[codes.UPDATE_DISCRETE_STATES], instance, stored.flags, stored.time)
        if status < 0 or status > codes.FMI_WARNING:
            return status
        if stored.flags[1] != 0:
            outcome[0] = codes.ENDED
            return status
        if stored.flags[0] == 0:
            outcome[2] = codes.ENTER_STEP_MODE
            return change_mode(functions[codes.ENTER_STEP_MODE], instance)
    outcome[0] = codes.STUCK
    return status


settle = compile_cached(_settle)
allowance_of = compile_cached(allowance)


def _step(functions, instance, begin, step, end, uses_events, stored, outcome):  # type: ignore[no-untyped-def]
    """Step to the end, again where the FMU returns early; events are handled when they occur.

    An early return at a time that is not in its step becomes the outcome, with the beginning of that step.
    """
    time, rounds = begin, 0
    allowed = allowance_of(begin, end)
    while True:
        outcome[2] = codes.DO_STEP
        status = do_step_to_event(functions[codes.DO_STEP], instance, time, step, stored.flags, stored.time)
        if status < 0 or status > codes.FMI_WARNING:
            return status
        last = stored.time[0]
        if stored.flags[2] != 0 and not time - allowed <= last <= end + allowed:  # NaN is not, either
            outcome[0] = codes.OUTSIDE_STEP
            stored.time[1] = time
            return status
        is_early = stored.flags[2] != 0 and end - last > allowed
        now = last if is_early else end
        if stored.flags[1] != 0:
            outcome[0] = codes.ENDED
            stored.time[1] = now
            return status
        if stored.flags[0] != 0 and uses_events:
            outcome[2] = codes.ENTER_EVENT_MODE
            status = change_mode(functions[codes.ENTER_EVENT_MODE], instance)
            if 0 <= status <= codes.FMI_WARNING:
                status = settle(functions, instance, stored, outcome)
            if outcome[0] != 0 or status < 0 or status > codes.FMI_WARNING:
                stored.time[1] = now
                return status
        if not is_early:
            return status
        rounds = rounds + 1 if last <= time else 0
        if rounds > MOST_ROUNDS:
            outcome[0] = codes.STUCK
            return status
        time, step = last, end - last


step_to = compile_cached(_step)
