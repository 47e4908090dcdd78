"""Assembly of a composed system: loads the FMUs, resolves connections, and writes the SSD."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from ...common.errors import InputError, SeveralProblemsError, suggestion
from ...common.paths import names_fmu
from ...fmus_src.block import snake_case
from ...fmus_src.export.available import fmu_flavours
from ...fmus_src.export.ssp_package import DESCRIPTION, system_files
from ..runtime.ssp.archive import HOW_TO_BUILD, SystemArchive
from ..runtime.system.fmu import Fmu, load_fmu
from .document import fmu_source, set_source, write_document
from .source import SystemSource
from .wiring import wire


def folder_archive(folder: Path, files: Mapping[str, bytes], description: str = DESCRIPTION) -> SystemArchive:
    """Return a folder as a system archive, with ``files`` (content by archive name) added or replaced."""
    path = folder.resolve()
    return SystemArchive(path.name, str(folder), path, {**system_files(path), **files}, description)


def load_fmus(source: SystemSource, archive: SystemArchive, flavour: str | None = None) -> dict[str, Fmu]:
    """Return the FMUs by component. Raises SeveralProblemsError with a line for each missing FMU or parameter set."""
    loaded: dict[str, Fmu] = {}
    fmus: dict[str, Fmu] = {}
    problems: list[str] = []
    for name, component in source.components.items():
        try:
            read, label = archive.fmu(fmu_source(component.fmu), name, flavour)
            if label not in loaded:
                loaded[label] = load_fmu(read(), label)
            fmus[name] = loaded[label]
        except InputError as error:
            if names_fmu(component.fmu) or error.element != name or component.fmu in fmu_flavours():
                problems.append(error.text)
                continue
            file = _file_of_block(component.fmu, archive)
            remedy = f"{suggestion(component.fmu, fmu_flavours())}; {HOW_TO_BUILD}"
            remedy = remedy if file is None else f"perilune export {file} builds it"
            problems.append(source.problem(component.where, f"no FMU {component.fmu} is built", remedy).text)
    for name in source.parameter_sets:
        if not archive.has(set_source(name)):
            known = [Path(each).name for each in archive.files if each.endswith(".ssv")]
            problem = f"no parameter set {name} in the system's folder"
            problems.append(source.problem("parameters", problem, suggestion(name, known)).text)
    if problems:
        raise SeveralProblemsError(*problems)
    return fmus


def _file_of_block(fmu: str, archive: SystemArchive) -> Path | None:
    """Return the Python file in the system's folder that defines a class for this FMU; only its text is searched."""
    for path in sorted(archive.path.glob("*.py")):
        classes = re.findall(r"^class (\w+)\(", path.read_text(encoding="utf-8", errors="replace"), re.MULTILINE)
        if fmu in map(snake_case, classes):
            return Path(archive.label) / path.name
    return None


def compose_document(source: SystemSource, archive: SystemArchive) -> bytes:
    """Return the SSD of a system. Raises InputError, with a line for each problem."""
    fmus = load_fmus(source, archive)
    return write_document(source, fmus, wire(source, fmus))
