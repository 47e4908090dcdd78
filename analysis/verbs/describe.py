"""`perilune.describe` and `perilune describe`: description of a system, an FMU or a slot."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Unpack

from ...common.errors import InputError, suggestion
from ...common.paths import names_fmu
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.available import fmu_flavours
from ..authoring.campaign_listing import describe_campaign
from ..authoring.description import describe_system, variables_of
from ..authoring.fits import blocks_of_slot, slots
from ..documents.model import Document
from ..documents.of.description import description_document
from ..options.declared.library import DESCRIBE, DescribeOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.fmi.terminals import read_terminals
from ..runtime.ssp.archive import system_names
from ..runtime.system.alone import describe_alone
from ..runtime.system.component_fmus import locate_fmu
from ..runtime.system.fmu import load_fmu
from ..runtime.system.options import SystemOptions as System
from ..runtime.system.options import system_options
from ..runtime.system.prepared import PreparedSystem, prepare_system
from .common.documented import Documented


class Description(Documented, dict[str, Any]):
    """Description of a system, an FMU, a component or a slot, by key; see `describe`.

    ``prepare`` prepares the system of the block diagram: a system, or an FMU that can be simulated alone.
    """

    prepare: Callable[[], PreparedSystem] | None = None

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune describe --report`, one HTML file. Raises InputError without a block diagram."""
        from ..documents.of.system import system_document  # doubles the start-up time of describe
        from ..documents.render.html import write_document

        if self.prepare is None:
            problem = "only systems and FMUs have a block diagram"
            raise InputError("`report`", os.fspath(path), problem, "describe a system or an FMU, or leave out `report`")
        write_document(system_document(self.prepare()), Path(path))

    def document(self) -> Document:
        """Return the description as a document of lists."""
        return description_document(self)


@verb(DESCRIBE)
def describe(what: FilePath, component: str | None = None, **options: Unpack[DescribeOptions]) -> Description:
    """Describe a system, an FMU or a slot: `perilune describe`.

    The result is a dictionary. A system has the keys components, connections, connectors, parameter_sets, campaigns,
    frames and loops. An FMU, or a ``component`` of a system, has ``variables``, with ``items`` for Enumerations; an FMU
    also has ``alone`` (its stand-alone simulation, s), its ``undeclared_outputs``, whose dependencies it does not
    declare, and the variables of its ``terminals`` (FMI 3.0). A slot has ``variables`` and ``fmus``. A component states
    whether its outputs are treated as direct functions of its inputs (``feedthrough``), and why. With ``campaign`` the
    result describes a campaign of the system: ``values`` of all files that it extends, each with file and line. Raises
    InputError.
    """
    name, system = os.fspath(what), system_options(options)
    if options["campaign"] is not None:
        if component is not None or system != System():
            problem = "a campaign cannot be described together with a component or other options"
            raise InputError(
                "`campaign`", options["campaign"], problem, "leave out the component and the other options"
            )
        return Description(describe_campaign(name, options["campaign"]))
    if names_fmu(name) or name in catalogue() or name in fmu_flavours():
        if component is not None:
            raise InputError("describe", component, "an FMU has no components", "name a system before the component")
        return _describe_fmu(name, system)
    if name in slots():
        return _describe_slot(name)
    if name in system_names() or Path(name).exists():
        return _describe_system(name, component, system)
    known = [*system_names(), *slots(), *catalogue()]
    raise InputError("describe", name, "no system, FMU or slot has this name", suggestion(name, known))


def _describe_fmu(name: str, options: System) -> Description:
    read, label = locate_fmu(name, options.chosen["flavour"], "describe")
    content = read()
    fmu = load_fmu(content, label)
    if fmu.structural_parameters:
        fmu = next(iter(prepare_system(label, options).network.fmus.values()))
    alone, _ = describe_alone(fmu, options)
    described = Description(
        fmu=fmu.name,
        file=label,
        description=fmu.description.description or "",
        native=fmu.is_native,
        undeclared_outputs=[output for output, inputs in fmu.read_dependencies().items() if inputs is None],
        alone={
            "component": alone.system.name,
            "start_time": alone.start_time,
            "stop_time": alone.stop_time if options.chosen["stop_time"] is None else options.chosen["stop_time"],
            "step": alone.step if options.chosen["step"] is None else options.chosen["step"],
        },
        variables=variables_of(fmu, dict(fmu.sizes)),
        terminals=read_terminals(content, label) if fmu.version == 3 else {},
    )
    described.prepare = partial(prepare_system, label, options)
    return described


def _describe_slot(name: str) -> Description:
    slot = slots()[name]
    rows: list[dict[str, Any]] = [
        {"name": name, "causality": variable.causality, "tunable": False, "size": variable.size, "unit": variable.unit,
         "value": None, "minimum": variable.minimum, "maximum": variable.maximum, "from": None,
         "description": variable.description, "items": []}
        for name, variable in slot.variables.items()
    ]  # fmt: skip
    return Description(
        slot=name,
        interface=slot.__name__,
        description=slot.summary(),
        variables=rows,
        fmus={block.fmu_name: block.summary() for block in blocks_of_slot(slot)},
    )


def _describe_system(name: str, component: str | None, options: System) -> Description:
    prepared = prepare_system(name, options)
    document = describe_system(prepared)
    if component is None:
        described = Description(document)
        described.prepare = lambda: prepared
        return described
    components = {entry["name"]: entry for entry in document["components"]}
    if component not in components:
        raise InputError("describe", component, "no such component", suggestion(component, components))
    connections = [row for row in document["connections"] if component in (row["from"], row["to"])]
    return Description(components[component], system=document["system"], connections=connections)
