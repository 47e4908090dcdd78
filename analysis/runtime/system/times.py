"""Start, end and step of a system, and the steps of its components."""

from __future__ import annotations

import math

from ....common.errors import InputError
from ..fmi.proposals import step_of_experiment
from ..ssp.archive import OSP_SUFFIX
from .network import Network
from .options import STEP_ROUNDING, SystemOptions

LONGEST_PERIOD = 10_000  # most communication steps in a component's step


class MissingStopTimeError(InputError):
    """Stop time that is stated neither by the system nor by the options.

    ``earliest`` (s) is the end of the first communication step.
    """

    earliest = 0.0


def flight_times(network: Network, options: SystemOptions) -> tuple[float, float, int]:
    """Return start (s), communication step (s) and number of steps. Raises InputError."""
    description, chosen = network.description, options.chosen
    if chosen["step"] is None and description.varies is not None:
        line = f"step (line {description.varies})"
        raise InputError(network.file, line, "a variable step is not supported", "give a fixed step with `step`")
    declared = chosen["step"] if chosen["step"] is not None else _read_step(network)
    step = declared if declared is not None else _shortest_proposal(network)
    if step is None:
        raise InputError(network.file, "step", "neither the SSD nor an FMU proposes a step", "give `step`")
    if not 0.0 < step < float("inf"):
        raise InputError("`step`", str(step), "not a positive number of seconds", "give a positive step")
    stop = chosen["stop_time"] if chosen["stop_time"] is not None else description.stop_time
    is_osp = network.file.endswith(OSP_SUFFIX)
    experiment = network.file if is_osp else f"{network.file}: DefaultExperiment"
    if stop is None:
        element = "EndTime" if is_osp else "stopTime"
        error = MissingStopTimeError(experiment, element, "missing", "give `stop_time`")
        error.earliest = description.start_time + step
        raise error
    start = description.start_time
    if not math.isfinite(start):
        raise InputError(experiment, "startTime", f"{start} is not finite", "give a finite start time")
    step_option = ("`step`", f"{step:g}")
    stop_option = (
        ("`stop_time`", f"{stop:g}") if chosen["stop_time"] is not None else (experiment, f"stopTime {stop:g}")
    )
    duration = stop - start
    if duration < 0.0:
        raise InputError(*stop_option, f"lies before the start, {start:g} s", "give a later stop time")
    if max(abs(stop), abs(start)) + step == max(abs(stop), abs(start)):
        problem = f"a step of {step:g} s does not advance a time of {stop:g} s"
        requested = step_option if chosen["step"] is not None else stop_option
        raise InputError(*requested, problem, "give a longer `step` or earlier times")
    steps = round(duration / step) if duration / step < float("inf") else -1
    if 0.0 < duration * (1.0 + STEP_ROUNDING) < step and (chosen["step"] is not None or chosen["stop_time"] is None):
        problem = f"longer than the simulation of {duration:g} s"
        requested = step_option if chosen["step"] is not None else (network.file, f"step {step:g}")
        raise InputError(*requested, problem, "give a shorter `step`")
    if steps < 0 or abs(steps * step - duration) > STEP_ROUNDING * max(min(step, duration), abs(stop)):
        problem = f"{duration:g} s from the start are not a whole number of steps of {step:g} s"
        remedy = f"give for instance `stop_time` {start + max(1, steps) * step:.12g}"
        raise InputError(*stop_option, problem, remedy)
    return start, step, steps


def component_periods(network: Network, options: SystemOptions, step: float) -> dict[str, int]:
    """Return the number of communication steps in each component's own step, for components with more than one.

    A step that is not a multiple of the communication step ``step`` (s) is rounded down, as in libcosim, with a remark.
    Raises InputError.
    """
    periods = {}
    for name, component in network.components():
        own = component.step
        if own is None and options.chosen["step"] is None:
            own = _step_of_system(network, name)
        period = 1 if own is None else max(1, int(own / step * (1.0 + STEP_ROUNDING)))
        if period > LONGEST_PERIOD:
            problem = f"its step of {own:g} s spans more than {LONGEST_PERIOD} communication steps of {step:g} s"
            raise InputError(network.file, f"{name} (line {component.line})", problem, "give a longer `step`")
        if own is not None and abs(own - period * step) > STEP_ROUNDING * own:
            network.notes.append(f"{name}: steps by {period * step:g} s, not by the requested {own:g} s")
        if period > 1:
            periods[name] = period
    if math.lcm(*periods.values()) > LONGEST_PERIOD:
        problem = f"the steps of its components have no common multiple within {LONGEST_PERIOD} steps of {step:g} s"
        raise InputError(network.file, "steps", problem, "give a longer `step`")
    return periods


def _read_step(network: Network) -> float | None:
    """Return the shortest step (s) of the description and inner systems; None if the description states no step."""
    inner = [system.step for path, system in network.systems.items() if path and system.step is not None]
    return None if network.description.step is None else min([network.description.step, *inner])


def _shortest_proposal(network: Network) -> float | None:
    """Return the shortest step (s) of the default experiments of FMUs, or None. Raises InputError."""
    fmus = {fmu.label: fmu.description for fmu in network.fmus.values()}
    steps = [step_of_experiment(description, label, network.notes) for label, description in fmus.items()]
    return min((step for step in steps if step is not None), default=None)


def _step_of_system(network: Network, component: str) -> float | None:
    """Return the step (s) stated by the innermost system around a component."""
    path = component
    while "." in path:
        path = path[: path.rindex(".")]
        system = network.systems.get(f"{path}.")
        if system is not None and system.step is not None:
            return system.step
    return network.description.step
