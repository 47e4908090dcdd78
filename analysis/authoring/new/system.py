"""A system of a user's own to start from: blocks, description, parameter sets, a campaign, in a folder of its own."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

from ....fmus_src.catalogue import blocks_in_file
from ...verbs.options.campaigns import BATCH, RUN
from ...verbs.options.command import write_command
from ...verbs.options.studies import STABILITY
from .block import Written
from .connectors import part_of, units_of
from .names import check_free, check_name, class_name
from .rendering import render, template_names

SYSTEM, BLOCKS = "system", "blocks.py"
PARTS = ("plant", "control")  # what the SSD calls the blocks, in order of definition
SHOWN_UNITS = ("deg", "deg/s")  # of the annotations


def new_system(name: str) -> Written:
    """Write the folder ``name`` in the working folder, whole or not at all. Raises InputError and OSError."""
    check_name(name, tuple(f"{name}_{part}" for part in PARTS))
    folder = Path(name)
    check_free(folder)
    staged = Path(tempfile.mkdtemp(prefix=f".{name}.", dir=Path.cwd()))
    try:
        names = _write(staged, name)
        staged.chmod(0o777 & ~_mask())
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
    return Written([folder / entry for entry in names], commands)


def _write(folder: Path, name: str) -> list[str]:
    """All files of the system; those of the blocks first, since connectors follow from their declarations."""
    words = {"name": name, "class_name": class_name(name)}
    blocks = folder / BLOCKS
    blocks.write_text(render(f"{SYSTEM}/{BLOCKS}", **words), encoding="utf-8")
    parts = dict(zip(PARTS, map(part_of, blocks_in_file(blocks)), strict=True))
    shutil.rmtree(folder / "__pycache__", ignore_errors=True)
    units = units_of(list(parts.values()), SHOWN_UNITS)
    remainder = [entry for entry in template_names(SYSTEM) if entry != BLOCKS]
    for entry in remainder:
        path = folder / entry
        path.parent.mkdir(exist_ok=True)
        path.write_text(render(f"{SYSTEM}/{entry}", **words, **parts, units=units), encoding="utf-8")
    return [BLOCKS, *remainder]


def _mask() -> int:
    """The permissions that new files do not get; to read them is to set them."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
