"""perilune export: an FMU, a system with its FMUs inside, or the blocks of a file, to fly here or elsewhere."""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

from ...fmus_src.block import Block
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.archive import read_zip, write_zip
from ...fmus_src.export.compilers import PLATFORMS, CompilationFailed, CompilerMissing, available_platforms
from ...fmus_src.export.native_fmu import build_native_fmu
from ...fmus_src.export.own_blocks import build_own_blocks, own_blocks
from ...fmus_src.export.pythonfmu_fmu import build_python_fmu
from ...fmus_src.export.ssp_package import SSD_NAMESPACE, pack_system
from ...fmus_src.places import FLAVOURS, IS_CHECKOUT, built_fmu, own_fmu
from ..atomic import write_atomically
from ..errors import InputError, suggestion
from ..system.archive import SystemArchive, open_system, system_names
from ..system.documents import parse_xml
from .common.options import check_json, tell
from .common.targets import check_file


def run(options: argparse.Namespace) -> int:
    if options.platform and options.flavour == "python":
        raise InputError("--platform", options.platform[0], "Python FMUs have no platform to choose", "leave it out")
    check_file("--output", options.output)
    check_json(options)
    try:
        document = _export(options)
    except CompilerMissing as error:
        raise InputError("export", options.name, "cannot be compiled here", str(error)) from error
    except CompilationFailed as error:
        raise InputError("export", options.name, "the compiler refused it", " ".join(str(error).split())) from error
    except InputError:
        raise
    except ValueError as error:  # what is wrong with a block, told by the export as one line
        print(f"perilune: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    return tell(document, options, lambda: print("\n".join(document["paths"])))


def _export(options: argparse.Namespace) -> dict[str, Any]:
    """What was written, in which flavours, for which platforms."""
    if options.name.endswith(".py"):
        return _export_file(options)
    flavour = options.flavour or "native"
    platforms = [] if flavour == "python" else _platforms(options)
    blocks = catalogue()
    if options.name in blocks:
        path = options.output or Path(f"{options.name}.fmu")
        check_file("--output", path, (".fmu",))
        _build(blocks[options.name], path, flavour, platforms)
    elif options.name in system_names() or Path(options.name).is_dir():
        path = options.output or Path(f"{Path(options.name).resolve().name}.ssp")
        check_file("--output", path, (".ssp",))
        _export_system(open_system(options.name), path, flavour, platforms)
    else:
        known = [*blocks, *system_names()]
        problem = "neither an FMU, a system nor a .py file"
        raise InputError("export", options.name, problem, suggestion(options.name, known))
    return {"paths": [str(path)]} | _made([flavour], platforms)


def _platforms(options: argparse.Namespace) -> list[str]:
    if options.platform:
        return options.platform
    return available_platforms() if IS_CHECKOUT or options.name.endswith(".py") else list(PLATFORMS)


def _build(block: type[Block], path: Path, flavour: str, platforms: list[str]) -> None:
    """One FMU of this repository: an installed package has its native ones with all their libraries inside."""
    if flavour == "python":
        build_python_fmu(block, path)
    elif block.python_only:
        raise InputError("export", block.fmu_name, "needs Python and has no native form", "give --flavour python")
    elif not IS_CHECKOUT:
        files = read_zip(built_fmu(block.fmu_name, flavour))
        left_out = tuple(f"binaries/{name}/" for name in PLATFORMS if name not in platforms)
        write_zip(path, {name: content for name, content in files.items() if not name.startswith(left_out)})
    elif not platforms:
        raise InputError("export", block.fmu_name, "no C compiler here", "pip install ziglang, or --flavour python")
    else:
        build_native_fmu(block, path, platforms=platforms, portable=_zig_is_here())


def _zig_is_here() -> bool:
    """Whether libraries are compiled against an old C library; only zig serves both of these platforms."""
    return "win64" in available_platforms()


def _export_system(archive: SystemArchive, path: Path, flavour: str, platforms: list[str]) -> None:
    """The system's folder as one archive, with the FMUs of this repository and of the working folder that it names."""
    blocks = catalogue()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for entry in [entry for entry in archive.files if entry.endswith(".ssd")]:
            root = parse_xml(archive.read(entry, entry), f"{archive.label}/{entry}")
            for component in root.iter(f"{{{SSD_NAMESPACE}}}Component"):
                source = component.get("source", "")
                target = folder / f"{Path(source).stem}.fmu"
                if source in archive.files or target.exists():
                    continue
                own = own_fmu(target.stem, flavour)
                if target.stem in blocks:
                    _build(blocks[target.stem], target, flavour, platforms)
                elif own.is_file():
                    shutil.copyfile(own, target)
                else:
                    element = f"{component.get('name')} (line {component.sourceline})"
                    problem = f"no {source} in the system, no FMU of this repository, no {own}"
                    remedy = f"build your own with perilune export FILE.py --flavour {flavour}, or add the FMU"
                    raise InputError(f"{archive.label}/{entry}", element, problem, remedy)
        packed = pack_system(archive.path, [folder], folder / "packed")
        write_atomically(path, packed.read_bytes())


def _export_file(options: argparse.Namespace) -> dict[str, Any]:
    """The blocks of a file into the working folder's build/fmus, where --use finds them by name."""
    file = Path(options.name)
    platforms = _platforms(options)
    flavours = [options.flavour] if options.flavour else [name for name in FLAVOURS if platforms or name == "python"]
    if len(flavours) < len(FLAVOURS) and options.flavour is None:
        print("perilune: no C compiler here: the Python flavour only; pip install ziglang for both", file=sys.stderr)
    output: Path | None = options.output
    if output is None:
        for flavour in flavours:
            check_file("export", own_fmu(file.stem, flavour))
        written = build_own_blocks(file, own_fmu("x", "x").parents[1], flavours, platforms, portable=_zig_is_here())
        return {"paths": [str(path.relative_to(Path.cwd())) for path in written]} | _made(flavours, platforms)
    blocks = own_blocks(file)
    if output.suffix != ".fmu" or len(blocks) > 1:
        problem = "not an .fmu" if output.suffix != ".fmu" else f"the {len(blocks)} blocks of {file} are no one FMU"
        raise InputError("--output", str(output), problem, "leave it out: FMUs go to build/fmus")
    with tempfile.TemporaryDirectory() as name:
        built = build_own_blocks(file, Path(name), flavours[:1], platforms, portable=_zig_is_here())
        if not built:
            raise InputError(file, blocks[0].__name__, "needs Python and has no native form", "give --flavour python")
        write_atomically(output, built[0].read_bytes())
    return {"paths": [str(output)]} | _made(flavours[:1], platforms)


def _made(flavours: list[str], platforms: list[str]) -> dict[str, Any]:
    return {"flavours": flavours, "platforms": platforms if "native" in flavours else []}
