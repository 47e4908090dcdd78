"""Namesakes: different code of the same name, of which a process uses the first one loaded for all FMUs."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from .....common.errors import InputError
from ..fmu import Fmu
from .bundled import MODULE, Bundled, bundled_by, module_digest

# The process that forks the children in which foreign FMUs are loaded; they inherit its modules.
SERVER = "perilune.analysis.runtime.process.server"
MODULES = "import json, sys; print(json.dumps({k: getattr(m, '__file__', None) for k, m in list(sys.modules.items())}))"
REMEDIES = {
    MODULE: "rename the module, or put it into a package of another name",
    "library": "give the library another file name and SONAME",
}
Files = Mapping[str, str | None]  # files of modules by name, None for modules without a file


class _Loaded(NamedTuple):
    bundled: Bundled
    fmu: Fmu


_loaded: dict[
    tuple[str, str], _Loaded
] = {}  # code that FMUs have brought into this process, which stays, by kind and name


def check_namesakes(fmus: Iterable[Fmu], *, in_process: bool) -> None:
    """Reject foreign FMUs that would use the code of another FMU or of Perilune. Raises InputError.

    The FMUs' code is compared with each other's, with the modules of the process that loads them and, if this is the
    current process (``in_process``), with all code that it has ever loaded.
    """
    present = dict(_loaded) if in_process else {}
    for fmu in fmus:
        if not fmu.is_own:
            _check(fmu, present, _modules_here if in_process else _modules_of_server)
            present |= _by_name(fmu, present)


def note_loaded(fmu: Fmu) -> None:
    """Note that this process, which is no child, loads a foreign FMU.

    Raises InputError if namesakes of the FMU's code have been loaded before.
    """
    if not fmu.is_own:
        _check(fmu, _loaded, _modules_here)
        _loaded.update(_by_name(fmu, _loaded))


def _by_name(fmu: Fmu, present: Mapping[tuple[str, str], _Loaded]) -> dict[tuple[str, str], _Loaded]:
    named = {(each.kind, each.name): _Loaded(each, fmu) for each in bundled_by(fmu)}
    return {key: loaded for key, loaded in named.items() if key not in present}


def _check(fmu: Fmu, present: Mapping[tuple[str, str], _Loaded], modules: Callable[[], Files]) -> None:
    for each in bundled_by(fmu):
        other = present.get((each.kind, each.name))
        if other is not None:
            if each.digest != other.bundled.digest and not (each.is_main and other.bundled.is_main):
                problem = f"another {each.kind} {each.name} is {other.bundled.file} of {other.fmu.label}"
                remedy = f"{REMEDIES[each.kind]}, in one of the two FMUs"
                raise InputError(fmu.label, each.file, f"{problem}, and a process can load only one", remedy)
        elif each.kind == MODULE and _is_installed(each.name):
            _check_module(fmu, each, modules())


def _check_module(fmu: Fmu, module: Bundled, modules: Files) -> None:
    """Raise InputError if the process that loads the FMU has a different module of the same name."""
    if module.name not in modules:
        return
    file = modules[module.name]
    path = None if file is None else Path(file)
    if path is not None and path.name == "__init__.py":
        path = path.parent
    if path is None or not path.exists() or module_digest(path) != module.digest:
        problem = f"Perilune has loaded another module {module.name}, and a process can load only one"
        raise InputError(fmu.label, module.file, problem, REMEDIES[MODULE])


def _is_installed(name: str) -> bool:
    """Return True if a module of this name exists outside FMUs, and so may already be loaded."""
    try:
        return name in sys.modules or find_spec(name) is not None
    except (ValueError, ImportError):
        return True


def _modules_here() -> Files:
    return {name: getattr(module, "__file__", None) for name, module in list(sys.modules.items())}


@cache
def _modules_of_server() -> Files:
    """Return the modules of the flight server, as printed by a process with the same imports."""
    start = f"import sys; sys.path[:] = {sys.path!r}; import {SERVER}; {MODULES}"
    printed = subprocess.run([sys.executable, "-c", start], stdout=subprocess.PIPE, check=True).stdout
    modules: Files = json.loads(printed)
    return modules
