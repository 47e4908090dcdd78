"""Modules and shared libraries in an FMU, by the names under which a process finds them."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

from ..fmu import Fmu

MODULE, LIBRARY = "module", "library"
PYTHONFMU = "pythonfmu"  # package in every FMU of pythonfmu
BYTECODE = "__pycache__"
EMBEDDED = (b"PyImport_", b"libpython")  # texts in the library of an FMU that runs Python in its importer's process
LIBRARY_SUFFIXES = (".so", ".dll", ".dylib")
MOST_FMUS = 256  # most FMUs in the cache


@dataclass(frozen=True)
class Bundled:
    """Module or library in an FMU: its ``name`` in the process, ``file`` in the FMU, and the SHA-256 of its content."""

    kind: str
    name: str
    file: str
    digest: str
    is_main: bool = False  # the FMU's own library, which importers load by its path


def bundled_by(fmu: Fmu) -> tuple[Bundled, ...]:
    """Return the modules and libraries that an FMU loads into a process."""
    return _list_bundled(fmu.digest, fmu.folder, fmu.binary)


@lru_cache(MOST_FMUS)
def _list_bundled(_digest: str, folder: Path, binary: str) -> tuple[Bundled, ...]:
    main, resources = folder / binary, folder / "resources"
    beside_main = _libraries(main.parent)
    modules: list[Bundled] = []
    if resources.is_dir() and any(text in path.read_bytes() for path in beside_main for text in EMBEDDED):
        modules = [
            Bundled(MODULE, name, path.relative_to(folder).as_posix(), module_digest(path))
            for path in sorted(resources.iterdir())
            if (name := _module_name(path)) and name != PYTHONFMU
        ]
    libraries = *beside_main, *_libraries(resources)
    return *modules, *(each for path in libraries for each in _names(path, folder, is_main=path == main))


def module_digest(path: Path) -> str:
    """Return the SHA-256 of a module's file, or of all files in its folder except bytecode."""
    total = hashlib.sha256()
    for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
        if BYTECODE not in file.parts and file.is_file():
            total.update(f"{file.relative_to(path).as_posix()}\0{file.stat().st_size}\0".encode())
            total.update(file.read_bytes())
    return total.hexdigest()


def _module_name(path: Path) -> str:
    """Return the name under which Python imports a file or a folder, or "" if it cannot be imported."""
    if path.is_dir():
        has_code = any(_suffix(file) for file in path.rglob("*"))
        return path.name if has_code and path.name.isidentifier() else ""
    name = path.name.removesuffix(_suffix(path))
    return name if name != path.name and name.isidentifier() else ""


def _suffix(path: Path) -> str:
    return next((suffix for suffix in (".py", *EXTENSION_SUFFIXES) if path.name.endswith(suffix)), "")


def _libraries(folder: Path) -> list[Path]:
    """Return the shared libraries in a folder and its subfolders."""
    return [path for path in sorted(folder.rglob("*")) if path.is_file() and _is_library(path)]


def _is_library(path: Path) -> bool:
    return path.suffix in LIBRARY_SUFFIXES or ".so." in path.name


def _names(path: Path, folder: Path, *, is_main: bool) -> Iterator[Bundled]:
    """Yield the names under which the dynamic loader knows a library: its file name and its SONAME.

    Python modules are omitted, since they are loaded by path.
    """
    file, digest = path.relative_to(folder).as_posix(), module_digest(path)
    is_module = _suffix(path) not in ("", ".so") or any(path.parent.glob("*.py"))
    names = {"" if is_module else path.name, _read_soname(path)} - {""}
    for name in sorted(names):
        yield Bundled(LIBRARY, name, file, digest, is_main)


def _read_soname(path: Path) -> str:
    """Return the DT_SONAME of an ELF file, or "" if there is none or the file is of another type."""
    from elftools.common.exceptions import ELFError  # imported only for foreign FMUs
    from elftools.elf.dynamic import DynamicSegment
    from elftools.elf.elffile import ELFFile

    with path.open("rb") as file:
        try:
            segments = [each for each in ELFFile(file).iter_segments("PT_DYNAMIC") if isinstance(each, DynamicSegment)]
            tags = (tag for each in segments for tag in each.iter_tags("DT_SONAME"))
            return next((tag.soname for tag in tags), "")  # type: ignore[attr-defined]  # set by the tag's kind
        except (ELFError, ValueError, LookupError, TypeError, AttributeError, OverflowError, OSError):
            return ""  # damaged; the loader rejects it, too
