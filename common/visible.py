"""Untrusted text made safe for terminals, by escaping control characters, and for spreadsheets."""

from __future__ import annotations

import re
from collections.abc import Sequence

# C0 and C1 except tab, line feed and carriage return; marks of the writing direction.
CONTROLS = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]")

BREAKS = re.compile("[\n\r\u2028\u2029]")


def visible(text: str) -> str:
    """Return the text with control characters escaped as ``\\x1b`` or ``\\u202e``; JSON documents remain valid."""
    return CONTROLS.sub(_escape, text)


def on_one_line(text: str) -> str:
    """Return the text with its line breaks escaped, so that foreign names cannot add lines."""
    return BREAKS.sub(_escape, text)


def visible_line(text: str, longest: int) -> str:
    """Return at most ``longest`` characters of the text on one line; line breaks and tabs become spaces."""
    line = visible(" ".join(text.split()))
    return line if len(line) <= longest else f"{line[:longest]} ..."


def limit_lines(lines: Sequence[str], limit: int, things: str = "") -> list[str]:
    """Return at most ``limit`` lines, followed by a line that counts the omitted ``things``."""
    more = f"and {len(lines) - limit} more {things}".rstrip()
    return [*lines[:limit], more] if len(lines) > limit else list(lines)


def _escape(match: re.Match[str]) -> str:
    code = ord(match[0])
    return f"\\x{code:02x}" if code < 0x20 else f"\\u{code:04x}"


FORMULAS = ("=", "+", "-", "@")  # first characters of a formula in a spreadsheet
QUOTE = "'"  # makes spreadsheets read the following characters as text


def quote_formula(name: str) -> str:
    """Return the name, preceded by a quote mark if a spreadsheet would read it as a formula or as quoted text."""
    return f"{QUOTE}{name}" if name.lstrip(QUOTE).startswith(FORMULAS) else name


def unquote_formula(text: str) -> str:
    """Return the original name from the result of `quote_formula`; unquoted names are returned unchanged."""
    is_quoted = text.startswith(QUOTE) and text.lstrip(QUOTE).startswith(FORMULAS)
    return text[1:] if is_quoted else text
