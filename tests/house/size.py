"""Measures of size. Each returns the text of the table and the entries behind it."""

from __future__ import annotations

import re
from collections import Counter

from .sources import USERS, Checkout

Measure = tuple[str, list[str]]


def analysis(checkout: Checkout) -> Measure:
    """Count lines of all files of `analysis` and `common`, their Python files, and their folders with an
    `__init__.py`."""
    lines = sum(checkout.text(path).count("\n") for path in checkout.paths if path.parts[0] in USERS)
    files = checkout.below(*USERS)
    packages = [str(s.path.parent) for s in files if s.path.name == "__init__.py"]
    return f"{lines} lines, {len(files)} files, {len(packages)} packages", packages


def small_files(checkout: Checkout) -> Measure:
    """Count Python files of `analysis` and `common` of 35 lines or fewer that are no
    `__init__.py`; in brackets with them."""
    small = [s for s in checkout.below(*USERS) if s.text.count("\n") <= 35]
    others = [f"{s.path}: {s.text.count(chr(10))}" for s in small if s.path.name != "__init__.py"]
    return f"{len(others)} ({len(small)})", others


def longest_file(checkout: Checkout) -> Measure:
    """Count lines of the longest Python file, and the files that have over 300 (`--list`)."""
    by_length = sorted(((s.text.count("\n"), str(s.path)) for s in checkout.sources), reverse=True)
    return f"{by_length[0][0]} ({by_length[0][1]})", [f"{path}: {lines}" for lines, path in by_length if lines > 300]


def pictures(checkout: Checkout) -> Measure:
    """Count lines of all SVG files in git, which are all generated, and bytes of the largest picture of any kind."""
    kinds = (".svg", ".png", ".jpg", ".gif", ".webp")
    sizes = {path: (checkout.root / path).stat().st_size for path in checkout.paths if path.suffix in kinds}
    lines = sum(checkout.text(path).count("\n") for path in sizes if path.suffix == ".svg")
    largest = max(sizes, key=sizes.__getitem__, default=None)
    size = f"largest {sizes[largest]} bytes ({largest.name})" if largest else "none"
    return f"{lines} lines, {size}", [f"{path}: {size} bytes" for path, size in sizes.items()]


def campaigns(checkout: Checkout) -> Measure:
    """Count lines of the TOML files of `ssp_systems`, and the fraction of their tables (a header with its lines,
    without comments and blanks) whose text an earlier table has, in the same file or another."""
    paths = [path for path in checkout.paths if path.parts[0] == "ssp_systems" and path.suffix == ".toml"]
    tables: Counter[str] = Counter()
    for path in paths:
        for table in re.split(r"(?m)^(?=\[)", checkout.text(path))[1:]:
            rows = (row.strip() for row in table.splitlines())
            tables["\n".join(row for row in rows if row and not row.startswith("#"))] += 1
    repeated = 1.0 - len(tables) / max(1, tables.total())
    lines = {path: checkout.text(path).count("\n") for path in paths}
    return f"{sum(lines.values())} lines, {repeated:.0%} of the tables repeated", [
        f"{p}: {n}" for p, n in lines.items()
    ]


def project_only(checkout: Checkout) -> Measure:
    """Count lines below `analysis` and `common`, hence in the wheel, in folders named demo, contestants or
    reference."""
    only = {"demo", "contestants", "reference"}
    paths = [path for path in checkout.paths if path.parts[0] in USERS and only & {*path.parts}]
    return f"{sum(checkout.text(path).count(chr(10)) for path in paths)} lines", [str(path) for path in paths]


def documentation(checkout: Checkout) -> Measure:
    """Count words, as `wc -w` does, and the Markdown files below docs with the README of the project."""
    pages = [p for p in checkout.paths if p.suffix == ".md" and (p.parts[0] == "docs" or str(p) == "README.md")]
    words = {page: len(checkout.text(page).split()) for page in pages}
    return f"{sum(words.values())} words on {len(pages)} pages", [f"{page}: {count}" for page, count in words.items()]
