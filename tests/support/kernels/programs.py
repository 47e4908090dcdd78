"""Programs of `checksum_fmu.c` and one block: its C, by any compiler for any processor, or the library of its FMU."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from perilune.fmus_src.block import Block
from perilune.fmus_src.export.native_fmu import native_sources
from tests.support import kernels
from tests.support.kernels.native_instance import GUID

DRIVER = Path(kernels.__file__).with_name("checksum_fmu.c")
ZIG = [sys.executable, "-m", "ziglang", "cc"]
FLAGS = ["-std=c99", "-ffp-contract=off", "-fno-tree-vectorize"]
QEMU = shutil.which("qemu-aarch64-static") or shutil.which("qemu-aarch64")
NO_QEMU = "no qemu-aarch64"  # what the last lines of the tests look for
# Name: compiler with flags, and what runs the program.
COMPILERS: dict[str, tuple[list[str], list[str]]] = {
    "cc -O0": (["cc", "-O0"], []),
    "cc -O2": (["cc", "-O2"], []),
    "cc -O3": (["cc", "-O3"], []),
    "cc -O3 -march=native": (["cc", "-O3", "-march=native"], []),
    "zig x86_64": ([*ZIG, "-target", "x86_64-linux-musl", "-O2"], []),
    "zig x86_64 with FMA": ([*ZIG, "-target", "x86_64-linux-musl", "-O3", "-mcpu=x86_64_v3"], []),
    "zig aarch64": ([*ZIG, "-target", "aarch64-linux-musl", "-O3"], [QEMU or "qemu-aarch64-static"]),
}


def checksum(block: type[Block], compiler: str, steps: int, folder: Path) -> str:
    """Return the checksum of a flight of random inputs, and the number of failed steps."""
    command, runner = COMPILERS[compiler]
    for name, text in native_sources(block, GUID).items():
        (folder / name).write_bytes(text)
    program = folder / "program"
    link([*command, *FLAGS], [f"{block.fmu_name}.c", "-lm"], program)
    return fly(block, [*runner, str(program)], GUID, steps)


def link(command: list[str], inputs: list[str], program: Path) -> None:
    """Make the driver's program with sources or a library of its folder, where the FMI headers lie."""
    words = [*command, "-I", ".", "-o", str(program), str(DRIVER), *inputs]
    compiled = subprocess.run(words, cwd=program.parent, capture_output=True, text=True, check=False)
    assert compiled.returncode == 0, compiled.stderr


def fly(
    block: type[Block], program: list[str], guid: str, steps: int, environment: Mapping[str, str] | None = None
) -> str:
    """Return the output of a program of `link`."""
    variables = block.variables.values()
    kinds = "".join(variable.type_name[0].lower() * variable.size for variable in variables)
    causalities = "".join(variable.causality[0] * variable.size for variable in variables)
    words = [*program, guid, kinds, causalities, str(block.default_step), str(steps)]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
