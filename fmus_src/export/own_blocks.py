"""FMUs of the blocks in a user's file."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from pathlib import Path

from ..block import snake_case
from ..catalogue import blocks_in_file
from ..user_modules import modules_of
from .closure import data_files
from .native_fmu import build_native_fmu
from .pythonfmu_fmu import build_python_fmu


def defines(path: Path) -> list[str]:
    """Return the FMU names of all classes that a file defines, whether blocks or not, without importing it."""
    try:
        tree = ast.parse(path.read_bytes())
    except (OSError, SyntaxError, ValueError):
        return []
    return [snake_case(node.name) for node in tree.body if isinstance(node, ast.ClassDef)]


def files_with(path: Path) -> list[Path]:
    """Return the other files from which the blocks of a file are built: imported modules and data."""
    data = [file for block in blocks_in_file(path) for file in data_files(block)]
    return sorted({*modules_of(path), *data} - {path.resolve()})


def build_own_blocks(
    path: Path,
    folder: Path,
    flavours: Sequence[str],
    platforms: Sequence[str],
    *,
    only: str | None = None,
    portable: bool = False,
    fmi: int = 2,
) -> list[Path]:
    """Build all blocks of a file, or ``only`` the named one, as ``folder``/FLAVOUR/NAME.fmu; return the paths.

    FMUs of FMI 3.0 are built to ``folder``/fmi3. Python-only blocks have no native form and are omitted there. Raises
    ValueError for errors in the file, `CompilerMissing` and `CompilationFailed`.
    """
    written = []
    for block in blocks_in_file(path):
        for flavour in flavours if only in (None, block.fmu_name) else ():
            target = folder / folder_of(flavour, fmi) / f"{block.fmu_name}.fmu"
            if flavour == "python":
                build_python_fmu(block, target)
            elif not block.python_only:
                build_native_fmu(block, target, platforms=platforms, portable=portable, fmi=fmi)
            else:
                continue
            written.append(target)
    return written


def folder_of(flavour: str, fmi: int) -> str:
    """Return the folder of FMUs of one kind; ``use`` finds those of FMI 2.0 there."""
    return flavour if fmi == 2 else f"fmi{fmi}"
