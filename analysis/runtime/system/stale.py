"""What is said of the FMUs of a system before it is simulated: those older than their sources, and retired names."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from ....fmus_src.export.available import fmu_file
from ....fmus_src.export.sources import find_changed_source
from ....fmus_src.paths import FLAVOURS
from ..ssp.archive import open_system
from ..ssp.description import Component, System
from ..ssp.reading import read_description
from .options import SystemOptions
from .retired import find_retired


def report_fmus(system: str | Path, options: SystemOptions, compare: Mapping[str, Iterable[str]]) -> list[str]:
    """A line for each source file that is newer than the FMUs built of it, and for each retired name.

    ``compare`` has for some components the FMUs that take their place in turn. Raises InputError as
    reading the system does.
    """
    archive = open_system(system)
    if archive.is_fmu:
        return []
    sources = {
        name: component.source for name, component in _components(read_description(archive, options.variant).system)
    }
    blocks = {name: Path(source).stem for name, source in sources.items() if source not in archive.files}
    blocks |= dict(options.use)
    pairs = [*blocks.items(), *((name, fmu) for name, fmus in compare.items() for fmu in fmus)]
    retired = [(name, block, find_retired(block, archive.path)) for name, block in pairs]
    lines = [replacement.note(name, block) for name, block, replacement in retired if replacement is not None]
    changed: dict[tuple[Path, Path], set[str]] = {}
    for name in dict.fromkeys(block for _, block in pairs):
        fmu = _file(name, options.flavour, archive.path)
        files = None if fmu is None else find_changed_source(fmu)
        if files is not None:
            changed.setdefault(files, set()).add(Path(name).stem)
    return lines + [_line(file, source, sorted(names)) for (file, source), names in changed.items()]


def _file(name: str, flavour: str | None, system: Path) -> Path | None:
    """The FMU that a name means where one is flown."""
    if name.endswith(".fmu") or Path(name).name != name:
        return Path(name) if Path(name).is_file() else None
    files = (fmu_file(name, each, system) for each in (FLAVOURS if flavour is None else (flavour,)))
    return next((path for path in files if path is not None), None)


def _components(system: System, path: str = "") -> Iterator[tuple[str, Component]]:
    for element in system.elements.values():
        if isinstance(element, Component):
            yield path + element.name, element
        elif isinstance(element, System):
            yield from _components(element, f"{path}{element.name}.")


def _line(file: Path, source: Path, names: list[str]) -> str:
    displayed, repeated = (
        os.path.relpath(path) if path.is_relative_to(Path.cwd()) else str(path) for path in (file, source)
    )
    are = "was" if len(names) == 1 else "were"
    return f"{displayed}: has changed since {', '.join(names)} {are} exported; perilune export {repeated}"
