"""Available FMUs by name: of this repository, in ``build/fmus`` of the working folder, and of a system.

An installed package contains its native FMUs. Its Python FMUs, whose loader would triple the size of the package, are
built on first use, which needs no compiler, and stored in the cache folder.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from functools import cache, partial
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory

from ...common.machine.cached import cached_file
from ...common.paths import CACHE, FLAVOURS, IS_CHECKOUT, PACKAGE, SYSTEMS, own_fmu, own_fmus, shipped_fmu
from ...common.regular import names_file
from ..catalogue import catalogue
from ..own_digests import note_own
from .pythonfmu_fmu import build_python_fmu


def find_fmu(name: str, flavours: Iterable[str] = FLAVOURS, system: Path | None = None) -> Path | None:
    """Return the FMU of this name in the first available flavour, or None.

    For a user's system, the user's FMUs take precedence: first in the working folder, then in the parent folder of
    ``system``. Otherwise the repository's FMUs take precedence, so that its systems are the same in every folder.
    """
    flavours = tuple(flavours)
    users, shipped = _users_files(name, flavours, system), _list_shipped(name, flavours)
    is_users = system is not None and not system.resolve().is_relative_to(SYSTEMS.resolve())
    first, second = (users, shipped) if is_users else (shipped, users)
    return next(first, None) or next(second, None)


def fmu_file(name: str, flavour: str, system: Path | None = None) -> Path | None:
    """Return the FMU that `find_fmu` finds in one flavour, or None."""
    return find_fmu(name, (flavour,), system)


def _users_files(name: str, flavours: Iterable[str], system: Path | None) -> Iterator[Path]:
    for flavour in flavours:
        yield from filter(names_file, own_fmus(name, flavour, system))


def _list_shipped(name: str, flavours: Iterable[str]) -> Iterator[Path]:
    """Yield the repository's FMUs; a Python FMU of an installed package is built on first use."""
    for flavour in flavours:
        shipped = shipped_fmu(name, flavour)
        if names_file(shipped):
            yield shipped
        elif not IS_CHECKOUT and flavour == "python" and name in catalogue():
            path = cached_file(_python_folder() / f"{name}.fmu", partial(_python_fmu, name))
            note_own(path)  # the list may have been damaged since the build
            yield path


def fmu_flavours() -> dict[str, dict[str, Path | None]]:
    """Return all FMUs by name with their available flavours; a file is None until it has been built."""
    files: dict[str, dict[str, Path | None]] = {}
    for flavour in FLAVOURS:
        if not IS_CHECKOUT and flavour == "python":
            for name in catalogue():
                files.setdefault(name, {})[flavour] = None
        for folder in (shipped_fmu("x", flavour).parent, own_fmu("x", flavour).parent):
            for path in sorted(folder.glob("*.fmu")):
                files.setdefault(path.stem, {}).setdefault(flavour, path)
    return files


def _python_fmu(name: str) -> bytes:
    with TemporaryDirectory() as folder:
        return build_python_fmu(catalogue()[name], Path(folder) / f"{name}.fmu").read_bytes()


@cache
def _python_folder() -> Path:
    """Return the cache folder of Python FMUs for the present sources."""
    sources = PACKAGE / "fmus_src"
    digest = hashlib.sha256(version("pythonfmu").encode())
    for path in sorted((*sources.rglob("*.py"), *sources.glob("*/checks/*"))):
        digest.update(b"\0" + path.relative_to(sources).as_posix().encode() + b"\0" + path.read_bytes())
    return CACHE / "fmus" / digest.hexdigest()[:16]
