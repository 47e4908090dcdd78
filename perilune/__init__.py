"""Perilune: FMI components, systems and analyses for spacecraft guidance, navigation and control.

The public names are those of `__init__.pyi`, each defined and documented in the module that it is imported from there.
They are looked up when they are first asked for, so that building an FMU does not load what simulates it.
"""

from __future__ import annotations

import ast
import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent

if not (HERE / "analysis").is_dir():
    raise ImportError(
        f"{HERE / 'analysis'} is a file, not a symbolic link: this checkout has no symbolic links; "
        "run `git config core.symlinks true` and `git checkout -- perilune`, or pip install a wheel"
    )

sys.meta_path.append(import_module(".fmus_src.former_names", __name__).FormerNames())


@cache
def _homes() -> dict[str, str | None]:
    """Return the module that defines each public name, relative to this one; None of a module."""
    statements = ast.parse((HERE / "__init__.pyi").read_text(encoding="utf-8")).body
    imports = [statement for statement in statements if isinstance(statement, ast.ImportFrom)]
    return {alias.name: statement.module for statement in imports for alias in statement.names}


def __getattr__(name: str) -> Any:
    if name == "__all__":
        return sorted(_homes())
    if name.startswith("__") or name not in _homes():
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    home = _homes()[name]
    if home is None:
        return import_module(f".{name}", __name__)
    return getattr(import_module(f".{home}", __name__), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *_homes()])
