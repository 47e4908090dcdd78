"""A block as a native FMU: C99 translated from its Python, compiled, with its sources inside."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

import fmpy

from ..block import Block
from ..evidence.block import add_evidence
from ..own_digests import note_own
from ..paths import CACHE
from .archive import content_guid, write_zip
from .compilers import PLATFORMS, build_library
from .model_description import model_description
from .write.translate import translate

C_FILES = Path(__file__).parent / "fmi"
WRAPPER_FILES = (
    "fmi2_block.h",
    "fmi2_component.h",
    "fmi2_fmu_state.h",
    "fmi2_python_repr.h",
    "fmi2_values.h",
    "fmi2_wrapper.c",
    "kernel_math.h",
    "kernel_self_test.h",
    "kernel_vectors.h",
)
STANDARD_HEADERS = ("fmi2FunctionTypes.h", "fmi2Functions.h", "fmi2TypesPlatform.h")  # BSD-2, licence inside


def native_sources(block_class: type[Block], guid: str) -> dict[str, bytes]:
    """The files of ``sources/`` by name; ``FMU_NAME.c`` is the one to compile, it includes the others.

    Raises `SubsetError` where the block is outside the subset of Python.
    """
    standard = Path(fmpy.__file__).parent / "c-code"
    files = {name: (C_FILES / name).read_bytes() for name in WRAPPER_FILES}
    files |= {name: (standard / name).read_bytes() for name in STANDARD_HEADERS}
    files[f"{block_class.fmu_name}.c"] = translate(block_class, guid).encode()
    return files


def native_guid(block_class: type[Block]) -> str:
    """The GUID of a block's native FMU: a hash of its sources and its description."""
    return content_guid(_files(block_class, guid=""))


def build_native_fmu(
    block_class: type[Block],
    path: Path,
    *,
    platforms: Sequence[str] = ("linux64", "win64"),
    cache: Path = CACHE,
    portable: bool = False,
) -> Path:
    """Build the native FMU of a block at ``path``; two builds on one machine are byte-identical.

    Compiled libraries are kept in the folder ``cache``, so that an unchanged block is not compiled
    again. ``portable`` compiles with zig even where the system has a compiler. Raises
    `SubsetError`, `CompilerMissing` and `CompilationFailed`.
    """
    guid = native_guid(block_class)
    files = _files(block_class, guid)
    sources = native_sources(block_class, guid)
    name = block_class.fmu_name
    for platform in platforms:
        library = build_library(sources, f"{name}.c", platform, cache, portable=portable)
        files[f"binaries/{platform}/{name}{PLATFORMS[platform].extension}"] = library
    write_zip(path, add_evidence(block_class, files))
    note_own(path)
    return path


def _files(block_class: type[Block], guid: str) -> dict[str, bytes]:
    """The FMU without its binaries."""
    files = {f"sources/{name}": text for name, text in native_sources(block_class, guid).items()}
    files["modelDescription.xml"] = model_description(
        block_class,
        guid=guid,
        generation_tool=f"Perilune {version('perilune')}",
        needs_execution_tool=False,
        sources=[f"{block_class.fmu_name}.c"],
    )
    return files
