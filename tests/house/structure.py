"""Measures of names, calls and imports. Each returns the text of the table and the entries behind it."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterable
from pathlib import PurePosixPath

from .names import given_names, whole
from .size import Measure
from .sources import PRODUCT, USERS, Checkout, Source

IRREGULAR = re.compile(
    "begun|bitten|bought|broken|brought|built|caught|chosen|dealt|done|drawn|driven|eaten|fallen|felt|flown|forgotten|"
    "found|frozen|given|gone|grown|heard|held|hidden|kept|known|laid|lent|lost|made|meant|met|paid|ridden|risen|said|"
    "seen|sent|shaken|shown|sought|spent|spoken|spun|stood|struck|stuck|swept|taken|taught|thought|thrown|told|torn|"
    "understood|won|worn|woken|written"
)
PRESENT = re.compile("bleed|breed|embed|exceed|feed|need|proceed|seed|shed|speed|succeed")
COMMAND_LINE = {"verbs", "commands", "cli", "cli.py", "examples.py"}


def actual(checkout: Checkout) -> Measure:
    """Count `found` as a name (`given_names`) in the product; in brackets by top folder of the whole tree."""
    entries = [f"{s.path}:{line}" for s in checkout.sources for name, line in given_names(s) if whole(name) == "found"]
    tops = Counter(entry.split("/")[0] for entry in entries)
    parts = ", ".join(f"{top} {number}" for top, number in tops.most_common())
    return f"{sum(tops[top] for top in PRODUCT)} ({parts or 'none'})", entries


def participles(checkout: Checkout) -> Measure:
    """Count functions and methods of the product whose first word is a past participle, in -ed or of a list of
    irregular ones that differ from the present form. Properties are nouns and do not count."""
    entries = []
    for source in checkout.below(*PRODUCT):
        for node in source.nodes:
            if isinstance(node, ast.FunctionDef) and not any("property" in ast.unparse(d) for d in node.decorator_list):
                token = node.name.lstrip("_").split("_")[0]
                if IRREGULAR.fullmatch(token) or (token.endswith("ed") and not PRESENT.fullmatch(token)):
                    entries.append(f"{source.path}:{node.lineno} {node.name}")
    return str(len(entries)), entries


def untyped(checkout: Checkout) -> Measure:
    """Count `dict[str, Any]`, and `Any` in all (its import apart), as written in `analysis` and `common`."""
    nodes = [(source.path, node) for source in checkout.below(*USERS) for node in source.nodes]
    anys = sum(isinstance(node, ast.Name) and node.id == "Any" for _, node in nodes)
    records = [
        f"{p}:{n.lineno}" for p, n in nodes if isinstance(n, ast.Subscript) and ast.unparse(n) == "dict[str, Any]"
    ]
    return f"{len(records)} / {anys}", records


def flags(checkout: Checkout) -> Measure:
    """Count `--flag` in strings of `analysis` and `common`, docstrings apart, outside of the command line: of folders
    `verbs`, `commands` and `cli`, and of `cli.py` and `examples.py`."""
    entries = []
    for source in checkout.below(*USERS):
        if not COMMAND_LINE & {*source.path.parts}:
            texts = {id(statement.value) for statement in source.docstrings}
            for node in source.nodes:
                if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in texts:
                    matches = re.findall(r"(?<![\w-])--[a-z-]+", node.value)
                    entries += [f"{source.path}:{node.lineno} {flag}" for flag in matches]
    return str(len(entries)), entries


def used_once(checkout: Checkout) -> Measure:
    """Count functions of `analysis` and `common`, undecorated and of at most six lines below the docstring, whose name
    occurs once in all Python files (as a name or an attribute; imports and the definition apart).

    One stays if it is named after a formula or a unit, if a test or a table calls it, if it draws one figure or writes
    one table of a page, or if its caller would otherwise have more than one subject.
    """
    uses: Counter[str] = Counter()
    for source in checkout.sources:
        uses.update(node.id for node in source.nodes if isinstance(node, ast.Name))
        uses.update(node.attr for node in source.nodes if isinstance(node, ast.Attribute))
    entries = []
    for source in checkout.below(*USERS):
        for node in source.nodes[0].body:
            if isinstance(node, ast.FunctionDef) and not node.decorator_list and uses[node.name] == 1:
                body = [statement for statement in node.body if statement not in source.docstrings]
                if not body or body[-1].end_lineno - body[0].lineno < 6:
                    entries.append(f"{source.path}:{node.lineno} {node.name}")
    return str(len(entries)), entries


def circles(checkout: Checkout) -> Measure:
    """Count the largest sets of files of the product of which each imports each, directly or not. Imports below
    `TYPE_CHECKING` and within functions count."""
    files = {_module(source.path): source for source in checkout.below(*PRODUCT)}
    imports = {name: {*_imports(name, source, files)} - {name} for name, source in files.items()}
    reached = {name: _reached(name, imports) for name in imports}
    members = {frozenset(o for o in reached[name] if name in reached[o]) for name in reached if name in reached[name]}
    return str(len(members)), [" <-> ".join(sorted(str(files[name].path) for name in circle)) for circle in members]


def _module(path: PurePosixPath) -> tuple[str, ...]:
    parts = path.with_suffix("").parts
    return parts[:-1] if parts[-1] == "__init__" else parts


def _imports(name: tuple[str, ...], source: Source, files: Iterable[tuple[str, ...]]) -> Iterable[tuple[str, ...]]:
    package = name if source.path.name == "__init__.py" else name[:-1]
    for node in source.imports:
        if isinstance(node, ast.ImportFrom) and node.level:
            base = (*package[: len(package) - node.level + 1], *(node.module.split(".") if node.module else ()))
            for alias in node.names:
                if target := next((module for module in ((*base, alias.name), base) if module in files), None):
                    yield target


def _reached(start: tuple[str, ...], imports: dict[tuple[str, ...], set[tuple[str, ...]]]) -> set[tuple[str, ...]]:
    reached: set[tuple[str, ...]] = set()
    waiting = [*imports[start]]
    while waiting:
        if (name := waiting.pop()) not in reached:
            reached.add(name)
            waiting += imports[name]
    return reached
