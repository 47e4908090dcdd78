"""Notes before a simulation on FMUs with retired names, and on FMUs older than their sources."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from ....common.paths import FLAVOURS, SYSTEMS, names_fmu
from ....fmus_src.export.available import find_fmu
from ....fmus_src.export.sources import find_changed_source
from ...options.option import SetValue
from ..ssp.archive import open_system
from ..ssp.parameter_sets import Assignment, read_parameter_file
from ..ssp.ssd_reader import read_description
from ..ssp.system_description import Component, SystemElement
from .assignments import single_value
from .options import SystemOptions

GAINS = SYSTEMS / "entry_attitude"  # its parameter sets use the component name `regulator`


@dataclass(frozen=True)
class Retired:
    """Replacement of a retired FMU: ``block`` with ``values`` of its parameters, or with those in ``parameter_set``."""

    block: str
    values: Mapping[str, SetValue] = field(default_factory=dict)
    parameter_set: str | None = None

    def assignments(self, component: str) -> Iterator[Assignment]:
        """Yield the parameter values for a component that used the retired FMU."""
        for name, value in self.values.items():
            yield single_value(f"{component}.{name}", value)
        if self.parameter_set is not None:
            path = GAINS / self.parameter_set
            for each in read_parameter_file(path.read_bytes(), str(path)):
                yield replace(each, name=f"{component}.{each.name.partition('.')[2]}")

    def note(self, component: str, name: str) -> str:
        """Return a note that a component uses a retired name, with the replacement."""
        values = [f"{component}.{each} = {str(value).lower()}" for each, value in self.values.items()]
        instead = " and ".join([self.block, *values, *filter(None, [self.parameter_set])])
        return f"{component}: {name} is retired and accepted in this release only: use {instead}"


RETIRED = {
    f"output_feedback_{name}": Retired("output_feedback", parameter_set=f"output_feedback_{name}.ssv")
    for name in ("direct1", "direct0", "dual_a", "dual_b", "scheduled")
} | {
    "orbital_observer_continuous_split": Retired("orbital_observer_continuous", {"split": True}),
    "orbital_observer_discrete_split": Retired("orbital_observer_discrete", {"split": True}),
    "orbital_observer_discrete_reduced_split": Retired("orbital_observer_discrete_reduced", {"split": True}),
    "pulse_allocation_mean": Retired("pulse_allocation", {"mean": True}),
}


def find_retired(name: str, system: Path) -> Retired | None:
    """Return the replacement of a retired FMU by its block's name, or None if a user has an FMU of this name."""
    retired = RETIRED.get(name)
    if retired is None or find_fmu(name, system=system) is not None:
        return None
    return retired


def report_fmus(system: str | Path, options: SystemOptions, compare: Mapping[str, Iterable[str]]) -> list[str]:
    """Return a line for each source file that is newer than the FMUs built from it, and for each retired name.

    ``compare`` lists further FMUs for some components. Raises InputError if the system cannot be read.
    """
    archive = open_system(system)
    if archive.is_fmu:
        return []
    description = read_description(archive, options.chosen["variant"])
    sources = {name: component.source for name, component in _components(description.system)}
    blocks = {name: Path(source).stem for name, source in sources.items() if source not in archive.files}
    blocks |= dict(options.use)
    pairs = [*blocks.items(), *((name, fmu) for name, fmus in compare.items() for fmu in fmus)]
    retired = [(name, block, find_retired(block, archive.path)) for name, block in pairs]
    lines = [replacement.note(name, block) for name, block, replacement in retired if replacement is not None]
    changed: dict[tuple[Path, Path], set[str]] = {}
    for name in dict.fromkeys(block for _, block in pairs):
        fmu = _file(name, options.build, archive.path)
        files = None if fmu is None else find_changed_source(fmu)
        if files is not None:
            changed.setdefault(files, set()).add(Path(name).stem)
    return lines + [_line(file, source, sorted(names)) for (file, source), names in changed.items()]


def _file(name: str, flavour: str | None, system: Path) -> Path | None:
    """Return the FMU file that a simulation uses for a name, or None."""
    if names_fmu(name) or Path(name).name != name:
        return Path(name) if Path(name).is_file() else None
    return find_fmu(name, FLAVOURS if flavour is None else (flavour,), system)


def _components(system: SystemElement, path: str = "") -> Iterator[tuple[str, Component]]:
    for element in system.elements.values():
        if isinstance(element, Component):
            yield path + element.name, element
        elif isinstance(element, SystemElement):
            yield from _components(element, f"{path}{element.name}.")


def _line(file: Path, source: Path, names: list[str]) -> str:
    displayed, repeated = (
        os.path.relpath(path) if path.is_relative_to(Path.cwd()) else str(path) for path in (file, source)
    )
    are = "was" if len(names) == 1 else "were"
    return f"{displayed}: has changed since {', '.join(names)} {are} exported; perilune export {repeated}"
