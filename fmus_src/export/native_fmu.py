"""Native FMU of a block: C99 translated from its Python, compiled, with its sources."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

from ...common.paths import CACHE
from ..block import Block
from ..catalogue import is_shipped
from ..evidence.block import add_evidence
from ..own_digests import note_own
from .archive import content_guid, write_zip
from .compilers import PLATFORMS, SOURCE_OPTIONS
from .description import fmi2, fmi3
from .description.build import build_description
from .description.origin import STANDARD, STANDARD_HEADERS, accompanying_files, origin
from .description.terminals import FILE as TERMINALS_FILE
from .description.terminals import terminals
from .libraries import build_library
from .write.translate import translate

C_FILES = Path(__file__).parent / "fmi"


def wrapper_files(fmi: int, model: str = "block") -> list[Path]:
    """Return the C wrapper of a block or a ``system`` for an FMI version: common files and files of the version."""
    folders = ("instance", "kernel", model, f"fmi{fmi}")
    return [path for folder in folders for path in sorted((C_FILES / folder).iterdir())]


def read_wrapper(fmi: int, model: str = "block") -> dict[str, bytes]:
    """Return the content of `wrapper_files` by file name, with the headers of the standard."""
    files = {path.name: path.read_bytes() for path in wrapper_files(fmi, model)}
    return files | {name: (STANDARD / name).read_bytes() for name in STANDARD_HEADERS[fmi]}


def native_sources(block_class: type[Block], guid: str, fmi: int = 2) -> dict[str, bytes]:
    """Return the files of ``sources/`` by name; ``FMU_NAME.c`` includes the others and is the one to compile.

    Raises `SubsetError` if the block is outside the subset of Python.
    """
    files = read_wrapper(fmi)
    files[f"{block_class.fmu_name}.c"] = translate(block_class, guid, fmi).encode()
    return files


def native_guid(block_class: type[Block], fmi: int = 2) -> str:
    """Return the GUID (FMI 3.0: instantiation token) of a block's native FMU: a hash of sources and description."""
    return content_guid(_files(block_class, "", fmi))


def build_native_fmu(
    block_class: type[Block],
    path: Path,
    *,
    platforms: Sequence[str] = ("linux64", "win64"),
    cache: Path = CACHE,
    portable: bool = False,
    fmi: int = 2,
) -> Path:
    """Build the native FMU of a block at ``path``; two builds on one machine are byte-identical.

    ``fmi`` is 2 or 3, and ``platforms`` are platform names of that version. Compiled libraries are cached in the folder
    ``cache``, so an unchanged block is not compiled again. With ``portable`` zig compiles even if the system has a
    compiler. Raises `SubsetError`, `CompilerMissing` and `CompilationFailed`, and ValueError for a block that this
    version of FMI cannot describe.
    """
    guid = native_guid(block_class, fmi)
    files = _files(block_class, guid, fmi)
    sources = native_sources(block_class, guid, fmi)
    name = block_class.fmu_name
    for platform in platforms:
        library = build_library(sources, f"{name}.c", platform, cache, portable=portable)
        files[f"binaries/{platform}/{name}{PLATFORMS[platform].extension}"] = library
    write_zip(path, add_evidence(block_class, files))
    note_own(path)
    return path


def _files(block_class: type[Block], guid: str, fmi: int) -> dict[str, bytes]:
    """Return the files of the FMU without binaries and check."""
    files = {f"sources/{name}": text for name, text in native_sources(block_class, guid, fmi).items()}
    main, is_ours = f"{block_class.fmu_name}.c", is_shipped(block_class)
    files |= accompanying_files(fmi, is_ours=is_ours)
    about = origin(f"Perilune {version('perilune')}", is_ours=is_ours, is_final=guid != "")
    if fmi == 3:
        files["modelDescription.xml"] = fmi3.model_description(block_class, token=guid, origin=about)
        files["sources/buildDescription.xml"] = build_description(block_class.fmu_name, main, SOURCE_OPTIONS)
        connected = terminals(block_class)
        return files if connected is None else files | {TERMINALS_FILE: connected}
    files["modelDescription.xml"] = fmi2.model_description(
        block_class, guid=guid, origin=about, needs_execution_tool=False, sources=[main]
    )
    return files
