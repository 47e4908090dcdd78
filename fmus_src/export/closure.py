"""Python files that a block needs, packed under a package name that contains the hash of their content.

An FMU always runs the code with which it was built: two versions of a block can be loaded in one process, since their
packages have different names.
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
from ..former_names import FORMER, stand_in
from ..user_modules import list_imports, module_name, modules_of

FACE_PACKAGE = SOURCE_PACKAGE.rpartition(".")[0]  # package from which the names of `face` can be imported, too
SOURCE_ROOT = Path(__file__).parents[1]
OUTSIDE = "outside"  # folder in the package for a user's modules and data
RUNTIME_MODULES = ("export.pythonfmu_slave", "face")  # imported by the slave script and the package


class ClosureError(ValueError):
    """Error of an import that cannot be packed; the message names file, import and remedy."""


@dataclass(frozen=True)
class Closure:
    """Files of the package by path inside it, the block's module, and the content hash."""

    files: dict[str, bytes]
    block_module: str
    digest: str

    @property
    def package(self) -> str:
        return f"perilune_{self.digest[:16]}"

    def pack_closure(self) -> dict[str, bytes]:
        """Return the files below the package's folder, with imports of the source package and its parent renamed."""
        renamed = {
            _imports_of(SOURCE_PACKAGE, r"(?=\s|\.)"): rb"\g<1>" + self.package.encode(),
            _imports_of(FACE_PACKAGE, r"(?=\s)"): rb"\g<1>" + f"{self.package}.face".encode(),
        }
        packed = dict(self.files)
        for pattern, replacement in renamed.items():
            packed |= {
                name: pattern.sub(replacement, content) for name, content in packed.items() if name.endswith(".py")
            }
        return {f"{self.package}/{name}": content for name, content in packed.items()}


def _imports_of(package: str, end: str) -> re.Pattern[bytes]:
    return re.compile(rf"^(\s*(?:from|import)\s+){re.escape(package)}\b{end}".encode(), re.MULTILINE)


def closure_of(block_class: type[Block]) -> Closure:
    """Return the import closure of a block within the source package, as files.

    A user's block is packed with the modules of its folder that it imports, and every block with its ``data``. Raises
    `ClosureError` for missing data, and for imports other than these modules, the source package, the standard library,
    numpy and the block's ``requires``.
    """
    files: dict[str, bytes] = {}
    module = sys.modules[block_class.__module__]
    allowed = frozenset({"numpy", "pythonfmu", *block_class.requires} | sys.stdlib_module_names)
    if module.__name__.startswith(f"{SOURCE_PACKAGE}."):
        block_module = module.__name__.removeprefix(f"{SOURCE_PACKAGE}.")
        _collect(block_module, files, allowed)
    else:
        path = Path(inspect.getfile(block_class))
        block_module = f"{OUTSIDE}.{module_name(path)}"
        files[f"{OUTSIDE}/__init__.py"] = b""
        for file, text in modules_of(path).items():
            name = f"{OUTSIDE}.{module_name(file)}"
            files[name.replace(".", "/") + ".py"] = text
            for imported in _read_import(text, name, file, allowed):
                _collect(imported, files, allowed)
    for name in RUNTIME_MODULES:
        _collect(name, files, allowed)
    for path, owner in data_files(block_class).items():
        ours = owner.__module__.startswith(f"{SOURCE_PACKAGE}.")
        folder = owner.__module__.split(".")[-2] if ours else OUTSIDE
        files[f"{folder}/{path.name}"] = path.read_bytes()
    digest = hashlib.sha256(block_class.fmu_name.encode())
    for name in sorted(files):
        digest.update(b"\0" + name.encode() + b"\0" + files[name])
    return Closure(files, block_module, digest.hexdigest())


def data_files(block_class: type[Block]) -> dict[Path, type[Block]]:
    """Return the data files of a block, each with the class that declares it. Raises `ClosureError` for a missing
    file.
    """
    owners: dict[Path, type[Block]] = {}
    for owner in block_class.__mro__:
        for name in vars(owner).get("data", ()):
            source = Path(inspect.getfile(owner)).resolve()
            path = source.with_name(name)
            if not path.is_file():
                problem = f"data names {name}, which is not next to {source.name}"
                raise ClosureError(f"{source}: {owner.__name__}: {problem}; put the file there, or remove its name")
            owners[path] = owner
    return owners


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
    files[key] = stand_in(module).encode() if module in FORMER else path.read_bytes()
    for name in _read_import(files[key], module, path, allowed):
        _collect(name, files, allowed)


def _with_submodules(parts: list[str], names: list[ast.alias]) -> list[str]:
    """Return the module that an import names, and its submodules among ``names``."""
    module = [part for part in parts if part]
    folder = SOURCE_ROOT.joinpath(*module)
    inner = [
        alias.name
        for alias in names
        if (folder / f"{alias.name}.py").is_file()
        or (folder / alias.name / "__init__.py").is_file()
        or ".".join([*module, alias.name]) in FORMER
    ]
    return [".".join(module), *(".".join([*module, name]) for name in inner)]


def _home(name: str, path: Path, line: int) -> str:
    """Return the module of the source package that defines a public name."""
    if name not in HOME_OF:
        near = difflib.get_close_matches(name, HOME_OF, n=3)
        remedy = f"did you mean {' or '.join(near)}?" if near else f"import from {SOURCE_PACKAGE}"
        raise ClosureError(
            f"{path}:{line}: import of {FACE_PACKAGE}.{name}, which is not packed into the FMU; {remedy}"
        )
    return HOME_OF[name]


def _check_siblings(node: ast.ImportFrom, path: Path) -> None:
    """Reject a relative import that leaves a user's folder."""
    for name in list_imports(node):
        if node.level > 1 or not path.with_name(f"{name}.py").is_file():
            written = "." * node.level + (node.module or name)
            remedy = f"import from files next to {path.name}"
            raise ClosureError(f"{path}:{node.lineno}: import of {written}, which is not packed into the FMU; {remedy}")


@cache  # blocks share most of their files
def _read_import(text: bytes, module: str, path: Path, allowed: frozenset[str]) -> tuple[str, ...]:
    """Return the modules of the source package that a statement imports, as dotted names below it."""
    package = module.rsplit(".", 1)[0].split(".") if "." in module else []
    modules: list[str] = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and node.level > 0 and package == [OUTSIDE]:
            _check_siblings(node, path)
        elif isinstance(node, ast.ImportFrom) and node.level > 0:
            base = package[: len(package) - (node.level - 1)]
            modules += _with_submodules([*base, *(node.module or "").split(".")], node.names)
        elif isinstance(node, ast.ImportFrom) and f"{node.module}.".startswith(f"{SOURCE_PACKAGE}."):
            modules += _with_submodules((node.module or "").removeprefix(SOURCE_PACKAGE).split("."), node.names)
        elif isinstance(node, ast.ImportFrom) and node.module == FACE_PACKAGE:
            modules += [_home(alias.name, path, node.lineno) for alias in node.names]
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else [node.module or ""]
            for name in names:
                if name.split(".")[0] not in allowed:
                    raise ClosureError(
                        f"{path}:{node.lineno}: import of {name}, which is not packed into the FMU; "
                        f"import from {FACE_PACKAGE} or from a file in the same folder, or list the library in requires"
                    )
    return tuple(modules)
