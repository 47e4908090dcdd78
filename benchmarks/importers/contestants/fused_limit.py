"""Lower limit of the cost of co-simulation: blocks fused into one compiled function, without FMI."""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import FLAGS, PLATFORMS, CompilerMissing, compilers_for, local_platform
from perilune.fmus_src.export.native_fmu import C_FILES

from ..contestant import ExchangeSystem, Fly, Unavailable, Values
from .fused_component import Part, write_part
from .fused_main import FILE, write_main

# Added to the FMUs' flags: optimise all units as one, export only the entry point.
FUSING = ("-flto", "-fvisibility=hidden")
INCLUDED = [f"-I{C_FILES / folder}" for folder in ("instance", "kernel")]


def prepare(course: ExchangeSystem, blocks: Mapping[str, type[Block]] | None = None) -> Fly:
    """Prepare the same blocks, parameters and connections in the same order, with inlining left to the compiler.

    The C source and floating-point flags are those of the native FMUs, so values are equal to the last bit. Like
    Perilune's loop it checks for NaN and infinity, and records the first and the last point. ``blocks`` contains the
    blocks by FMU name, by default the catalogue. Raises `Unavailable` for a component whose block is not among them.
    """
    library = ctypes.CDLL(str(compile_system(course, catalogue() if blocks is None else blocks)))
    function = library.fly
    function.argtypes = (ctypes.c_double, ctypes.c_double, ctypes.c_int64, ctypes.POINTER(ctypes.c_double))
    function.restype = ctypes.c_char_p
    names = course.names
    record = (ctypes.c_double * (2 * len(names)))()
    start, step = course.prepared.start, course.prepared.step

    def fly(steps: int) -> Values:
        problem = function(start, step, steps, record)
        if problem is not None:
            raise RuntimeError(problem.decode())
        return dict(zip(names, record[len(names) :], strict=True))

    return fly


def compile_system(course: ExchangeSystem, blocks: Mapping[str, type[Block]]) -> Path:
    """Compile the shared library in a new folder that also contains its sources; return its path."""
    platform = local_platform()
    if platform is None:
        raise Unavailable("there is no compiler for this platform")
    try:
        command, *others = compilers_for(platform)
    except CompilerMissing as reason:
        raise Unavailable(str(reason)) from reason
    if others:
        raise Unavailable("there is no compiler for this processor alone")
    parts = _parts(course, blocks)
    units = {part.file: part.unit for part in parts} | {FILE: write_main(course, parts)}
    folder = Path(tempfile.mkdtemp(prefix="perilune_fused_"))
    for name, text in units.items():
        (folder / name).write_text(text, encoding="utf-8")
    library = folder / f"fused{PLATFORMS[platform].extension}"
    finished = subprocess.run(
        [*command, *FLAGS, *FUSING, *INCLUDED, "-o", library.name, *units, "-lm"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    if finished.returncode != 0:
        raise RuntimeError(f"{command[0]} on the fused system:\n{finished.stderr}")
    return library


def _parts(course: ExchangeSystem, blocks: Mapping[str, type[Block]]) -> list[Part]:
    parts: list[Part] = []
    types: dict[str, str] = {}
    for number, (component, fmu) in enumerate(course.prepared.network.fmus.items()):
        mine = {name: value for (owner, name), value in course.settings().items() if owner == component}
        part = write_part(component, number, fmu, blocks, mine)
        for name, struct in part.structs.items():
            if types.setdefault(name, struct) != struct:
                raise Unavailable(f"{component}: another block has a struct {name}, too")
        parts.append(part)
    return parts
