"""Names of others in CSV files, which a spreadsheet takes for formulas where they begin with = + - or @."""

from __future__ import annotations

BEGINNINGS = ("=", "+", "-", "@")
QUOTE = "'"  # what follows it is text to a spreadsheet


def quote_formula(name: str) -> str:
    """The name with a quote mark before it if it would be a formula, or would be read as a quoted one."""
    return f"{QUOTE}{name}" if name.lstrip(QUOTE).startswith(BEGINNINGS) else name


def unquote_formula(text: str) -> str:
    """The name that `quote_formula` was given; one that was never quoted is returned as it is."""
    is_quoted = text.startswith(QUOTE) and text.lstrip(QUOTE).startswith(BEGINNINGS)
    return text[1:] if is_quoted else text
