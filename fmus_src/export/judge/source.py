"""Source of a kernel function: file, syntax tree, comments."""

from __future__ import annotations

import ast
import copy
import io
import tokenize
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from threading import Lock
from types import FunctionType, ModuleType
from typing import Any

PARSING = Lock()
PACKAGE_ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Source:
    """Python function of a kernel; ``owner`` is the class that defines a method."""

    function: FunctionType
    owner: type | None
    path: Path
    node: ast.FunctionDef

    @property
    def name(self) -> str:
        return self.node.name

    @property
    def module(self) -> str:
        """Full name of the module, such as ``perilune.fmus_src.mathlib.vectors``."""
        return self.function.__module__

    @property
    def qualified_name(self) -> str:
        """Name with the class of a method: ``quadratic_time`` or ``TerminalGuidance.follow``."""
        return f"{self.owner.__name__}.{self.name}" if self.owner else self.name


def source_of(function: FunctionType, owner: type | None) -> Source | None:
    """Return the source of a function, or None if its file cannot be read or does not contain it."""
    path = Path(function.__code__.co_filename)
    try:
        tree = _tree(path)
    except (OSError, SyntaxError):
        return None
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and node.name == function.__name__:
            first_line = min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])
            if first_line == function.__code__.co_firstlineno:
                return Source(function, owner, path, node)
    return None


def with_plain_arguments(source: Source, count: int) -> Source:
    """Return a function with ``*inputs`` replaced by separate arguments, for ``count`` arguments in total."""
    arguments = source.node.args
    if arguments.vararg is None or arguments.kwonlyargs:
        return source
    names = [argument.arg for argument in arguments.args if argument.arg != "self" or source.owner is None]
    return replace(source, node=_plain(source.node, max(0, count - len(names))))


@cache
def _plain(node: ast.FunctionDef, count: int) -> ast.FunctionDef:
    plain = copy.deepcopy(node)
    assert plain.args.vararg is not None
    several, plain.args.vararg = plain.args.vararg, None
    names = [f"{several.arg}_{number + 1}" for number in range(count)]
    plain.args.args += [ast.copy_location(ast.arg(name, several.annotation), several) for name in names]
    for call in ast.walk(plain):
        if isinstance(call, ast.Call):
            call.args = [part for argument in call.args for part in _expand(argument, several.arg, names)]
    return plain


def _expand(argument: ast.expr, several: str, names: list[str]) -> list[ast.expr]:
    """Return the replacement of an argument: several names for ``*inputs``."""
    starred = isinstance(argument, ast.Starred) and isinstance(argument.value, ast.Name)
    if starred and argument.value.id == several:  # type: ignore[attr-defined]
        return [ast.copy_location(ast.Name(name, ast.Load()), argument) for name in names]
    return [argument]


def find_method(block_class: type, name: str, after: type | None = None) -> tuple[FunctionType, type] | None:
    """Return the method that ``self.name`` refers to for a block class, or ``super().name`` inside class ``after``."""
    order = list(block_class.__mro__)
    if after is not None:
        order = order[order.index(after) + 1 :]
    for owner in order:
        if name in vars(owner):
            method = vars(owner)[name]
            return (method, owner) if isinstance(method, FunctionType) else None
    return None


def find_global(function: FunctionType, name: str) -> Any:
    """Return the value of a global name in a function's module, or None if it is unknown."""
    return function.__globals__.get(name)


def origin_of_constant(function: FunctionType, name: str) -> str:
    """Return the full name of the module that defines a constant, which the function's module may have imported."""
    tree = _tree(Path(function.__code__.co_filename))
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):
            for alias in node.names:
                if (alias.asname or alias.name) == name:
                    return _absolute(node, function.__globals__)
    return function.__module__


def module_file(module: ModuleType) -> Path:
    """Return the file from which a module was loaded."""
    return Path(module.__file__ or "")


def label(path: Path) -> str:
    """Return a file's name for C comments and fault messages, the same on every machine."""
    resolved = path.resolve()
    if resolved.is_relative_to(PACKAGE_ROOT):
        return f"fmus_src/{resolved.relative_to(PACKAGE_ROOT).as_posix()}"
    return resolved.name


def comments_of(path: Path) -> dict[int, str]:
    """Return the comments on separate lines by line number, without ``#``."""
    return _comments(path.read_text(encoding="utf-8"))


@cache
def _comments(text: str) -> dict[int, str]:
    comments = {}
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and token.line.strip() == token.string:
            comments[token.start[0]] = token.string.lstrip("# ").replace("*/", "* /")
    return comments


def _tree(path: Path) -> ast.Module:
    """Return the syntax tree of a file, always the same for equal content, since nodes identify functions.

    Access is serialised: two threads would create two trees, and CPython 3.11 counts the depth of a tree for all
    threads together, so concurrent calls of `ast.parse` sometimes fail (its issue 106905).
    """
    with PARSING:
        return _parse(path.read_text(encoding="utf-8"))


@cache
def _parse(text: str) -> ast.Module:
    return ast.fix_missing_locations(_Normalise().visit(ast.parse(text)))


class _Normalise(ast.NodeTransformer):
    """Rewriter of ``x += y`` to ``x = x + y``, which is equivalent for all values that a kernel may change."""

    def visit_AugAssign(self, node: ast.AugAssign) -> ast.Assign:
        reading = copy.deepcopy(node.target)
        reading.ctx = ast.Load()
        combined = ast.copy_location(ast.BinOp(reading, node.op, node.value), node)
        return ast.copy_location(ast.Assign([node.target], combined), node)


def _absolute(node: ast.ImportFrom, module_globals: dict[str, Any]) -> str:
    if node.level == 0:
        return node.module or ""
    package = str(module_globals["__package__"]).split(".")
    base = package[: len(package) - (node.level - 1)]
    return ".".join([*base, node.module] if node.module else base)
