"""The ordered list of folders, tests/folders.toml, and the imports between them as Python's own parser reads them."""

from __future__ import annotations

import ast
import tomllib
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from perilune.common.paths import ROOT

TOPS = ("analysis", "fmus_src", "common")
OURS = {"perilune", *TOPS}
FOLDERS: dict[str, str] = tomllib.loads((ROOT / "tests" / "folders.toml").read_text(encoding="utf-8"))
FILES = sorted(path for top in TOPS for path in (ROOT / top).rglob("*.py") if path.name != "__init__.py")


def folder_of(module: str) -> str:
    """Return the innermost folder of the list that contains a module, ``analysis.campaigns.trials``."""
    path = module.replace(".", "/")
    return max((folder for folder in FOLDERS if path == folder or path.startswith(f"{folder}/")), key=len)


def module_of(file: Path) -> str:
    """Return the module of a file."""
    return ".".join(file.relative_to(ROOT).with_suffix("").parts)


@cache
def imports(file: Path) -> tuple[str, ...]:
    """Return the modules of ours that a file imports, below perilune; within functions, too."""
    return tuple(_iterate_imports(file))


def _iterate_statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the statements below a node; no expressions, which are most of a syntax tree and hold no import."""
    for field in ("body", "orelse", "handlers", "finalbody", "cases"):
        below = getattr(node, field, ())
        for each in below if isinstance(below, list) else ():
            yield each
            yield from _iterate_statements(each)


def _iterate_imports(file: Path) -> Iterator[str]:
    package = list(file.relative_to(ROOT).parts[:-1])
    for node in _iterate_statements(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            assert not any(alias.name.split(".")[0] in OURS for alias in node.names), file
        if isinstance(node, ast.ImportFrom):
            assert node.level or (node.module or "").split(".")[0] not in OURS, file
            if node.level:
                base = [*package[: len(package) - (node.level - 1)], *(node.module or "").split(".")]
                base = [part for part in base if part]
                for alias in node.names:
                    inner = ROOT.joinpath(*base, alias.name)
                    is_module = inner.with_suffix(".py").is_file() or (inner / "__init__.py").is_file()
                    yield ".".join([*base, alias.name] if is_module else base)


@cache
def importing_files() -> dict[str, list[tuple[str, str]]]:
    """Return (importing file, imported module) of every import of ours, by the file's folder on disk."""
    pairs = defaultdict(list)
    for file in FILES:
        name = file.relative_to(ROOT).as_posix()
        pairs[file.parent.relative_to(ROOT).as_posix()] += [(name, module) for module in imports(file)]
    return pairs
