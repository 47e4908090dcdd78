"""What a system, an FMU or a slot has, as plain values."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.available import fmu_flavours
from ..authoring.describe.fits import blocks_of_slot, slots
from ..authoring.describe.system import describe_system
from ..authoring.describe.variables import variables_of
from ..common.errors import InputError, suggestion
from ..runtime.ssp.archive import system_names
from ..runtime.ssp.parameter_sets import SetValue
from ..runtime.system.alone import describe_alone
from ..runtime.system.fmu import load_fmu
from ..runtime.system.options import SystemOptions
from ..runtime.system.prepared import find_fmu, prepare_system
from .options import FilePath, system_options


def describe(
    what: FilePath,
    component: str | None = None,
    *,
    use: Mapping[str, FilePath] | None = None,
    parameters: Sequence[FilePath] = (),
    set: Mapping[str, SetValue] | None = None,
    step: float | None = None,
    stop_time: float | None = None,
    algorithm: Literal["sequential", "jacobi"] | None = None,
    variant: str | None = None,
    flavour: Literal["native", "python"] | None = None,
    allow_unmatched: bool = False,
    strict: bool = False,
    open_inputs: Literal["refuse", "start"] = "refuse",
    feedthrough: Sequence[str] = (),
    no_feedthrough: Sequence[str] = (),
) -> dict[str, Any]:
    """What a system, an FMU or a slot has: `perilune describe`, as a dictionary.

    ``what`` is a system, an FMU by name or file, or an interface by name; ``component`` one of a system, with all its
    variables. Of a system the keys are components, connections, connectors, parameter_sets, campaigns, loops; of an FMU
    or a component ``variables``, and how an FMU flies ``alone`` (s); of a slot ``fmus`` too. A component says whether
    outputs are taken to depend directly on inputs (``feedthrough``) and where that comes from, an FMU of which outputs
    it does not declare it. The rest is as in `simulate`. Raises InputError.
    """
    options = system_options(
        use, parameters, set, feedthrough, no_feedthrough, step=step, stop_time=stop_time, algorithm=algorithm,
        variant=variant, flavour=flavour, allow_unmatched=allow_unmatched, strict=strict, open_inputs=open_inputs,
    )  # fmt: skip
    return described(os.fspath(what), component, options)


def described(what: str, component: str | None, options: SystemOptions) -> dict[str, Any]:
    """Likewise, with the options of a command line."""
    if what.endswith(".fmu") or what in catalogue() or what in fmu_flavours():
        if component is not None:
            raise InputError("describe", component, "an FMU has no components", "name a system before it")
        return _fmu(what, options)
    if what in slots():
        return _slot(what)
    if what in system_names() or Path(what).exists():
        return _system(what, component, options)
    known = [*system_names(), *slots(), *catalogue()]
    raise InputError("describe", what, "no system, FMU or slot of this name", suggestion(what, known))


def _fmu(what: str, options: SystemOptions) -> dict[str, Any]:
    data, label = find_fmu(what, options.flavour, "describe")
    fmu = load_fmu(data, label)
    alone, _ = describe_alone(fmu, options)
    return {
        "fmu": fmu.name,
        "file": label,
        "description": fmu.description.description or "",
        "native": fmu.is_native,
        "undeclared_outputs": [name for name, inputs in fmu.declared_dependencies().items() if inputs is None],
        "alone": {
            "component": alone.system.name,
            "start_time": alone.start_time,
            "stop_time": alone.stop_time if options.stop_time is None else options.stop_time,
            "step": alone.step if options.step is None else options.step,
        },
        "variables": variables_of(fmu),
    }


def _slot(what: str) -> dict[str, Any]:
    slot = slots()[what]
    rows = [
        {"name": name, "causality": variable.causality, "size": variable.size, "unit": variable.unit, "value": None,
         "minimum": variable.minimum, "maximum": variable.maximum, "from": None, "description": variable.description}
        for name, variable in slot.variables.items()
    ]  # fmt: skip
    fmus = {block.fmu_name: block.summary() for block in blocks_of_slot(slot)}
    return {
        "slot": what,
        "interface": slot.__name__,
        "description": slot.summary(),
        "variables": rows,
        "fmus": fmus,
    }


def _system(what: str, component: str | None, options: SystemOptions) -> dict[str, Any]:
    document = describe_system(prepare_system(what, options))
    if component is None:
        return document
    found = {entry["name"]: entry for entry in document["components"]}
    if component not in found:
        raise InputError("describe", component, "no such component", suggestion(component, found))
    own = [row for row in document["connections"] if component in (row["from"], row["to"])]
    return found[component] | {"system": document["system"], "connections": own}
