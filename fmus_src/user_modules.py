"""Modules in a user's folder, imported as one package regardless of how they import each other.

A block file may contain `from .helper import table` or `import helper`; both refer to helper.py in its folder, in
Python and in an FMU, where they form one package.
"""

from __future__ import annotations

import ast
import hashlib
import importlib
import importlib.util
import io
import keyword
import re
import sys
import tokenize
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, SourceFileLoader
from pathlib import Path
from types import CodeType, ModuleType

LIBRARIES = frozenset(
    {"numpy", "perilune", "pythonfmu", *sys.stdlib_module_names}
)  # names that never refer to a file of the folder
FROM = re.compile(rb"from[\s\\]+")
_folders: dict[str, Path] = {}


def module_name(path: Path) -> str:
    """Return the module name for a file, replacing characters that Python could not import."""
    usable = path.stem.isidentifier() and not keyword.iskeyword(path.stem)
    return path.stem if usable else "file_" + re.sub(r"\W", "_", path.stem)


def is_sibling(name: str, folder: Path) -> bool:
    """Return True if `import name` in a file of the folder refers to a file there. Libraries take precedence."""
    return name not in LIBRARIES and (folder / f"{name}.py").is_file()


def with_relative_imports(text: bytes, file: Path) -> bytes:
    """Return the source of a module with relative imports of the other modules in its folder.

    Raises SyntaxError, which names the file.
    """
    folder = file.parent
    encoding, _ = tokenize.detect_encoding(io.BytesIO(text).readline)
    source = text.decode(encoding)
    text = source.encode()  # columns of the syntax tree count bytes of UTF-8
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    imports = [node for node in ast.walk(ast.parse(source, str(file))) if isinstance(node, ast.Import | ast.ImportFrom)]
    for node in sorted(imports, key=lambda node: (node.lineno, node.col_offset), reverse=True):
        start = starts[node.lineno - 1] + node.col_offset
        if isinstance(node, ast.ImportFrom):
            written = FROM.match(text, start)
            if not node.level and written and is_sibling(node.module or "", folder):
                text = text[: written.end()] + b"." + text[written.end() :]
        elif any(is_sibling(alias.name, folder) for alias in node.names):
            end = starts[(node.end_lineno or node.lineno) - 1] + (node.end_col_offset or 0)
            text = text[:start] + "; ".join(_import(alias, folder) for alias in node.names).encode() + text[end:]
    return text.decode().encode(encoding.removesuffix("-sig"))


def modules_of(path: Path) -> dict[Path, bytes]:
    """Return the sources, with relative imports, of a file and of all files in its folder that it needs.

    Imports of imported files are included. Raises SyntaxError.
    """
    folder = path.resolve().parent
    sources: dict[Path, bytes] = {}
    waiting = [path.resolve()]
    while waiting:
        file = waiting.pop()
        if file in sources or not file.is_file():
            continue
        sources[file] = with_relative_imports(file.read_bytes(), file)
        for node in ast.walk(ast.parse(sources[file])):
            if isinstance(node, ast.ImportFrom) and node.level == 1:
                waiting += [folder / f"{name}.py" for name in list_imports(node)]
    return sources


def list_imports(node: ast.ImportFrom) -> list[str]:
    """Return the modules of the folder that a relative import refers to.

    `from .a import x` refers to a, `from . import a, b` to both.
    """
    return [node.module] if node.module else [alias.name for alias in node.names]


def _import(alias: ast.alias, folder: Path) -> str:
    renamed = f" as {alias.asname}" if alias.asname else ""
    return f"{'from . ' if is_sibling(alias.name, folder) else ''}import {alias.name}{renamed}"


def import_file(path: Path) -> ModuleType:
    """Import a file of a user's folder as a module, reloading everything that it imports from the folder.

    Raises any exception that the file raises, and ModuleNotFoundError for a module that is not in the folder.
    """
    folder = path.resolve().parent
    package = f"perilune_user_{hashlib.sha256(str(folder).encode()).hexdigest()[:16]}"
    for name in [name for name in sys.modules if name == package or name.startswith(f"{package}.")]:
        del sys.modules[name]
    if not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.append(_Finder())
    _folders[package] = folder
    home = sys.modules[package] = ModuleType(package)
    home.__path__ = []
    name = f"{package}.{module_name(path)}"
    spec = importlib.util.spec_from_file_location(name, path, loader=_Loader(name, str(path)))
    assert spec is not None
    assert spec.loader is not None
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except ModuleNotFoundError as error:
        missing = (error.name or "").removeprefix(f"{package}.")
        if missing == error.name:
            raise
        raise ModuleNotFoundError(f"no {missing}.py next to it", name=missing) from error
    return module


class _Finder(MetaPathFinder):
    """Finder of the modules in users' folders by the names of their packages."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        package, _, name = fullname.rpartition(".")
        file = _folders[package] / f"{name}.py" if package in _folders else None
        if file is None or not file.is_file():
            return None
        return importlib.util.spec_from_file_location(fullname, file, loader=_Loader(fullname, str(file)))


class _Loader(SourceFileLoader):
    """Loader that compiles a module with relative imports and writes no bytecode into the user's folder."""

    def get_code(self, fullname: str) -> CodeType:
        path = Path(self.path)
        return self.source_to_code(with_relative_imports(path.read_bytes(), path), str(path))
