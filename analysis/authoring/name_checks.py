"""Checks of names for a user's blocks and systems."""

from __future__ import annotations

import keyword
import re
import sys
from pathlib import Path

from ...common.errors import InputError
from ...common.paths import FLAVOURS, own_fmu
from ...fmus_src.block import snake_case
from ...fmus_src.catalogue import catalogue
from ..runtime.ssp.archive import system_names


def class_name(name: str) -> str:
    """Return the class name for the name of an FMU: ``linear_guidance`` -> ``LinearGuidance``."""
    return "".join(part.capitalize() for part in name.split("_"))


def check_name(name: str, fmus: tuple[str, ...]) -> None:
    """Reject a name that is taken or not valid as a file, class and FMU name. Raises InputError.

    ``fmus`` are the names of the FMUs that will be built.
    """
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z][a-z0-9]*)*", name) or keyword.iskeyword(name):
        problem = "not a valid name of a file, a class and an FMU"
        remedy = "use lower-case letters, digits and single underscores, a letter first and after each underscore"
        raise InputError("new", name, problem, f"{remedy}, such as {_suggest_name(name)}")
    if name == "perilune" or name in sys.stdlib_module_names:
        raise InputError("new", name, f"hides Python's {name}", f"choose another name, such as my_{name}")
    if name in system_names():
        raise InputError("new", name, "is a system of this repository", f"choose another name, such as my_{name}")
    for fmu in fmus:
        if fmu in catalogue():
            raise InputError(
                "new", name, f"{fmu} is an FMU of this repository", f"choose another name, such as my_{name}"
            )
        built = [path for path in (own_fmu(fmu, flavour) for flavour in FLAVOURS) if path.exists()]
        if built:
            there = built[0].relative_to(Path.cwd())
            raise InputError("new", name, f"there is {there} already", "choose another name, or remove this file")


def _suggest_name(name: str) -> str:
    """Return a permitted name similar to this one."""
    words = re.sub(r"[^a-z0-9]+", "_", snake_case(name)).strip("_")
    words = re.sub(r"_(?=\d)", "", words).lstrip("0123456789_")
    return f"my_{words}" if not words or keyword.iskeyword(words) else words


def check_free(path: Path) -> None:
    """Reject the path of an existing file or folder. Raises InputError."""
    if path.exists() or path.is_symlink():
        raise InputError(
            "new",
            str(path),
            "already exists and is not overwritten",
            "choose another name, or move the existing one away",
        )
