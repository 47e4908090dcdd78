"""Builder of a system's FMU: description, sources, libraries, parameter sets, documentation."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path, PurePath

from ....common.errors import InputError
from ....common.paths import CACHE, SYSTEMS
from ....fmus_src.evidence.manifest import Related, add_manifest
from ....fmus_src.export.archive import content_guid, write_zip
from ....fmus_src.export.compilers import PLATFORMS
from ....fmus_src.export.description.origin import accompanying_files, origin
from ....fmus_src.export.description.system import SystemVariable, system_description
from ....fmus_src.export.libraries import build_library
from ....fmus_src.export.native_fmu import read_wrapper
from ....fmus_src.own_digests import note_own
from ....fmus_src.units import BASE_UNITS, UnitDefinition
from ...runtime.ssp.archive import SystemArchive
from .choices import Preparation, candidate_name, check_slots, find_default
from .component_source import file_name, write_component_header
from .dependence import find_dependencies
from .documentation import PAGE, README, system_page, system_readme
from .fmu_variables import FmuVariable, Variables
from .model import SystemModel
from .one_fmu import OneFmu
from .parameter_sets import ConvertedSets, other_parameter_sets
from .reference import find_default_program, record_reference
from .system_in_c import write_system


def build_system_fmu(
    archive: SystemArchive,
    path: Path,
    request: OneFmu,
    platforms: Sequence[str],
    *,
    portable: bool,
) -> None:
    """Build a system as one FMU at ``path``; repeated builds are identical to the byte.

    ``portable`` compiles with zig even if the machine has another compiler. Raises InputError for a system that cannot
    be one FMU, `CompilerMissing` and `CompilationFailed`.
    """
    slots, options = request.slots, request.options
    preparation = Preparation(archive, options, slots)
    original = preparation.choice({}).prepared
    check_slots(slots, original.network)
    defaults = {slot: find_default(slot, candidates, original, options) for slot, candidates in slots.items()}
    model = SystemModel(preparation.choices(), request.exposed, request.faulty)
    variables = Variables(model, defaults, {slot: list(map(candidate_name, each)) for slot, each in slots.items()})
    if not variables.declared:
        problem = "has neither connectors nor parameters, so its FMU would have no variables"
        raise InputError(model.network.file, "system", problem, "give `expose` with a signal")
    _check_names(variables.declared, model.network.file)
    name = _model_identifier(archive.name, model)
    others = other_parameter_sets(preparation, model.network.description.system, variables.declared)
    is_ours = archive.path.resolve().is_relative_to(SYSTEMS.resolve())
    guid = content_guid(_files(name, model, variables, others, is_ours, ""))
    files = _files(name, model, variables, others, is_ours, guid)
    sources = {file.removeprefix("sources/"): text for file, text in files.items() if file.startswith("sources/")}
    for platform in platforms:
        library = build_library(sources, f"{name}.c", platform, CACHE, portable=portable)
        files[f"binaries/{platform}/{name}{PLATFORMS[platform].extension}"] = library
    page = Related(PAGE, "document", "text/html", "description of the system, its variables and its use")
    reference, related = record_reference(name, find_default_program(model.programs, defaults), variables.declared)
    write_zip(path, add_manifest({**files, **reference}, [page, *related]))
    note_own(path)


def _files(
    name: str, model: SystemModel, variables: Variables, others: ConvertedSets, is_ours: bool, guid: str
) -> dict[str, bytes]:
    """Return the files of the FMU except its binaries and manifest."""
    about = model.network.description.system.about or f"the system {name}"
    sources = read_wrapper(2, "system")
    sources |= {file_name(source): write_component_header(source).encode() for source in model.sources}
    sources[f"{name}.c"] = write_system(name, about, guid, model, variables).encode()
    dependencies = find_dependencies([choice.prepared for choice in model.choices], model.inputs, model.faulty)
    first = model.first
    description = system_description(
        name,
        about,
        [_as_system_variable(each) for each in variables.declared],
        dependencies,
        guid=guid,
        origin=origin(f"Perilune {version('perilune')}", is_ours=is_ours, is_final=guid != ""),
        experiment={
            "startTime": first.start,
            "stopTime": float(f"{first.start + first.steps * first.step:.12g}"),  # 0.3, not 0.30000000000000004
            "stepSize": first.step,
        },
        sources=[f"{name}.c"],
        units=_system_units(model),
    )
    return {
        "modelDescription.xml": description,
        **{f"sources/{file}": text for file, text in sources.items()},
        **others.files,
        **accompanying_files(2, is_ours=is_ours),
        PAGE: system_page(name, about, model, variables.declared, dependencies, others),
        README: system_readme(name, about).encode(),
    }


def _system_units(model: SystemModel) -> dict[str, UnitDefinition]:
    """Return the units of the system's connectors as its description defines them."""
    nodes = (node for choice in model.choices for node in choice.prepared.network.nodes.values())
    units = {node.unit.name: node.unit for node in nodes if node.unit is not None}
    return {
        name: UnitDefinition(
            {base: power for base, power in zip(BASE_UNITS, unit.exponents, strict=True) if power},
            unit.factor,
            unit.offset,
        )
        for name, unit in units.items()
        if unit.exponents is not None
    }


def _as_system_variable(variable: FmuVariable) -> SystemVariable:
    start = variable.start
    assert start is None or isinstance(start, float | int)
    return SystemVariable(
        variable.name,
        variable.causality,
        variable.type,
        variable.description,
        start,
        variable.unit,
        variable.minimum,
        variable.maximum,
        variable.enumeration,
        variable.tunable,
    )


def _check_names(declared: Sequence[FmuVariable], file: str) -> None:
    for name, count in Counter(each.name for each in declared).items():
        if count > 1:
            raise InputError(file, name, "two variables of the FMU would have this name", "rename one in the system")


def _model_identifier(system: str, model: SystemModel) -> str:
    """Return the C identifier of a system's FMU, which differs from the names of its components and of other files."""
    name = re.sub(r"\W", "_", system, flags=re.ASCII)
    name = name if not name[:1].isdigit() else f"fmu_{name}"
    used = {source.prefix.removesuffix("_") for source in model.sources} | {
        PurePath(file).stem for file in read_wrapper(2, "system")
    }
    return f"{name}_system" if name in used else name
