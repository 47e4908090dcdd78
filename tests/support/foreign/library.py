"""Shared libraries of the C files of test FMUs, each compiled once for each choice of macros."""

from __future__ import annotations

import subprocess
import tempfile
from functools import cache
from pathlib import Path

import fmpy

from perilune.fmus_src.export.compilers import FLAGS, compilers_for


@cache
def library(name: str, macros: tuple[str, ...] = (), sources: Path = Path(__file__).parent) -> bytes:
    """Compile the shared library of name.c in a folder; ``macros`` are options of the compiler."""
    headers = Path(fmpy.__file__).parent / "c-code"
    with tempfile.TemporaryDirectory() as folder:
        target, source = Path(folder) / name, sources / f"{name}.c"
        command = [*compilers_for(fmpy.platform)[0], *FLAGS, *macros, f"-I{headers}", "-o", target, source, "-lm"]
        subprocess.run(command, check=True)
        return target.read_bytes()
