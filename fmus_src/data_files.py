"""Files that a block reads where it runs: declared by name, packed into its FMU, reached by one path in all faces."""

from __future__ import annotations

import inspect
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import ClassVar


class DataFiles:
    """What a block with ``data`` inherits: the path of each file, as an object and inside an FMU."""

    data: ClassVar[tuple[str, ...]] = ()
    fmu_resources: str | None = None  # the folder of the FMU that the instance runs in, set by the FMU

    def data_path(self, name: str) -> Path:
        """The path of a file that ``data`` declares: next to the block's source, or in the FMU's resources.

        Valid as long as the instance lives: an importer unpacks an FMU anew for each of its runs. Raises ValueError
        for a name that is not declared.
        """
        for owner in type(self).__mro__:
            if name in vars(owner).get("data", ()):
                if self.fmu_resources is not None:
                    return Path(self.fmu_resources, *owner.__module__.split(".")[:-1], name)
                return Path(inspect.getfile(owner)).parent / name
        raise ValueError(f"{type(self).__name__}: no data file {name!r}; declare it in the class, data = ({name!r},)")


def data_problem(names: object, python_only: bool) -> str | None:
    """What is wrong with a declaration of data, and what to do; None where nothing is."""
    if not isinstance(names, tuple) or not all(isinstance(name, str) for name in names):
        return f"data is {names!r}; write a tuple of file names, data = ('net.npz',)"
    for name in names:
        if PureWindowsPath(name).name != name or PurePosixPath(name).name != name or name in ("", ".."):
            return f"data names {name!r}, which is no name of a file next to the source; put it there, name it alone"
        if name.endswith(".py"):
            return f"data names {name!r}, which is Python; import it, and it travels along"
    if names and not python_only:
        remedy = "add python_only = True, or write the numbers into the class"
        return f"data {', '.join(names)}: a native FMU reads no files; {remedy}"
    return None
