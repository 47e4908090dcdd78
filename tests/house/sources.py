"""The tracked files of a checkout, and what its Python files hold."""

from __future__ import annotations

import ast
import gc
import subprocess
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[2]
PRODUCT = ("analysis", "common", "fmus_src")
USERS = PRODUCT[:2]  # of components: what the goals of size are for


@dataclass(frozen=True)
class Source:
    """A Python file, parsed when it is first needed."""

    path: PurePosixPath
    text: str

    @cached_property
    def nodes(self) -> list[ast.AST]:
        """All nodes, the module first."""
        gc.disable()  # a syntax tree has no circles, and looking for them doubles the time
        try:
            return [*ast.walk(ast.parse(self.text))]
        finally:
            gc.enable()

    @cached_property
    def imports(self) -> list[ast.Import | ast.ImportFrom]:
        """All imports, within functions too; they stay when the nodes are dropped."""
        return [node for node in self.nodes if isinstance(node, (ast.Import, ast.ImportFrom))]

    def drop_nodes(self) -> None:
        """Free the syntax tree, which is a hundred times the text."""
        self.__dict__.pop("nodes", None)

    @cached_property
    def docstrings(self) -> list[ast.Expr]:
        """Strings that stand alone, as docstrings do."""
        alone = [n for n in self.nodes if isinstance(n, ast.Expr) and isinstance(n.value, ast.Constant)]
        return [statement for statement in alone if isinstance(statement.value.value, str)]


@dataclass(frozen=True)
class Checkout:
    """Checkout that every measure counts."""

    root: Path = ROOT

    @cached_property
    def paths(self) -> list[PurePosixPath]:
        """Files that git tracks and that exist; links (`perilune/analysis`) are left out."""
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=self.root, capture_output=True, text=True, check=True)
        paths = [PurePosixPath(name) for name in listed.stdout.split("\0") if name]
        return [path for path in paths if (self.root / path).is_file() and not (self.root / path).is_symlink()]

    def text(self, path: PurePosixPath) -> str:
        return (self.root / path).read_text(encoding="utf-8")

    def read(self) -> list[Source]:
        return [Source(path, self.text(path)) for path in self.paths if path.suffix == ".py"]

    @cached_property
    def sources(self) -> list[Source]:
        """The Python files, which stay in memory as they are parsed, once for all measures."""
        return self.read()

    def below(self, *tops: str) -> list[Source]:
        return [source for source in self.sources if source.path.parts[0] in tops]
