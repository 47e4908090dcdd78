"""FMUs of one's own that are older than what they were built of."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from ....fmus_src.export.available import fmu_file
from ....fmus_src.export.sources import changed_source
from ....fmus_src.paths import FLAVOURS
from ..ssp.archive import open_system
from ..ssp.description import Component, System
from ..ssp.reading import read_description
from .options import SystemOptions


def stale_fmus(system: str | Path, options: SystemOptions, others: Iterable[str] = ()) -> list[str]:
    """A line for each file that has changed since its FMUs, which a system flies, were exported.

    ``others`` are FMUs that take a component's place for some flights. Raises InputError as reading the system does.
    """
    archive = open_system(system)
    if archive.is_fmu:
        return []
    named = {
        name: component.source for name, component in _components(read_description(archive, options.variant).system)
    }
    held = {name for name, source in named.items() if source in archive.files}
    named = {name: Path(source).stem for name, source in named.items() if name not in held} | dict(options.use)
    changed: dict[tuple[Path, Path], set[str]] = {}
    for name in dict.fromkeys([*named.values(), *others]):
        fmu = _file(name, options.flavour, archive.path)
        files = None if fmu is None else changed_source(fmu)
        if files is not None:
            changed.setdefault(files, set()).add(Path(name).stem)
    return [_line(file, source, sorted(names)) for (file, source), names in changed.items()]


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
    shown, again = (os.path.relpath(path) if path.is_relative_to(Path.cwd()) else str(path) for path in (file, source))
    are = "was" if len(names) == 1 else "were"
    return f"{shown}: has changed since {', '.join(names)} {are} exported; perilune export {again}"
