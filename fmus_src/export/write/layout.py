"""Indentation, line lengths and comments of the generated C."""

from __future__ import annotations

import re
import textwrap

from .names import comment

WIDTH = 110
LINE_COLUMN = 92  # column of the Python line numbers
MEMBER_COLUMN = 44  # column of the descriptions of struct members
INDENT = "    "
NO_BREAK = "\x00"
TYPE_AND_NAME = re.compile(
    r"\b(const|double|int64_t|bool|Vector2|Vector3|Vector4|Matrix\d+x\d+|Fault|return) "
)  # stay on one line with the following token


class CodeLines:
    """Lines of C at the current indentation."""

    def __init__(self, depth: int = 0) -> None:
        self.text: list[str] = []
        self.depth = depth

    def add(self, text: str, python_line: int = 0) -> None:
        """Add one statement, broken over lines if too long, with the Python line number as a comment on its right."""
        *heads, text = text.split("\n")
        self.text += [INDENT * self.depth + head for head in heads]
        parts = textwrap.wrap(
            TYPE_AND_NAME.sub(f"\\1{NO_BREAK}", text),
            WIDTH,
            initial_indent=INDENT * self.depth,
            subsequent_indent=INDENT * (self.depth + 2),
            break_long_words=False,
            break_on_hyphens=False,
        )
        parts = [part.replace(NO_BREAK, " ") for part in parts]
        if python_line:
            parts[-1] = f"{parts[-1].ljust(LINE_COLUMN)} /* {python_line} */"
        self.text += parts

    def comment(self, title: str, body: str = "") -> None:
        """Add a comment of one line, or of a title and paragraphs."""
        indent = INDENT * self.depth
        lines = [line for line in comment(f"{title}\n\n{body}" if body else title).splitlines()]
        if len(lines) == 1:
            self.text.append(f"{indent}/* {lines[0]} */")
            return
        self.text.append(f"{indent}/* {lines[0]}")
        self.text += [f"{indent} * {line}".rstrip() for line in lines[1:]]
        self.text.append(f"{indent} */")

    def member(self, text: str, about: str) -> None:
        """Add a member of a struct with its meaning as a comment on its right."""
        line = f"{INDENT * self.depth}{text}"
        about_lines = textwrap.wrap(about, WIDTH - MEMBER_COLUMN - 6, break_on_hyphens=False)
        for number, part in enumerate(about_lines):
            start = "/* " if number == 0 else "   "
            end = " */" if number == len(about_lines) - 1 else ""
            self.text.append(f"{(line if number == 0 else '').ljust(MEMBER_COLUMN)} {start}{part}{end}")

    def open(self, text: str, python_line: int = 0) -> None:
        """Add a line that opens a block."""
        self.add(text, python_line)
        self.depth += 1

    def close(self, text: str) -> None:
        """Add a line that ends a block."""
        self.depth -= 1
        self.add(text)

    def reopen(self, text: str, python_line: int = 0) -> None:
        """Add a line that ends a block and opens the next, such as ``} else {``."""
        self.depth -= 1
        self.open(text, python_line)
