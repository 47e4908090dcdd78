"""Openings of docstrings, and words of docstrings, comments and names, with the limits of `prose.toml`."""

from __future__ import annotations

import ast
import re
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

from .names import given_names, words
from .size import Measure
from .sources import Checkout, Source

LIMITS = Path(__file__).with_name("prose.toml")
DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef)
COMMENT = re.compile(r"(?:^\s*|\s\s)# (.*)$")
Limits = dict[str, dict[str, int]]


def read_limits() -> Limits:
    return tomllib.loads(LIMITS.read_text(encoding="utf-8"))


def openings(checkout: Checkout) -> Measure:
    """Count docstrings whose first word is one of the table [openings], of all docstrings."""
    docstrings = [(s, line, text) for s in checkout.sources for line, text in iterate_docstrings(s)]
    banned = read_limits()["openings"]
    entries = [f"{s.path}:{line} {text.split()[0]}" for s, line, text in docstrings if first_word(text) in banned]
    return f"{len(entries)} of {len(docstrings)}", entries


def phrases(checkout: Checkout) -> Measure:
    """Count occurrences of the table [phrases] in docstrings and comments."""
    pattern = compile_phrases(read_limits()["phrases"])
    entries = [
        f"{source.path}:{line} {match[0]}"
        for source in checkout.sources
        for line, text in (*iterate_docstrings(source), *iterate_comments(source))
        for match in pattern.finditer(text)
    ]
    return str(len(entries)), entries


def iterate_docstrings(source: Source) -> Iterator[tuple[int, str]]:
    for node in source.nodes:
        if type(node) in DOCUMENTED and (text := ast.get_docstring(node)):
            yield node.body[0].lineno, text


def iterate_comments(source: Source) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(source.text.splitlines(), 1):
        if match := COMMENT.search(line):
            yield number, match[1]


def first_word(text: str) -> str:
    return match[0].lower() if (match := re.search(r"\w+", text)) else ""


def compile_phrases(table: Iterable[str]) -> re.Pattern[str]:
    return re.compile("|".join(rf"\b{phrase}\b" for phrase in table).replace(" ", r"\s+"), re.IGNORECASE)


def count(sources: Iterable[Source], limits: Limits) -> Counter[tuple[str, str]]:
    """Count openings, phrases and words of names by table and key."""
    pattern = compile_phrases(limits["phrases"])
    counts: Counter[tuple[str, str]] = Counter()
    for source in sources:
        docstrings = [text for _, text in iterate_docstrings(source)]
        counts.update(("openings", first_word(text)) for text in docstrings)
        for text in (*docstrings, *(comment for _, comment in iterate_comments(source))):
            counts.update(("phrases", " ".join(match[0].lower().split())) for match in pattern.finditer(text))
        counts.update(("names", token) for name, _ in given_names(source) for token in words(name))
    return counts


def check_limits(counts: Counter[tuple[str, str]], limits: Limits) -> list[str]:
    """Return a line for each number above its limit."""
    return [
        f"{key}: {counts[table, key]} in {table}, {stored} allowed: see python -m tests.house --list "
        + (key if table == "names" else table)
        for table, numbers in limits.items()
        for key, stored in numbers.items()
        if counts[table, key] > stored
    ]


def lower_limits(counts: Counter[tuple[str, str]], text: str) -> str:
    """Return the text of `prose.toml` with every number above its count lowered to it."""
    lines, table = text.splitlines(keepends=True), ""
    for number, line in enumerate(lines):
        if match := re.match(r'\[(\w+)\]|"(.+)" = (\d+)', line):
            table = match[1] or table
            if match[2]:
                lines[number] = f'"{match[2]}" = {min(int(match[3]), counts[table, match[2]])}\n'
    return "".join(lines)
