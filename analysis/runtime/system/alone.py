"""Stand-alone FMU, described as a system of one component without an SSD."""

from __future__ import annotations

import math
import re

from fmpy.util import auto_interval

from ....common.errors import InputError
from ..fmi.proposals import proposed_step
from ..fmi.representations import TEXTS
from ..ssp.system_description import Component, Connector, SystemDescription, SystemElement
from .fmu import Fmu
from .options import STEP_ROUNDING, SystemOptions

CONNECTED = ("input", "output", "parameter")
DURATION = 1.0  # s, if the FMU proposes no end; also the default of FMPy


def describe_alone(fmu: Fmu, options: SystemOptions) -> tuple[SystemDescription, list[str]]:
    """Return the description of a system of one FMU, and remarks on defaults for values that the FMU does not propose.

    Inputs, outputs and parameters are the component's connectors; the FMU's default experiment determines start, end
    and step. By default the start is 0, the end is 1 s later, and the step is the FMU's internal step or FMPy's
    `auto_interval` of the duration. Unless the end is requested, it is the last multiple of the step before the FMU's
    end. Raises InputError for a variant, since an FMU has no variants.
    """
    if options.chosen["variant"] is not None:
        raise InputError(fmu.label, "`variant`", "an FMU alone has no variants", "leave out `variant`")
    connectors = {
        variable.name: Connector(variable.name, variable.causality, variable.type, None, None, 0)
        for variable in fmu.variables.values()
        if variable.causality in CONNECTED and not (variable.type in TEXTS and variable.causality != "parameter")
    }
    # the component's name is that of the model, or the FMU's C identifier
    name = fmu.name if fmu.name.isidentifier() else re.sub(r"\W", "_", fmu.description.coSimulation.modelIdentifier)
    component = Component(name, connectors, [], 0, fmu.label)
    start, stop, step, remarks = _times(fmu, options)
    remarks += [
        f"{name}.{variable.name}: a {variable.type} {variable.causality}, not exchanged"
        for variable in fmu.variables.values()
        if variable.type in TEXTS and variable.causality in ("input", "output")
    ]
    root = SystemElement(name, {}, [], 0, elements={name: component})
    return SystemDescription(fmu.label, fmu.name, root, {}, {}, start, stop, step), remarks


def _times(fmu: Fmu, options: SystemOptions) -> tuple[float, float, float, list[str]]:
    """Return start, end and step (s), and remarks on them."""
    experiment = fmu.description.defaultExperiment
    start, stop = (
        None if value is None else float(value)
        for value in (getattr(experiment, "startTime", None), getattr(experiment, "stopTime", None))
    )
    remarks: list[str] = []
    step = options.chosen["step"]
    if step is None:
        step = proposed_step(fmu.description, fmu.label, remarks)
    start = 0.0 if start is None else start
    if stop is None:
        stop = start + DURATION
        if options.chosen["stop_time"] is None:
            remarks.append(f"the FMU proposes no stop time: {stop:g} s is used")
    if step is None:
        duration = (stop if options.chosen["stop_time"] is None else options.chosen["stop_time"]) - start
        step = float(auto_interval(duration if duration > 0.0 else DURATION))
        remarks.append(f"the FMU proposes no step: {step:g} s is used")
    ratio = (stop - start) / step if step else math.nan  # a step of 0 is rejected later, as for all systems
    steps = math.floor(ratio + STEP_ROUNDING) if 0.0 < ratio < math.inf else 0
    if options.chosen["stop_time"] is None and steps and ratio - steps > STEP_ROUNDING:
        whole = start + steps * step
        remarks.append(
            f"{stop - start:g} s are not a whole number of steps of {step:g} s: the simulation ends at {whole:g} s"
        )
        stop = whole
    return start, stop, step, remarks
