"""Text of others on its way to a terminal, where none of its characters is an order."""

from __future__ import annotations

import re

# C0 and C1 but for tab, line feed and carriage return; marks of the direction of writing.
CONTROLS = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]")

BREAKS = re.compile("[\n\r\u2028\u2029]")


def visible(text: str) -> str:
    """The text with such characters as ``\\x1b`` or ``\\u202e``, which JSON reads, too."""
    return CONTROLS.sub(_escape, text)


def on_one_line(text: str) -> str:
    """The text with its line breaks escaped, so that a name of others does not write lines of its own."""
    return BREAKS.sub(_escape, text)


def visible_line(text: str, longest: int) -> str:
    """At most so many characters of it, on one line: lines and columns become blanks."""
    line = visible(" ".join(text.split()))
    return line if len(line) <= longest else f"{line[:longest]} ..."


def _escape(match: re.Match[str]) -> str:
    code = ord(match[0])
    return f"\\x{code:02x}" if code < 0x20 else f"\\u{code:04x}"
