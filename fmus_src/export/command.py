"""The command line of build_fmus.py."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeVar

from tqdm import tqdm

from ..catalogue import catalogue
from ..own_digests import list_own
from ..paths import BUILD, FLAVOURS, SYSTEMS
from .compilers import CompilationFailed, CompilerMissing, compiled_here, platforms_of
from .native_fmu import build_native_fmu
from .pythonfmu_fmu import build_python_fmu
from .ssp_package import pack_system

T = TypeVar("T")


def main(arguments: Sequence[str] | None = None) -> int:
    """Build FMUs and systems; returns the exit status: 0 done, 1 compilation failed, 2 wrong input."""
    parser = argparse.ArgumentParser(prog="build_fmus.py", description="Build every FMU and pack every system.")
    parser.add_argument("--output", type=Path, metavar="DIR", default=BUILD, help="default: build")
    parser.add_argument("--flavour", choices=(*FLAVOURS, "all"), default="all")
    parser.add_argument(
        "--platform",
        action="append",
        choices=tuple(platforms_of(2)),
        help="platforms of native FMUs; may be repeated; default: that of this machine",
    )
    parser.add_argument("--portable", action="store_true", help="compile with zig, against an old C library")
    options = parser.parse_args(arguments)
    flavours: tuple[str, ...] = FLAVOURS if options.flavour == "all" else (options.flavour,)
    platforms = options.platform or compiled_here()
    if not platforms and "native" in flavours:
        flavours = tuple(flavour for flavour in flavours if flavour != "native")
        print("no C compiler for this machine: native FMUs are not built; pip install ziglang", file=sys.stderr)
        if not flavours:
            return 1
    try:
        counts = {flavour: _build(flavour, options.output, platforms, options.portable) for flavour in flavours}
        print(
            ", ".join(f"{count} {flavour} FMUs" for flavour, count in counts.items()), f"in {options.output / 'fmus'}"
        )
        folders = [options.output / "fmus" / flavour for flavour in flavours]
        for system in sorted(path.parent for path in SYSTEMS.glob("*/SystemStructure.ssd")):
            print(pack_system(system, folders, options.output / "ssp"))
    except ValueError as error:
        print(f"build_fmus.py: {error}", file=sys.stderr)
        return 2
    except (CompilerMissing, CompilationFailed) as error:
        print(f"build_fmus.py: {error}", file=sys.stderr)
        return 1
    return 0


def _build(flavour: str, output: Path, platforms: Sequence[str], portable: bool) -> int:
    """Build the FMUs of one flavour; returns how many. Blocks that need Python have no native form."""
    folder, blocks = output / "fmus" / flavour, catalogue()
    names = [name for name, block in blocks.items() if flavour == "python" or not block.python_only]

    def build(name: str) -> Path:
        path = folder / f"{name}.fmu"
        if flavour == "python":
            return build_python_fmu(blocks[name], path)
        return build_native_fmu(blocks[name], path, platforms=platforms, portable=portable)

    # Native FMUs take their time in compilers, each a process; pythonfmu's builder changes sys.path meanwhile.
    threads = 1 if flavour == "python" else os.cpu_count()
    with ThreadPoolExecutor(threads) as pool:
        list_own(folder, list(_progress(pool.map(build, names), f"{flavour} FMUs", len(names))))
    return len(names)


def _progress(work: Iterable[T], what: str, total: int) -> Iterable[T]:
    """The same with a bar on standard error, if that is a terminal."""
    return tqdm(work, desc=what, total=total, unit="FMU", disable=None, leave=False)
