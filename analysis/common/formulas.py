"""Names of others in CSV files, which a spreadsheet takes for formulas where they begin with = + - or @."""

from __future__ import annotations

BEGINNINGS = ("=", "+", "-", "@")
QUOTE = "'"  # what follows it is text to a spreadsheet


def quote_formula(name: str) -> str:
    """The name with a quote mark before it if it would be a formula."""
    return f"{QUOTE}{name}" if name.startswith(BEGINNINGS) else name


def unquote_formula(text: str) -> str:
    """The name that `quote_formula` was given."""
    return text[1:] if text.startswith(QUOTE) and text[1:].startswith(BEGINNINGS) else text
