"""Library of the loop: compiled from the C code in `c`, identified by its content, loaded once in a process."""

from __future__ import annotations

import ctypes
import hashlib
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from ....common.atomic import write_atomically
from ....common.errors import InputError
from ....common.paths import BUILD, CACHE
from ....fmus_src import export
from ....fmus_src.export.compilers import (
    FLAGS,
    PLATFORMS,
    CompilationFailed,
    CompilerMissing,
    compilers_for,
    local_platform,
)
from ....fmus_src.export.libraries import build_library, library_files
from ....fmus_src.kernel import elementary
from . import codes
from .structures import enumerators, structures

MAIN = "library.c"
KERNEL_MATH = files(export.__name__).joinpath("fmi", "kernel", "kernel_math.h")  # the same file as in all FMUs
FMI = 3  # its platform names distinguish processors
FOLDER = "loop"  # in a build folder; contains a folder for each platform


@cache
def load_library() -> ctypes.CDLL:
    """Load the library; compile it if none was built from this C code. Its functions release the interpreter lock.

    Raises InputError if it has to be compiled and there is no working compiler.
    """
    file = built_file(BUILD, local_platform(FMI) or "")
    try:
        library = ctypes.CDLL(str(file if file.is_file() else _compile()))
    except OSError as error:
        raise InputError(
            "Perilune", str(file), f"is not a library: {error}", "build or install Perilune again"
        ) from error
    _check(library)
    library.perilune_fly.restype = library.perilune_fly_group.restype = ctypes.c_int64
    library.perilune_time_allowance.restype = ctypes.c_double
    library.perilune_time_allowance.argtypes = [ctypes.c_double, ctypes.c_double]
    return library


def build_loop(build: Path, platforms: list[str], *, portable: bool = False) -> None:
    """Build the library for ``platforms`` (names of FMI 3.0) into a build folder.

    Raises `CompilerMissing`, `CompilationFailed`.
    """
    for platform in platforms:
        content = build_library(sources(), MAIN, platform, CACHE / FOLDER, portable=portable)
        file = built_file(build, platform)
        if file.is_file() and file.read_bytes() == content:
            continue
        file.parent.mkdir(parents=True, exist_ok=True)
        for outdated in file.parent.iterdir():
            outdated.unlink()
        write_atomically(file, content)


def built_file(build: Path, platform: str) -> Path:
    """Return the path of the library in a build folder, named by a digest of its content. The file need not exist."""
    extension = PLATFORMS[platform].extension if platform in PLATFORMS else ""
    return build / FOLDER / platform / f"{_digest()}{extension}"


def sources() -> dict[str, bytes]:
    """Return the C code of the library by file name."""
    from .write_elementary import write_elementary  # slow, since it imports the translator

    written = (file for file in _files() if not file.name.endswith(".py"))
    return {**{file.name: file.read_bytes() for file in written}, "elementary.c": write_elementary().encode()}


def _files() -> list[Traversable]:
    """Return the source files of the library: C, and Python to be translated to C."""
    written = (file for file in files(__package__).joinpath("c").iterdir() if file.name.endswith((".c", ".h")))
    translated = (file for file in files(elementary.__name__).iterdir() if file.name.endswith(".py"))
    return sorted([*written, *translated, KERNEL_MATH], key=lambda file: file.name)


@cache
def _digest() -> str:
    total = hashlib.sha256("\0".join(FLAGS).encode())
    for file in _files():
        total.update(b"\0" + file.name.encode() + b"\0" + hashlib.sha256(file.read_bytes()).digest())
    return total.hexdigest()[:16]


def _compile() -> Path:
    platform = local_platform(FMI)
    try:
        if platform is None:
            problem = "the simulation loop is not built, and FMI 3.0 does not define this platform"
            raise InputError("Perilune", FOLDER, problem, "use Linux, macOS or Windows on a 64-bit machine")
        compilers_for(platform)
        (file,) = library_files(sources(), MAIN, platform, CACHE / FOLDER, flags=FLAGS)
    except CompilerMissing as error:
        problem = "the simulation loop is not built, and no C compiler is installed"
        raise InputError("Perilune", FOLDER, problem, "install cc, or pip install ziglang") from error
    except CompilationFailed as error:
        problem = f"the compiler rejects the simulation loop: {str(error).splitlines()[0]}"
        raise InputError("Perilune", FOLDER, problem, "repair the compiler") from error
    return file


def _check(library: ctypes.CDLL) -> None:
    """Compare the declarations in Python and in C. Raises ImportError if they differ, a programming error."""
    numbers = enumerators("codes.h") | enumerators("run.h")
    differing = [name for name, number in numbers.items() if getattr(codes, name, None) != number]
    sizes = [ctypes.sizeof(structures()[name]) for name in ("Run", "RunGroup")]
    if differing or list((ctypes.c_uint64 * len(sizes)).in_dll(library, "perilune_sizes")) != sizes:
        raise ImportError(f"codes.py or structures.py and c differ: {', '.join(differing) or 'sizes'}")
