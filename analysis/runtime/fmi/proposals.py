"""Communication steps proposed by FMUs: the step of the default experiment, or a fixed internal step."""

from __future__ import annotations

import math

from fmpy.model_description import ModelDescription

from ....common.errors import InputError
from ..ssp.fmu_description import DESCRIPTION


def step_of_experiment(description: ModelDescription, label: str, notes: list[str]) -> float | None:
    """Return the step (s) of an FMU's default experiment, or None if it states no step.

    Some tools write 0 for no step, which is reported in a note. Raises InputError for any other value that is not a
    positive number.
    """
    text = getattr(description.defaultExperiment, "stepSize", None)
    return _seconds(text, STEP_SIZE, label, notes)


def proposed_step(description: ModelDescription, label: str, notes: list[str]) -> float | None:
    """Return the step (s) of an FMU's default experiment, else its fixed internal step, else None."""
    step = step_of_experiment(description, label, notes)
    return step or _seconds(description.coSimulation.fixedInternalStepSize, INTERNAL_STEP_SIZE, label, notes)


STEP_SIZE = "DefaultExperiment, stepSize"
INTERNAL_STEP_SIZE = "CoSimulation, fixedInternalStepSize"


def _seconds(text: str | None, attribute: str, label: str, notes: list[str]) -> float | None:
    seconds = 0.0 if text is None else float(text)
    where = f"{DESCRIPTION}: {attribute}"
    if not 0.0 <= seconds < math.inf:
        problem = f"{text} is not a positive number of seconds"
        raise InputError(label, where, problem, f"fix the FMU's {DESCRIPTION}, or give `step`")
    if seconds == 0.0 and text is not None:
        notes.append(f"{label}: {where}: {text} is not a step size, and is ignored")
    return seconds or None
