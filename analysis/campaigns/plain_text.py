"""Text for a terminal that does not depend on trials: aligned columns, assumptions, faults, numbers."""

from __future__ import annotations

from collections.abc import Iterable


def align_columns(rows: list[list[str]]) -> list[str]:
    """Return rows of cells as lines, with the first column left-aligned and the others right-aligned."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return [
        "  ".join(
            [row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True))]
        )
        for row in rows
    ]


def assumption_lines(assumptions: Iterable[str]) -> list[str]:
    """Return a line for each assumption of a result about undeclared dependencies of FMUs."""
    return [f"assumed: {assumption}" for assumption in assumptions]


def faults_line(faults: Iterable[object]) -> str:
    """Return a line that lists the faults of a result."""
    return f"with faults: {'; '.join(map(str, faults))}"


def short(value: float | None) -> str:
    """Return a number with four significant digits, or a dash for None."""
    return "-" if value is None else f"{value:.4g}"


def ordinal(number: int) -> str:
    """Return the ordinal of a number, such as 1st, 2nd, 3rd, 4th or 11th."""
    teen = number // 10 % 10 == 1
    return f"{number}{'th' if teen else ('th', 'st', 'nd', 'rd', *['th'] * 6)[number % 10]}"
