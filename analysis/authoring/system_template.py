"""Template for a user's system in a separate folder: blocks, description, parameter sets, a campaign."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

from ...fmus_src.catalogue import blocks_in_file
from ...fmus_src.export.pythonfmu_fmu import build_python_fmu
from ...fmus_src.export.ssp_package import DESCRIPTION, SYSTEM_FILE
from ..compose.assembly import compose_document, folder_archive
from ..compose.document import fmu_source
from ..compose.files import add_mark
from ..compose.source import read_source
from ..options.command import write_command
from ..options.declared.campaigns import BATCH, RUN
from ..options.declared.studies import STABILITY
from .block_template import CreatedFiles, render, template_names
from .name_checks import check_free, check_name, class_name

SYSTEM, BLOCKS = "system", "blocks.py"
PARTS = ("plant", "control")  # names of the blocks in the system, in order of definition


def new_system(name: str) -> CreatedFiles:
    """Create a new system in the folder ``name`` of the working folder, completely or not at all; return the created
    files and the next commands.

    Raises InputError and OSError.
    """
    check_name(name, tuple(f"{name}_{part}" for part in PARTS))
    folder = Path(name)
    check_free(folder)
    staged = Path(tempfile.mkdtemp(prefix=f".{name}.", dir=Path.cwd()))
    try:
        names = _write(staged, name)
        mask = os.umask(0)  # permissions withheld from new files; the mask can only be read by setting it
        os.umask(mask)
        staged.chmod(0o777 & ~mask)
        staged.rename(folder)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(folder)) from error
    finally:
        shutil.rmtree(staged, ignore_errors=True)
    commands = [
        f"perilune export {folder / BLOCKS}",
        write_command(RUN, {"system": name}, {"report": f"{name}.html"}),
        write_command(BATCH, {"system": name, "campaign": "dispersed"}, {"output": f"{name}_results"}),
        write_command(STABILITY, {"system": name}, {"report": f"{name}_stability.html"}),
    ]
    return CreatedFiles([folder / entry for entry in names], commands)


def _write(folder: Path, name: str) -> list[str]:
    """Write all files of the system and return their names in ``folder``.

    The description is composed with FMUs of the system's blocks, which are built temporarily.
    """
    words = {"name": name, "class_name": class_name(name)}
    (folder / BLOCKS).write_text(render(f"{SYSTEM}/{BLOCKS}", **words), encoding="utf-8")
    blocks = blocks_in_file(folder / BLOCKS)
    words |= {part: block.fmu_name for part, block in zip(PARTS, blocks, strict=True)}
    entries = template_names(SYSTEM)
    for entry in entries:
        path = folder / entry
        path.parent.mkdir(exist_ok=True)
        path.write_text(render(f"{SYSTEM}/{entry}", **words), encoding="utf-8")
    fmus = {}
    with tempfile.TemporaryDirectory() as built:
        for block in blocks:
            path = build_python_fmu(block, Path(built) / f"{block.fmu_name}.fmu")
            fmus[fmu_source(block.fmu_name)] = path.read_bytes()
    shutil.rmtree(folder / "__pycache__", ignore_errors=True)
    source, raw = read_source(folder / SYSTEM_FILE)
    document = add_mark(compose_document(source, folder_archive(folder, fmus)), SYSTEM_FILE, raw)
    (folder / DESCRIPTION).write_bytes(document)
    return sorted([*entries, DESCRIPTION], key=lambda entry: entry != BLOCKS)
