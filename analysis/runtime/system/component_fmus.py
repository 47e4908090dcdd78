"""FMUs of a system's components, chosen by options or by its description, with their array sizes."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, partial
from pathlib import Path

from ....common.errors import InputError, suggestion
from ....common.paths import FLAVOURS, names_fmu
from ....common.regular import names_file
from ....fmus_src.export.available import find_fmu, fmu_flavours
from ..fmi.structure import structural_sizes
from ..ssp.archive import HOW_TO_BUILD, SystemArchive, fmu_key, parameters_key, read_fmu, use_key
from ..ssp.parameter_sets import Assignment, read_parameter_file
from ..ssp.system_description import Component, SystemDescription
from .arrays.sizes import Sizes, assigned_values
from .assignments import single_value
from .checks import missing_fmu, unsuitable_fmu
from .fmu import Fmu, load_fmu
from .options import SystemOptions
from .stale import Retired, find_retired

Read = Callable[[], bytes]


class ComponentFmus:
    """Loader of the FMUs of a system. All methods raise InputError.

    ``loaded`` caches FMUs by label; ``description`` is the current description of the system, which determines array
    sizes.
    """

    description: SystemDescription

    def __init__(self, archive: SystemArchive, options: SystemOptions, loaded: dict[str, Fmu]) -> None:
        self.archive = archive
        self.options = options
        self._loaded = loaded
        self.elsewhere: dict[str, Read] = {}  # files outside the system, as in `PreparedSystem`
        self.retired: dict[str, tuple[str, Retired]] = {}  # the used name and its replacement, by component
        self.notes: list[str] = []  # notes on parameter files
        self._used: dict[str, Component] = {}  # components with an FMU named by an option

    def load(self, name: str, component: Component) -> Fmu:
        """Return the FMU of a component, with its array sizes."""
        if name in self.options.use:
            read, label = self._find_used(name, component)
        else:
            read, label = self._find_described(name, component)
        return self.with_sizes(self.open(read, label), name)

    def _find_used(self, name: str, component: Component) -> tuple[Read, str]:
        archive, options, use = self.archive, self.options, self.options.use[name]
        self._used[name] = component
        key = use_key(use)
        block = self._current_name(name, use)
        if key in archive.elsewhere:
            read, label = read_fmu(archive.elsewhere[key]), use
        else:
            archive.refuse_elsewhere(use, f"`use` {name}")
            if _is_missing(block, options.build, archive.path):
                raise missing_fmu(name, block, component)
            read, label = locate_fmu(block, options.build, system=archive.path)
        self.elsewhere[key] = read
        return read, label

    def _find_described(self, name: str, component: Component) -> tuple[Read, str]:
        archive, source = self.archive, component.source
        if not (archive.is_own_file(source) or fmu_key(source) in archive.elsewhere):
            source = Path(source).with_stem(self._current_name(name, Path(source).stem)).as_posix()
        read, label = archive.fmu(source, f"{name} (line {component.line})", self.options.build)
        if not archive.is_own_file(source):
            self.elsewhere[fmu_key(source)] = read
        return read, label

    def _current_name(self, component: str, name: str) -> str:
        """Return the name of the FMU that replaces a retired FMU, and note it; return other names unchanged."""
        retired = find_retired(name, self.archive.path)
        if retired is None:
            return name
        self.retired[component] = name, retired
        return retired.block

    def open(self, read: Read, label: str) -> Fmu:
        """Return an FMU by its label; read it at first use."""
        if label not in self._loaded:
            self._loaded[label] = load_fmu(read(), label, strict=self.options.chosen["strict"])
        return self._loaded[label]

    def with_sizes(self, fmu: Fmu, name: str) -> Fmu:
        """Return the FMU of a component with its array sizes."""
        if not fmu.structural_parameters:
            return fmu
        names = fmu.structural_parameters
        structural = structural_sizes(self.description, self.archive, name, names, self.assignments)
        return fmu.with_sizes(structural | self.sizes.connected(name, names))

    @cached_property
    def sizes(self) -> Sizes:
        """Sizes of dimensions, from the description at first use."""
        return Sizes(
            self.description, lambda: assigned_values(self.description, self.archive, self.assignments), self.load
        )

    @cached_property
    def assignments(self) -> list[Assignment]:
        """Parameter values of files and options; later values override earlier values."""
        options, assignments = self.options, list[Assignment]()
        for name in options.parameters:
            data, label = self.archive.parameter_set(name)
            if not label.startswith(f"{self.archive.label}!"):
                self.elsewhere[parameters_key(name)] = partial(bytes, data)
            assignments += read_parameter_file(
                data, label, self.notes if options.chosen["allow_unmatched"] else None, self.notes
            )
        return assignments + [
            single_value(name, value, options.places.get(name)) for name, value in options.set.items()
        ]

    def refuse_unfit(self, error: InputError) -> None:
        """Replace an error in the connections of a component by a clearer error if an option names its FMU."""
        slot = next((slot for slot in self._used if error.element.startswith(f"{slot}.")), None)
        if slot is not None and error.file == self.description.file:
            raise unsuitable_fmu(slot, self.options.use[slot], self._used[slot], error) from error


def _is_missing(name: str, flavour: str | None, system: Path | None) -> bool:
    """Return True if no FMU is built under a name; always False for paths."""
    return Path(name).name == name and not names_fmu(name) and find_fmu(name, _flavours(flavour), system) is None


def _flavours(flavour: str | None) -> tuple[str, ...]:
    return FLAVOURS if flavour is None else (flavour,)


def locate_fmu(name: str, flavour: str | None, option: str = "`use`", system: Path | None = None) -> tuple[Read, str]:
    """Return a function that reads an FMU, and its label, by name or path; the names include FMUs of the ``system``.

    Raises InputError.
    """
    if names_fmu(name) or Path(name).name != name:
        path = Path(name)
        if not names_file(path):
            raise InputError(option, name, "no such file", "give a block's name or the path of an .fmu")
        return read_fmu(path), name
    file = find_fmu(name, _flavours(flavour), system)
    if file is not None:
        return read_fmu(file), str(file)
    raise InputError(option, name, "no such FMU is built", f"{suggestion(name, fmu_flavours())}; {HOW_TO_BUILD}")
