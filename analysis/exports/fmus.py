"""Export of a single FMU of the repository, built here or copied from the installed package."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from ...common.errors import InputError
from ...common.paths import IS_CHECKOUT, shipped_fmu
from ...fmus_src.block import Block
from ...fmus_src.evidence.block import add_evidence
from ...fmus_src.export.archive import read_zip, write_zip
from ...fmus_src.export.compilers import PLATFORMS, available_platforms
from ...fmus_src.export.native_fmu import build_native_fmu
from ...fmus_src.export.pythonfmu_fmu import build_python_fmu


def build_fmu(block: type[Block], path: Path, flavour: str, platforms: Sequence[str], fmi: int) -> None:
    """Write an FMU of the repository.

    An installed package contains the native FMUs of FMI 2.0 with libraries for all platforms. FMUs of FMI 3.0 are
    compiled on request: few users need them, and they would double the size of the package. Raises InputError if the
    FMU cannot be built on this machine.
    """
    if flavour == "python":
        build_python_fmu(block, path)
    elif block.python_only:
        raise needs_python("export", block.fmu_name, fmi)
    elif fmi == 2 and not IS_CHECKOUT:
        files = read_zip(shipped_fmu(block.fmu_name, flavour))
        left_out = tuple(f"binaries/{name}/" for name in PLATFORMS if name not in platforms)
        files = {name: content for name, content in files.items() if not name.startswith(left_out)}
        write_zip(path, add_evidence(block, files))  # the manifest lists only these files
    elif not platforms:
        raise no_compiler(block.fmu_name, fmi)
    else:
        build_native_fmu(block, path, platforms=platforms, portable=has_zig(), fmi=fmi)


def no_compiler(element: str | os.PathLike[str], fmi: int) -> InputError:
    """Return the error, with its remedy, for native FMUs without a C compiler."""
    other = "give `flavour` python" if fmi == 2 else "leave out `fmi`"
    return InputError("export", str(element), "no C compiler was found", f"pip install ziglang, or {other}")


def needs_python(file: str | os.PathLike[str], element: str, fmi: int) -> InputError:
    """Return the error, with its remedy, for a block that cannot be compiled."""
    if fmi == 3:
        return InputError(file, element, "needs Python, but Python FMUs are FMI 2.0 FMUs", "leave out `fmi`")
    return InputError(file, element, "needs Python and has no native form", "give `flavour` python")


def has_zig() -> bool:
    """Return True if zig is available, the only compiler that targets Windows and old C libraries on any machine."""
    return "win64" in available_platforms()
