"""perilune export: an FMU or a whole system for another tool or platform."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from ...fmus_src.block import Block
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.compilers import PLATFORMS, CompilationFailed, CompilerMissing, available_platforms
from ...fmus_src.export.native_fmu import build_native_fmu
from ...fmus_src.export.pythonfmu_fmu import build_python_fmu
from ...fmus_src.export.ssp_package import SSD_NAMESPACE, pack_system
from ..atomic import write_atomically
from ..errors import InputError, suggestion
from ..system.archive import SystemArchive, open_system, system_names
from ..system.documents import parse_xml
from ..system.options import FLAVOURS
from .common.options import add_json, write_json


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="SYSTEM|FMU", help="a system of ssp_systems (or its folder), or a block's name")
    parser.add_argument(
        "--platform",
        action="append",
        choices=tuple(PLATFORMS),
        help="of native FMUs; may be repeated; default: linux64, win64",
    )
    parser.add_argument("--flavour", choices=FLAVOURS, default="native", help="default: native")
    parser.add_argument("--output", type=Path, metavar="F", help="default: NAME.fmu or NAME.ssp here")
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    blocks = catalogue()
    is_fmu = options.name in blocks
    if not is_fmu and options.name not in system_names() and not Path(options.name).is_dir():
        known = [*blocks, *system_names()]
        raise InputError("export", options.name, "neither an FMU nor a system", suggestion(options.name, known))
    if options.platform and options.flavour == "python":
        raise InputError("--platform", options.platform[0], "Python FMUs have no platform to choose", "leave it out")
    platforms = [] if options.flavour == "python" else options.platform or available_platforms()
    path = options.output or Path(f"{Path(options.name).name}.{'fmu' if is_fmu else 'ssp'}")
    try:
        if is_fmu:
            _build(blocks[options.name], path, options.flavour, platforms)
        else:
            _export_system(open_system(options.name), path, options.flavour, platforms)
    except CompilerMissing as error:
        raise InputError("export", options.name, "cannot be compiled here", str(error)) from error
    except CompilationFailed as error:
        raise InputError("export", options.name, "the compiler refused it", " ".join(str(error).split())) from error
    document = {"path": str(path), "flavour": options.flavour, "platforms": platforms}
    if not write_json(document, options.json):
        print(path)
    return 0


def _build(block: type[Block], path: Path, flavour: str, platforms: list[str]) -> None:
    """One FMU; a native one is compiled against an old C library where zig is there to do so."""
    if flavour == "python":
        build_python_fmu(block, path)
    elif block.python_only:
        raise InputError("export", block.fmu_name, "needs Python and has no native form", "give --flavour python")
    elif not platforms:
        raise InputError("export", block.fmu_name, "no C compiler here", "pip install ziglang, or --flavour python")
    else:
        with tempfile.TemporaryDirectory() as cache:
            portable = "win64" in available_platforms()  # only zig serves both
            build_native_fmu(block, path, platforms=platforms, cache=Path(cache), portable=portable)


def _export_system(archive: SystemArchive, path: Path, flavour: str, platforms: list[str]) -> None:
    """The system's folder with freshly built FMUs as one archive."""
    blocks = catalogue()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for entry in [entry for entry in archive.files if entry.endswith(".ssd")]:
            root = parse_xml(archive.read(entry, entry), f"{archive.label}/{entry}")
            for component in root.iter(f"{{{SSD_NAMESPACE}}}Component"):
                source = component.get("source", "")
                fmu = Path(source).stem
                if source not in archive.files and fmu in blocks and not (folder / f"{fmu}.fmu").exists():
                    _build(blocks[fmu], folder / f"{fmu}.fmu", flavour, platforms)
        try:
            packed = pack_system(archive.path, [folder], folder / "packed")
        except ValueError as error:
            raise InputError(archive.label, "export", str(error), "add the FMU or a block of its name") from error
        write_atomically(path, packed.read_bytes())
