"""Library objects with internal state, and data files, of Python-only blocks.

Data files are declared by name and packed into the FMU; a block finds them by the same call in Python and in the FMU.
"""

from __future__ import annotations

import inspect
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import TYPE_CHECKING, Any, ClassVar

from .variables import DeclarationError, Variable


class ExternalState:
    """Object with internal state: ``simulation = ExternalState("the plant as Basilisk simulates it")``.

    It is None until `initialize` assigns it, and is set to None whenever the block is initialised or reset, so that no
    simulation depends on another. An FMU with such an object cannot save or restore its state and runs in a separate
    process.
    """

    def __init__(self, description: str) -> None:
        self.description = description

    if TYPE_CHECKING:  # instances hold the object under the same name

        def __get__(self, instance: object, owner: type | None = None) -> Any: ...

        def __set__(self, instance: object, value: Any) -> None: ...


class HasExternalState:
    """Base of blocks that may declare `ExternalState` objects."""

    external: ClassVar[tuple[str, ...]] = ()
    python_only: ClassVar[bool]
    variables: ClassVar[dict[str, Variable]]

    @classmethod
    def collect_external(cls) -> None:
        """Collect the names of all declared objects, in order. Raises DeclarationError."""
        names = [name for owner in reversed(cls.__mro__) for name, each in vars(owner).items() if _is_external(each)]
        cls.external = tuple(dict.fromkeys(names))
        twice = next((name for name in names if name in cls.variables), None)
        if twice is not None:
            raise DeclarationError(
                f"{cls.__name__}.{twice}: both an ExternalState and a variable; rename one of the two"
            )
        if names and not cls.python_only:
            problem = "an ExternalState, which a native FMU cannot have"
            raise DeclarationError(f"{cls.__name__}.{names[0]}: {problem}; add python_only = True, or declare a State")

    def drop_external(self) -> None:
        """Set all objects to None."""
        for name in self.external:
            setattr(self, name, None)


def _is_external(attribute: object) -> bool:
    return isinstance(attribute, ExternalState)


class DataFiles:
    """Mixin for blocks that declare ``data``; returns the path of each file, both in Python and inside an FMU."""

    data: ClassVar[tuple[str, ...]] = ()
    fmu_resources: str | None = None  # the folder of the FMU that the instance runs in, set by the FMU

    def data_path(self, name: str) -> Path:
        """Return the path of a file declared in ``data``: next to the block's source, or in the FMU's resources.

        The path is valid during the life of the instance, since an importer may unpack an FMU for each simulation.
        Raises ValueError for an undeclared name.
        """
        for owner in type(self).__mro__:
            if name in vars(owner).get("data", ()):
                if self.fmu_resources is not None:
                    return Path(self.fmu_resources, *owner.__module__.split(".")[:-1], name)
                return Path(inspect.getfile(owner)).parent / name
        raise ValueError(f"{type(self).__name__}: no data file {name!r}; declare it in the class, data = ({name!r},)")


def data_problem(names: object, python_only: bool) -> str | None:
    """Return the problem with a declaration of data files and its remedy, or None if the declaration is valid."""
    if not isinstance(names, tuple) or not all(isinstance(name, str) for name in names):
        return f"data is {names!r}; write a tuple of file names, data = ('net.npz',)"
    for name in names:
        if PureWindowsPath(name).name != name or PurePosixPath(name).name != name or name in ("", ".."):
            return f"data names {name!r}, which is not a file next to the source; put it there and give its bare name"
        if name.endswith(".py"):
            return f"data names {name!r}, which is Python; import it, and it is packed too"
    if names and not python_only:
        remedy = "add python_only = True, or write the numbers into the class"
        return f"data {', '.join(names)}: a native FMU reads no files; {remedy}"
    return None
