"""End of a simulation: the outcome of the loop, translated to a status and a message."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from fmpy import fmi2

from ..instances.fmu_library import FUNCTION_NAMES
from ..instances.instance import Instance, status_word
from ..loop import arrays, codes
from ..loop.library import load_library
from ..ssp.names import split_name
from .program import Layout

TERMINATED = "terminated"  # an FMU requested the end
STATUS = {
    codes.STOP_TIME: "stop_time",
    codes.FINISHED: "finished",
    codes.NONFINITE: "nonfinite",
    codes.FAILED: "failed",
    codes.UNMAPPED: "failed",
    codes.INTERRUPTED: "interrupted",
    codes.NOT_TAKEN: "failed",
    codes.TOO_LONG: "failed",
    codes.ENDED: TERMINATED,
    codes.STUCK: "failed",
    codes.OUTSIDE_STEP: "failed",
}
FLIGHT_STATUSES = set(STATUS.values())
ENTER, EXIT = (
    [FUNCTION_NAMES.index(f"fmi{version}{mode}InitializationMode") for version in (2, 3)] for mode in ("Enter", "Exit")
)
DO_STEP = ("fmi2DoStep", "fmi3DoStep")
SETTERS = (codes.PARAMETERS, codes.WHOLE_PARAMETERS, codes.TEXT_PARAMETERS, codes.GIVE_PARAMETERS)
READ_BACKS = (codes.READ_BACK, codes.WHOLE_READ_BACK, codes.TEXT_READ_BACK, codes.TAKE_BACK)


class Outcome(NamedTuple):
    """Contents of `arrays.Buffers.outcome`: end code, and the component, slot or parameter that it concerns.

    ``function``, ``fmi_status`` and ``instruction`` describe failures only.
    """

    code: int
    subject: int
    function: int
    fmi_status: int
    point: int
    instruction: int

    @property
    def is_well(self) -> bool:
        """True if the simulation ended without a failure."""
        return self.code in (codes.STOP_TIME, codes.FINISHED, codes.INTERRUPTED)

    @property
    def is_discarded_step(self) -> bool:
        return self._failure(fmi2.fmi2Discard) and FUNCTION_NAMES[self.function] in DO_STEP

    @property
    def is_ended(self) -> bool:
        """True if an FMU has ended the simulation (FMI 3.0, terminateSimulation)."""
        return self.code == codes.ENDED

    @property
    def is_fatal(self) -> bool:
        """True if no instance of the FMU may be used again: fmi2Fatal (FMI 2.0), or an undefined status."""
        return self.code == codes.FAILED and not 0 <= self.fmi_status < fmi2.fmi2Fatal

    @property
    def is_error(self) -> bool:
        """True if the instance may only be reset or freed (FMI 2.0, fmi2Error)."""
        return self._failure(fmi2.fmi2Error)

    def is_unreadable(self, program: arrays.Program) -> bool:
        """Return True if an FMU did not return a parameter."""
        if not (self.is_error or self._failure(fmi2.fmi2Discard)):
            return False
        return int(program.instructions[self.instruction, codes.CODE]) in READ_BACKS

    def is_refused_again(self, program: arrays.Program) -> bool:
        """Return True if an FMU refused parameters in initialisation mode that it had accepted before that mode."""
        if not (self.is_error or self._failure(fmi2.fmi2Discard)):
            return False
        row = program.instructions[self.instruction]
        before = program.instructions[: self.instruction]
        enters = np.isin(before[before[:, codes.COMPONENT] == row[codes.COMPONENT], codes.FUNCTION], ENTER)
        return int(row[codes.CODE]) in SETTERS and bool(enters.any())

    def _failure(self, status: int) -> bool:
        return self.code == codes.FAILED and self.fmi_status == status


def end_request(instance: Instance) -> float | None:
    """Return the time (s) at which an FMU that discarded a step asks to end the simulation, or None.

    Perilune's FMUs never ask for an end: pythonfmu reports a failed step of a block as such a request.
    """
    if instance.fmu.is_own or instance.fmu.version == 3:  # FMI 3.0 reports it with the step
        return None
    try:
        if instance.slave.getBooleanStatus(fmi2.fmi2Terminated):
            return float(instance.slave.getRealStatus(fmi2.fmi2LastSuccessfulTime))
    except Exception:  # FMPy raises bare Exception if the FMU reports no time
        return None
    return None


def describe_outcome(
    outcome: Outcome,
    time: float,
    layout: Layout,
    buffers: arrays.Buffers,
    fmi3: arrays.Fmi3 | None,
    instances: Mapping[str, Instance],
) -> tuple[str, str]:
    """Return status and message of an outcome; ``time`` (s) is the time of the last communication point."""
    code, subject = outcome.code, outcome.subject
    status = STATUS[code]
    if code == codes.NONFINITE:
        value = buffers.values[subject]
        name = list(layout.slots)[subject]
        beyond = f", beyond {_limits(name, instances)}," if np.isfinite(value) else ""
        return status, f"{name} is {value}{beyond} at t = {time:g} s"
    if code == codes.UNMAPPED:
        name, value = list(layout.slots)[subject], buffers.values[subject]
        return status, f"{name}: the mapping of its connection has no entry for {value:g} at t = {time:g} s"
    if code == codes.INTERRUPTED:
        return status, f"interrupted at t = {time:g} s"
    if code == codes.TOO_LONG:
        if subject < 0:
            name, longest = list(layout.binaries.slots)[-1 - subject], layout.binaries.longest
            return status, f"{name} gave a binary value of more than {longest} bytes at t = {time:g} s"
        longest = layout.texts.longest
        return status, f"{list(layout.texts.slots)[subject]} gave a string of {longest} bytes or more at t = {time:g} s"
    if code == codes.STUCK:
        component = list(instances)[subject]
        token = (
            "does not settle in event mode" if outcome.function == codes.UPDATE_DISCRETE_STATES else "does not advance"
        )
        log = " | ".join(instances[component].messages) or "no message in its log"
        return status, f"{component}: {FUNCTION_NAMES[outcome.function]} {token} at t = {time:g} s: {log}"
    if code == codes.OUTSIDE_STEP and fmi3 is not None:
        last, begin = fmi3.stored.time.tolist()
        return status, _outside_words("fmi3DoStep returned early", last, begin, time, subject, instances)
    if code == codes.NOT_TAKEN:
        parameters = layout.parameters
        component, variable = parameters.keys[subject]
        confirmed = parameters.words if fmi3 is None else fmi3.confirmed
        assigned = parameters[parameters.keys[subject]]
        actual = parameters.value_in(buffers.read_back, confirmed, subject)
        words = (
            f"{component}.{variable}: was set to {assigned}, but has the value {actual} in its FMU after initialisation"
        )
        return status, " | ".join([f"{words}: the FMU did not accept the value", *instances[component].messages])
    if code == codes.FAILED:
        component = list(instances)[subject]
        log = " | ".join(instances[component].messages) or "no message in its log"
        token = status_word(outcome.fmi_status)
        if outcome.is_discarded_step and instances[component].fmu.version == 2:
            token += " without asking for termination"
        return status, f"{component}: {FUNCTION_NAMES[outcome.function]} returned {token} at t = {time:g} s: {log}"
    return status, ""


def describe_termination(
    time: float, begin: float, end: float, subject: int, instances: Mapping[str, Instance]
) -> tuple[str, str]:
    """Return status and message of a simulation that an FMU ended at ``time`` (s) during its step.

    The step is from ``begin`` to ``end`` (s). The status is ``failed`` if ``time`` is outside the step.
    """
    allowed = load_library().perilune_time_allowance(begin, end)
    if not begin - allowed <= time <= end + allowed:  # also rejects NaN
        words = "fmi2DoStep asked for termination with status discard"
        return STATUS[codes.OUTSIDE_STEP], _outside_words(words, time, begin, end, subject, instances)
    component, instance = list(instances.items())[subject]
    said = f": {' | '.join(instance.messages)}" if instance.messages else ""
    return TERMINATED, f"{component} asked for termination at t = {time:g} s{said}"


def _outside_words(
    said: str, last: float, begin: float, end: float, subject: int, instances: Mapping[str, Instance]
) -> str:
    """Return the message for a lastSuccessfulTime (s) outside the step from ``begin`` to ``end`` (s)."""
    component, instance = list(instances.items())[subject]
    log = " | ".join(instance.messages) or "no message in its log"
    step = f"its step from {begin:.12g} s to {end:.12g} s"
    return f"{component}: {said} with lastSuccessfulTime {last:.12g} s, which is not in {step}: {log}"


def _limits(name: str, instances: Mapping[str, Instance]) -> str:
    """Return the limits that a connector's value exceeds, as text."""
    component, variable = split_name(name, instances)
    stored = instances[component].fmu.variables[variable].representation
    return "the 32 bits of an Integer" if stored.name == "Int32" else f"the limits of {stored.name}"


def check_initialisation(outcome: Outcome, program: arrays.Program, count: int) -> list[bool]:
    """Return, for each of ``count`` components, whether it left initialisation mode in the last start."""
    reached = [True] * count
    if outcome.is_well or outcome.instruction >= program.phases[0]:
        return reached
    exits = np.isin(program.instructions[: program.phases[0], codes.FUNCTION], EXIT)
    for row in np.flatnonzero(exits):
        reached[int(program.instructions[row, codes.COMPONENT])] = bool(row < outcome.instruction)
    return reached
