"""A system of a user's own to start from: blocks, description, parameter sets, a campaign, in a folder of its own."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...fmus_src.block import Block, Input, Output
from ...fmus_src.catalogue import blocks_in_file
from ...fmus_src.units import UnitDefinition, unit_definition
from ..verbs.options.campaigns import BATCH, RUN
from ..verbs.options.command import write_command
from ..verbs.options.studies import STABILITY
from .block import Written, render, template_names
from .names import check_free, check_name, class_name


@dataclass(frozen=True)
class Connector:
    """One element of an input or output, as an SSD has it."""

    name: str
    kind: str
    type: str
    unit: str | None


@dataclass(frozen=True)
class Part:
    """What an SSD says of a component made by a block."""

    fmu: str
    connectors: Sequence[Connector]


@dataclass(frozen=True)
class NamedUnit:
    """A unit as an SSD defines it."""

    name: str
    definition: UnitDefinition


def part_of(block: type[Block]) -> Part:
    """All inputs and outputs of a block, element by element."""
    connectors = [
        Connector(name, variable.causality, variable.type_name, variable.unit)
        for variable in block.variables.values()
        if isinstance(variable, Input | Output)
        for name in variable.element_names()
    ]
    return Part(block.fmu_name, connectors)


def units_of(parts: Collection[Part], more: Collection[str] = ()) -> list[NamedUnit]:
    """The units of all connectors and ``more``, by name."""
    names = {connector.unit for part in parts for connector in part.connectors} | set(more)
    units = [(name, unit_definition(name)) for name in sorted(name for name in names if name is not None)]
    return [NamedUnit(name, definition) for name, definition in units if definition is not None]


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
        mask = os.umask(0)  # the permissions that new files do not get; to read them is to set them
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
