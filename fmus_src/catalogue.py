"""Catalogue of blocks by FMU name."""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
import re
from functools import cache
from pathlib import Path
from types import ModuleType

from .block import Block, snake_case
from .user_modules import import_file
from .variables import DeclarationError

HERE = Path(__file__).parent
KINDS = (
    "plants", "environment", "sensors", "navigation", "guidance", "control", "actuators", "disturbances", "sequencing",
)  # fmt: skip
CLASS = re.compile(r"^class (\w+)", re.MULTILINE)


def blocks_of(module: ModuleType) -> list[type[Block]]:
    """Return the blocks that a module defines, without interfaces, in order of definition."""
    blocks = [
        value
        for value in vars(module).values()
        if inspect.isclass(value) and issubclass(value, Block) and value.__module__ == module.__name__
    ]
    return [block for block in blocks if not block.is_interface]


def is_shipped(block_class: type[Block]) -> bool:
    """Return True if the block belongs to Perilune, False if a user wrote it."""
    return block_class.__module__.startswith(f"{__package__}.")


def catalogue() -> dict[str, type[Block]]:
    """Return every block of the repository by FMU name, in order of kind and file.

    Raises ValueError if two blocks have the same FMU name.
    """
    return dict(_catalogue())


@cache
def _catalogue() -> dict[str, type[Block]]:
    blocks: dict[str, type[Block]] = {}
    for kind in KINDS:
        for module in pkgutil.iter_modules([str(HERE / kind)]):
            for block in blocks_of(importlib.import_module(f"{__package__}.{kind}.{module.name}")):
                if block.fmu_name in blocks:
                    raise ValueError(
                        f"{block.__module__}.{block.__name__}: FMU name {block.fmu_name} is taken; rename the block"
                    )
                blocks[block.fmu_name] = block
    return blocks


@cache
def block_kinds() -> dict[str, str]:
    """Return the kind of every class in the repository's block modules by FMU name, without importing them."""
    return {
        snake_case(name): kind
        for kind in KINDS
        for path in sorted((HERE / kind).glob("*.py"))
        for name in CLASS.findall(path.read_text(encoding="utf-8"))
    }


def blocks_in_file(path: Path) -> list[type[Block]]:
    """Return the blocks defined in a Python file outside the repository.

    Raises ValueError, with the file's name, if it is a file of the repository, defines no block or cannot be imported.
    """
    if not path.is_file():
        raise ValueError(f"{path}: not a Python file; give the .py file that defines the blocks")
    if path.resolve().is_relative_to(HERE.resolve()):
        remedy = "build_fmus.py builds its blocks, perilune export NAME exports one of them"
        raise ValueError(f"{path}: a file of Perilune itself; {remedy}")
    _check_names(path)
    try:
        module = import_file(path)
    except Exception as error:  # any exception from the user's file is reported in one line
        # Python 3.11 wraps exceptions of declarations
        reason = error.__cause__ if isinstance(error.__cause__, DeclarationError) else error
        raise ValueError(f"{path}: importing it failed: {type(reason).__name__}: {reason}; correct the file") from error
    blocks = blocks_of(module)
    if not blocks:
        raise ValueError(f"{path}: defines no block; derive a class from perilune.Block or an interface of it")
    names: dict[str, str] = {}
    for block in blocks:
        other = names.setdefault(block.fmu_name, block.__name__)
        if other != block.__name__:
            raise ValueError(
                f"{path}: {other} and {block.__name__} have the same FMU name, {block.fmu_name}; rename one"
            )
    return blocks


def _check_names(path: Path) -> None:
    """Reject a file with two classes of the same name, of which Python would silently keep only the last."""
    try:
        tree = ast.parse(path.read_bytes())
    except (SyntaxError, ValueError):
        return  # reported by the import with more detail
    lines: dict[str, int] = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            if node.name in lines:
                places = f"lines {lines[node.name]} and {node.lineno}"
                raise ValueError(f"{path}: {places} define two classes {node.name}; rename one")
            lines[node.name] = node.lineno
