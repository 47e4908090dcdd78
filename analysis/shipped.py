"""Command line of build_fmus.py: builds the FMUs, composes the shipped systems from `system.toml`, and packs them."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ..common.atomic import write_atomically
from ..common.paths import BUILD, FLAVOURS, SYSTEMS
from ..fmus_src.export.build import build_fmus
from ..fmus_src.export.compilers import (
    CompilationFailed,
    CompilerMissing,
    available_platforms,
    compiled_here,
    local_platform,
    platforms_of,
)
from ..fmus_src.export.ssp_package import DESCRIPTION, SYSTEM_FILE, pack_system
from .compose.document import fmu_source
from .compose.files import check_unedited
from .compose.source import read_source
from .runtime.loop.library import FMI, build_loop
from .verbs.compose import compose_source


def main(arguments: Sequence[str] | None = None) -> int:
    """Build FMUs and systems; return the exit status: 0 success, 1 compilation failed, 2 wrong input."""
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
        build_loop(options.output, _loop_platforms(options.portable), portable=options.portable)
        counts = {flavour: build_fmus(flavour, options.output, platforms, options.portable) for flavour in flavours}
        print(
            ", ".join(f"{count} {flavour} FMUs" for flavour, count in counts.items()), f"in {options.output / 'fmus'}"
        )
        folders = [options.output / "fmus" / flavour for flavour in flavours]
        for path in sorted(SYSTEMS.glob(f"*/{SYSTEM_FILE}")):
            compose_shipped(path, folders)
            print(pack_system(path.parent, folders, options.output / "ssp"))
    except ValueError as error:
        print(f"build_fmus.py: {error}", file=sys.stderr)
        return 2
    except (CompilerMissing, CompilationFailed) as error:
        print(f"build_fmus.py: {error}", file=sys.stderr)
        return 1
    return 0


def _loop_platforms(portable: bool) -> list[str]:
    """Return the platforms to build the loop for: all of them if ``portable``, else the platform of this machine."""
    return available_platforms(FMI) if portable else [name for name in [local_platform(FMI)] if name is not None]


def compose_shipped(path: Path, fmus: Sequence[Path]) -> Path:
    """Write the SSD next to a `system.toml`, with each FMU from the first folder that contains it; return its path.

    Raises InputError for a system that cannot be simulated, and for an SSD that was edited by hand.
    """
    source, raw = read_source(path)
    built = {}
    for name in {fmu_source(component.fmu) for component in source.components.values()}:
        files = [folder / Path(name).name for folder in fmus if (folder / Path(name).name).is_file()]
        if files:
            built[name] = files[0].read_bytes()
    target = path.with_name(DESCRIPTION)
    check_unedited(target)
    write_atomically(target, compose_source(source, path.parent, raw, path.name, built))
    return target
