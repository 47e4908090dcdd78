"""The line of every key in a TOML file, which tomllib does not tell."""

from __future__ import annotations

import re

KEY = r"""(?:[A-Za-z0-9_-]+|"(?:[^"\\]|\\.)*"|'[^']*')"""
DOTTED = rf"{KEY}(?:\s*\.\s*{KEY})*"
HEADER = re.compile(rf"\s*\[(?P<array>\[)?\s*(?P<name>{DOTTED})\s*\]")
ENTRY = re.compile(rf"\s*(?P<name>{DOTTED})\s*=")
TOKEN = re.compile(r"""\"{3}|\'{3}|"(?:[^"\\\n]|\\.)*"|'[^'\n]*'|#[^\n]*|[\[\]{}]""")


def key_lines(text: str) -> dict[str, int]:
    """The line of each key by its name, ``draw.x.low``; parts in quotes without them. ``text`` is TOML."""
    lines: dict[str, int] = {}
    prefix, position, number = "", 0, 1
    while position < len(text):
        end = text.find("\n", position)
        end = len(text) if end < 0 else end
        header, entry = HEADER.match(text, position, end), ENTRY.match(text, position, end)
        if header:
            prefix = _plain(header["name"])
            lines.setdefault(prefix, number)
        elif entry:
            name = _plain(entry["name"])
            lines[f"{prefix}.{name}" if prefix else name] = number
            end = _value_end(text, entry.end())
        number += text.count("\n", position, end + 1)
        position = end + 1
    return lines


def _plain(name: str) -> str:
    return ".".join(part.strip("\"'") for part in re.findall(KEY, name))


def _value_end(text: str, position: int) -> int:
    """The end of the line on which a value ends that begins at a position."""
    depth = 0
    while position < len(text):
        if text[position] == "\n" and not depth:
            return position
        token = TOKEN.match(text, position)
        if token is None:
            position += 1
            continue
        position = token.end()
        if token[0] in ('"""', "'''"):
            position = text.index(token[0], position) + 3
            while text.startswith(token[0][0], position):  # up to two quotes may precede the closing three
                position += 1
        depth += (token[0] in ("[", "{")) - (token[0] in ("]", "}"))
    return len(text)
