"""Template for a user's block, in a separate file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from ...common.atomic import write_atomically
from ...common.errors import InputError, suggestion
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.ssp_package import DESCRIPTION
from ..options.command import write_command
from ..options.declared.campaigns import RUN
from ..runtime.ssp.archive import open_system, system_names
from ..runtime.ssp.ssd_reader import read_description
from ..runtime.ssp.system_description import Component
from .fits import slots
from .name_checks import check_free, check_name, class_name

SLOTS = "slots"


@dataclass(frozen=True)
class CreatedFiles:
    """Files that were written, and the commands to run next."""

    paths: list[Path]
    commands: list[str]


def block_slots() -> list[str]:
    """Return the slots for which a block template exists."""
    return [Path(name).stem for name in template_names(SLOTS)]


def new_block(name: str, slot: str | None) -> CreatedFiles:
    """Write ``name``.py into the working folder, from the template of ``slot`` if stated. Raises InputError."""
    if slot is not None and slot not in block_slots():
        problem = "no block template exists for this slot" if slot in slots() else "no such slot"
        raise InputError("`slot`", slot, problem, suggestion(slot, block_slots()))
    check_name(name, (name,))
    path = Path(f"{name}.py")
    check_free(path)
    template = "block.py" if slot is None else f"{SLOTS}/{slot}.py"
    text = render(template, name=name, class_name=class_name(name))
    system, component = ("SYSTEM", "control") if slot is None else find_smallest_system(slot)
    first = ["perilune new system SYSTEM", "perilune export SYSTEM/blocks.py"] if slot is None else []
    write_atomically(path, text.encode())
    run = write_command(RUN, {"system": system}, {"use": {component: name}})
    return CreatedFiles([path], [f"perilune export {path}", *first, run])


def find_smallest_system(slot: str) -> tuple[str, str]:
    """Return the smallest system with a component of this slot, or of this block, and the name of the component."""
    blocks = catalogue()
    interface = slots().get(slot) or blocks[slot]
    candidates = []
    for name in system_names():
        elements = read_description(open_system(name)).system.elements
        for element in elements.values():
            block = blocks.get(Path(element.source).stem) if isinstance(element, Component) else None
            if block is not None and issubclass(block, interface):
                candidates.append((len(elements), name, element.name))
    if not candidates:
        raise InputError(
            "`slot`", slot, f"no {DESCRIPTION} of a system declares this slot", suggestion(slot, block_slots())
        )
    _, system, component = min(candidates)
    return system, component


FOLDER = Path(__file__).parent / "templates"
SUFFIX = ".jinja"


def template_names(folder: str) -> list[str]:
    """Return the names, within a folder, of the files that its templates render."""
    root = FOLDER / folder
    return sorted(path.relative_to(root).as_posix().removesuffix(SUFFIX) for path in root.rglob(f"*{SUFFIX}"))


def render(template: str, **content: Any) -> str:
    """Return the rendered text of a template; a missing value is an error."""
    environment = Environment(
        loader=FileSystemLoader(FOLDER),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # names are checked and units are Perilune's, so nothing needs escaping
    return environment.get_template(f"{template}{SUFFIX}").render(**content)
