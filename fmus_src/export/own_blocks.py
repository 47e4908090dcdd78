"""Blocks that a user wrote in a file, as FMUs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..block import Block
from ..catalogue import blocks_in_file, catalogue
from .native_fmu import build_native_fmu
from .pythonfmu_fmu import build_python_fmu


def own_blocks(path: Path) -> list[type[Block]]:
    """The blocks of a file. Raises ValueError for a file without any, and for names of the repository's own."""
    found = blocks_in_file(path)
    for block in found:
        if block.fmu_name in catalogue():
            raise ValueError(
                f"{path}: {block.__name__}: {block.fmu_name} is an FMU of this repository; rename the class"
            )
    return found


def build_own_blocks(
    path: Path, folder: Path, flavours: Sequence[str], platforms: Sequence[str], *, portable: bool = False
) -> list[Path]:
    """Build the blocks of a file as ``folder``/FLAVOUR/NAME.fmu; returns what was written.

    A block that needs Python has no native form, and is left out there. Raises ValueError for what is wrong in the
    file, `CompilerMissing` and `CompilationFailed`.
    """
    written = []
    for block in own_blocks(path):
        for flavour in flavours:
            target = folder / flavour / f"{block.fmu_name}.fmu"
            if flavour == "python":
                written.append(build_python_fmu(block, target))
            elif not block.python_only:
                written.append(build_native_fmu(block, target, platforms=platforms, portable=portable))
    return written
