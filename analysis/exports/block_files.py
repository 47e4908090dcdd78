"""Export of the blocks in a Python file to build/fmus in the working folder."""

from __future__ import annotations

import tempfile
from pathlib import Path

from ...common.atomic import write_atomically
from ...common.errors import InputError, suggestion
from ...common.paths import FLAVOURS, own_fmu
from ...common.targets import check_file
from ...fmus_src.catalogue import blocks_in_file, catalogue
from ...fmus_src.export.own_blocks import build_own_blocks, defines, files_with, folder_of
from ...fmus_src.export.sources import record_source, remove_outdated
from ..runtime.ssp.archive import system_names
from .fmus import has_zig, needs_python, no_compiler
from .request import ExportedFiles, ExportRequest


def check_file_exists(file: Path) -> None:
    """Reject a Python file that does not exist; the error suggests existing files. Raises InputError."""
    if file.is_file():
        return
    siblings = [path.name for path in file.parent.glob("*.py")] if file.parent.is_dir() else []
    remedy = "give the .py file that defines the blocks"
    if siblings:
        remedy += f": {suggestion(file.name, siblings)}"
    raise InputError(str(file), "", "no such file", remedy)


def find_block_file(name: str) -> Path | None:
    """Return the file of the working folder that defines a block: NAME.py, or the file with a class of that name.

    None is returned if the name belongs to another block or system, or if no file defines it. Raises InputError if
    several files contain such a class.
    """
    is_system = name in system_names() or Path(name, "SystemStructure.ssd").is_file()
    if not name.isidentifier() or name in catalogue() or is_system:
        return None
    file = Path(f"{name}.py")
    if file.is_file():
        return file
    files = [path for path in sorted(Path().glob("*.py")) if name in defines(path)]
    if len(files) > 1:
        raise InputError(
            "export", name, f"defined in {', '.join(map(str, files))}", "give the path of one of these files"
        )
    return files[0] if files else None


def export_file(file: Path, request: ExportRequest, only: str | None = None) -> ExportedFiles:
    """Export all blocks of a file, or the block ``only``, to build/fmus, where the option `use` finds them by name.

    Raises InputError.
    """
    requested, flavour, output, fmi = request.platforms, request.flavour, request.output, request.fmi
    platforms = request.find_platforms(prebuilt=False)
    flavours = [flavour] if flavour else [name for name in FLAVOURS if platforms or name == "python"]
    if fmi == 3:
        flavours = ["native"]
    blocks = [block for block in blocks_in_file(file) if only in (None, block.fmu_name)]
    if requested and all(block.python_only for block in blocks):
        problem = f"{', '.join(block.fmu_name for block in blocks)}: needs Python and has no native form"
        raise InputError("`platforms`", requested[0], problem, "leave out `platforms`")
    if flavours == ["native"] and not platforms:
        raise no_compiler(file, fmi)
    if output is None:
        for each in flavours:
            check_file("export", own_fmu(file.stem, folder_of(each, fmi)), new_folders=3)  # build/fmus/FLAVOUR
        folder = own_fmu("x", "x").parents[1]
        written = build_own_blocks(file, folder, flavours, platforms, only=only, portable=has_zig(), fmi=fmi)
        if not written:
            raise needs_python(file, only or file.stem, fmi)
        record_source(folder, file, written, files_with(file))
        for block in blocks_in_file(file) if "native" in flavours else ():
            if block.python_only:
                remove_outdated(folder, file, own_fmu(block.fmu_name, "native"))
        folders = {path.parent.name for path in written}
        built = tuple(name for name in flavours if folder_of(name, fmi) in folders)
        paths = tuple(path.relative_to(Path.cwd()) for path in written)
        return ExportedFiles(paths, built, tuple(platforms) if "native" in built else ())
    if output.suffix != ".fmu" or len(blocks) > 1:
        problem = "not an .fmu" if output.suffix != ".fmu" else f"the {len(blocks)} blocks of {file} need one FMU each"
        raise InputError("`output`", str(output), problem, "leave out `output`: FMUs are written to build/fmus")
    if flavour is None and blocks[0].python_only and fmi == 2:
        flavours = ["python"]
    with tempfile.TemporaryDirectory() as name:
        written = build_own_blocks(file, Path(name), flavours[:1], platforms, only=only, portable=has_zig(), fmi=fmi)
        if not written:
            raise needs_python(file, blocks[0].__name__, fmi)
        write_atomically(output, written[0].read_bytes())
    return ExportedFiles((output,), tuple(flavours[:1]), tuple(platforms) if flavours[0] == "native" else ())
