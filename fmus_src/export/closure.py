"""The Python files a block needs, packed under a name that carries their content's hash.

An FMU always runs the code it was built with: two versions of a block can then live in one
process, since their packages have different names.
"""

from __future__ import annotations

import ast
import difflib
import hashlib
import inspect
import re
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from .. import __name__ as SOURCE_PACKAGE  # noqa: N812
from ..block import Block
from ..face import HOME_OF

FACE_PACKAGE = SOURCE_PACKAGE.rpartition(".")[0]  # from which the names of `face` may be imported, too
SOURCE_ROOT = Path(__file__).parents[1]
RUNTIME_MODULES = ("export.pythonfmu_slave", "face")  # what the slave script itself and the package import


class ClosureError(ValueError):
    """A block imports something that cannot be packed; file, import and remedy in the message."""


@dataclass(frozen=True)
class Closure:
    """Files of the package by path inside it, the block's module in it, and the content hash."""

    files: dict[str, bytes]
    block_module: str
    digest: str

    @property
    def package(self) -> str:
        return f"perilune_{self.digest[:16]}"

    def packed(self) -> dict[str, bytes]:
        """The files with imports of the source package, and of what it lies in, renamed, below the package's folder."""
        names = f"{re.escape(SOURCE_PACKAGE)}|{re.escape(FACE_PACKAGE)}"
        pattern = re.compile(rf"^(\s*(?:from|import)\s+)(?:{names})\b(?=\s|\.)".encode(), re.MULTILINE)
        replacement = rb"\g<1>" + self.package.encode()
        return {f"{self.package}/{name}": pattern.sub(replacement, text) for name, text in self.files.items()}


def closure_of(block_class: type[Block]) -> Closure:
    """The import closure of a block within the source package, as files.

    A block from outside the repository is packed as one module beside it. Raises `ClosureError`
    for imports other than the source package, the standard library, numpy and what the block
    declares in ``requires``.
    """
    files: dict[str, bytes] = {}
    module = sys.modules[block_class.__module__]
    allowed = frozenset({"numpy", "pythonfmu", *block_class.requires} | sys.stdlib_module_names)
    if module.__name__.startswith(f"{SOURCE_PACKAGE}."):
        block_module = module.__name__.removeprefix(f"{SOURCE_PACKAGE}.")
        _collect(block_module, files, allowed)
    else:
        path = Path(inspect.getfile(block_class))
        block_module = "outside_" + re.sub(r"\W", "_", path.stem)  # no module of ours has such a name
        text = path.read_bytes()
        files[f"{block_module}.py"] = text
        for name in _imported(text, block_module, path, allowed):
            _collect(name, files, allowed)
    for name in RUNTIME_MODULES:
        _collect(name, files, allowed)
    digest = hashlib.sha256(block_class.fmu_name.encode())
    for name in sorted(files):
        digest.update(b"\0" + name.encode() + b"\0" + files[name])
    return Closure(files, block_module, digest.hexdigest())


def _collect(module: str, files: dict[str, bytes], allowed: frozenset[str]) -> None:
    """Add a module of the source package (dotted name below it), its packages and its imports."""
    parts = module.split(".") if module else []
    for depth in range(len(parts)):
        package = "/".join([*parts[:depth], "__init__.py"])
        files.setdefault(package, (SOURCE_ROOT / package).read_bytes())
    path = SOURCE_ROOT.joinpath(*parts)
    path = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    key = path.relative_to(SOURCE_ROOT).as_posix()
    if key in files and not key.endswith("__init__.py"):
        return
    files[key] = path.read_bytes()
    for name in _imported(files[key], module, path, allowed):
        _collect(name, files, allowed)


def _with_submodules(parts: list[str], names: list[ast.alias]) -> list[str]:
    """The module that an import names, and those of ``names`` that are modules in it."""
    module = [part for part in parts if part]
    folder = SOURCE_ROOT.joinpath(*module)
    inner = [
        alias.name
        for alias in names
        if (folder / f"{alias.name}.py").is_file() or (folder / alias.name / "__init__.py").is_file()
    ]
    return [".".join(module), *(".".join([*module, name]) for name in inner)]


def _home(name: str, path: Path, line: int) -> str:
    """The module of the source package that defines a name of its face."""
    if name not in HOME_OF:
        near = difflib.get_close_matches(name, HOME_OF, n=3)
        remedy = f"did you mean {' or '.join(near)}?" if near else f"import from {SOURCE_PACKAGE}"
        raise ClosureError(f"{path}:{line}: import of {FACE_PACKAGE}.{name}: not packed into the FMU; {remedy}")
    return HOME_OF[name]


@cache  # all blocks share most of their files
def _imported(text: bytes, module: str, path: Path, allowed: frozenset[str]) -> tuple[str, ...]:
    """Modules of the source package that a file imports, as dotted names below it."""
    package = module.rsplit(".", 1)[0].split(".") if "." in module else []
    found: list[str] = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and node.level > 0:
            base = package[: len(package) - (node.level - 1)]
            found += _with_submodules([*base, *(node.module or "").split(".")], node.names)
        elif isinstance(node, ast.ImportFrom) and f"{node.module}.".startswith(f"{SOURCE_PACKAGE}."):
            found += _with_submodules((node.module or "").removeprefix(SOURCE_PACKAGE).split("."), node.names)
        elif isinstance(node, ast.ImportFrom) and node.module == FACE_PACKAGE:
            found += [_home(alias.name, path, node.lineno) for alias in node.names]
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else [node.module or ""]
            for name in names:
                if name.split(".")[0] not in allowed:
                    raise ClosureError(
                        f"{path}:{node.lineno}: import of {name}: not packed into the FMU; "
                        f"import from {FACE_PACKAGE}, or name the library in the block's requires"
                    )
    return tuple(found)
