"""The names that Python files give, and the limits of `limits.toml` on the words in them."""

from __future__ import annotations

import ast
import re
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from .sources import Source

LIMITS = Path(__file__).with_name("limits.toml")
GROWTH = 1.1  # how far the table [plain] may be exceeded


def given_names(source: Source) -> Iterator[tuple[str, int]]:
    """Yield names with their lines: variables at each occurrence, arguments, assigned attributes, functions, classes,
    and the file itself (its folder for `__init__.py`). Attributes that are only read belong to their declarations."""
    yield (source.path.parent if source.path.name == "__init__.py" else source.path).stem, 1
    for node in source.nodes:
        kind = type(node)
        if kind is ast.Name:
            yield node.id, node.lineno
        elif kind is ast.arg:
            yield node.arg, node.lineno
        elif kind is ast.FunctionDef or kind is ast.ClassDef:
            yield node.name, node.lineno
        elif kind is ast.Attribute and type(node.ctx) is ast.Store:
            yield node.attr, node.lineno


def whole(name: str) -> str:
    return name.strip("_").lower()


@cache
def words(name: str) -> frozenset[str]:
    """Return the words of a name: `keptRows`, `KEPT_ROWS` and `_kept_rows` have the words kept and rows."""
    return frozenset(token.lower() for token in re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", name))


def count_words(sources: Iterable[Source], limits: dict[str, dict[str, int]]) -> Counter[str]:
    """Count the occurrences of each name, and of each word of the table [words] in names."""
    names = Counter(name for source in sources for name, _ in given_names(source))
    counts: Counter[str] = Counter()
    for name, number in names.items():
        for token in {whole(name)} | (words(name) & {*limits["words"]}):
            counts[token] += number
    return counts


def read_limits() -> dict[str, dict[str, int]]:
    return tomllib.loads(LIMITS.read_text(encoding="utf-8"))


def check_limits(counts: Counter[str], limits: dict[str, dict[str, int]]) -> list[str]:
    """Return a line for each number that is not as stored."""
    problems = [
        f"{token}: {counts[token]} names at the start {stored}: give the thing its own name"
        for token, stored in limits["plain"].items()
        if counts[token] > GROWTH * stored
    ]
    for token, stored in (limits["words"] | limits["names"]).items():
        if counts[token] > stored:
            problems.append(
                f"{token}: {counts[token]} names, {stored} allowed: see python -m tests.house --list {token}"
            )
        elif counts[token] < stored:
            problems.append(
                f"{token}: {counts[token]} names, {stored} stored: lower it, python -m tests.house --ratchet"
            )
    return problems


def lower_limits(text: str, counts: Counter[str]) -> str:
    """Return the text of `limits.toml` with every number above its count lowered to it; the table [plain] stays."""
    head, plain, tail = text.partition("[plain]")
    return re.sub(r"(?m)^(\w+) = (\d+)$", lambda m: f"{m[1]} = {min(int(m[2]), counts[m[1]])}", head) + plain + tail
