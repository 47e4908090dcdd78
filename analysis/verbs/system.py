"""`perilune.System`: a system composed in Python, simulated, and written as a folder."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Unpack

from ...common.atomic import write_atomically
from ...common.bounds import ARCHIVE_BYTES
from ...common.errors import InputError
from ...common.paths import names_fmu
from ...common.regular import read_input
from ...common.scratch import make_folder
from ...fmus_src.export.ssp_package import DESCRIPTION, SYSTEM_FILE
from ..compose.document import RESOURCES
from ..compose.files import check_unedited, check_unedited_source, write_new
from ..compose.source import ComponentSource, ListEntry, SetValue, SystemSource
from ..compose.text import write_toml
from ..options.declared.campaigns import RunOptions
from ..options.option import FilePath
from .compose import compose_source
from .run import Result, simulate


class System:
    """A system composed in Python, with the content of a `system.toml`.

    `run` and `write` check it; if there are problems they report all together, and nothing is written. ``step`` and
    ``stop_time`` are in s.
    """

    def __init__(
        self,
        name: str = "system",
        description: str = "",
        *,
        step: float | None = None,
        stop_time: float | None = None,
    ) -> None:
        self._source = SystemSource(name, {}, description=description, step=step, stop_time=stop_time, file=name)
        self._files: dict[str, Path] = {}

    @property
    def toml(self) -> str:
        """The text of the `system.toml`."""
        return write_toml(self._source)

    def add(self, name: str, fmu: FilePath, **parameters: SetValue) -> None:
        """Add a component; ``fmu`` is a name or a path, ``parameters`` are in their variables' units.

        `write` copies an FMU stated by its path. Raises InputError for a second component of the same name, or a second
        FMU file of the same name.
        """
        if name in self._source.components:
            raise InputError(self._source.name, name, "two components have this name", "rename one")
        source = os.fspath(fmu)
        if names_fmu(source):
            path, source = Path(source), f"{RESOURCES}{Path(source).name}"
            if self._files.setdefault(source, path) != path:
                problem = f"{path} and {self._files[source]} have the same file name"
                raise InputError(self._source.name, name, problem, "rename one of the files")
        components = {**self._source.components, name: ComponentSource(source, where=name)}
        self._source = replace(self._source, components=components)
        for parameter, setting in parameters.items():
            self.set(f"{name}.{parameter}", setting)

    def connect(self, source: str, *sinks: str) -> None:
        """Connect ``COMPONENT.OUTPUT`` to inputs, whole vectors at once.

        A system connector is stated without ``COMPONENT`` and must be declared by `connector` first.
        """
        entries = [ListEntry(f"{source} -> {', '.join(sinks)}", "connect")]
        self._source = replace(self._source, connections=(*self._source.connections, *entries))

    def connector(self, name: str, kind: str) -> None:
        """Declare a connector of the system of kind ``input``, ``output`` or ``parameter``.

        Its type and unit follow from its connection; an output ``finished`` ends the simulation.
        """
        self._source = replace(self._source, connectors={**self._source.connectors, name: kind})

    def set(self, name: str, setting: SetValue) -> None:
        """Set a parameter ``COMPONENT.PARAMETER`` in the unit of its variable; a vector takes a list."""
        numbers = setting if isinstance(setting, int | float | str | Sequence) else list(setting)
        self._source = replace(self._source, set={**self._source.set, name: numbers})

    def declare(self, *names: str) -> None:
        """Declare connectors of components that remain unconnected."""
        entries = (ListEntry(name, "declare") for name in names)
        self._source = replace(self._source, declare=(*self._source.declare, *entries))

    def leave_unconnected(self, *names: str) -> None:
        """Leave inputs unconnected, at the start values of their FMUs."""
        entries = (ListEntry(name, "leave_unconnected") for name in names)
        self._source = replace(self._source, unconnected=(*self._source.unconnected, *entries))

    def write(self, folder: FilePath) -> list[Path]:
        """Write `system.toml`, SystemStructure.ssd and all FMUs added by path; return the paths.

        Raises InputError with a line for each problem, and for an edited file that would be overwritten.
        """
        home = Path(folder)
        raw = self.toml.encode()
        contents = {name: read_input(path, "correct the path", ARCHIVE_BYTES) for name, path in self._files.items()}
        there = home if home.is_dir() else make_folder()
        document = compose_source(self._source, there, raw, SYSTEM_FILE, contents)
        check_unedited(home / DESCRIPTION)
        check_unedited_source(home / SYSTEM_FILE, home / DESCRIPTION, raw)
        write_new({home / name: content for name, content in contents.items()})
        for name, content in {SYSTEM_FILE: raw, DESCRIPTION: document}.items():
            write_atomically(home / name, content)
        return [home / name for name in (*contents, SYSTEM_FILE, DESCRIPTION)]

    def run(self, **options: Unpack[RunOptions]) -> Result:
        """Simulate the system with the options of `simulate`. Raises InputError as `write` does."""
        folder = make_folder() / self._source.name
        self.write(folder)
        return simulate(folder, **options)
